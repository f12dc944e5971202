// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/staged.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>

#include "trident_nav_ros/move_base_params.h"

namespace trident::nav {
namespace {

/// Commands one speed.
class OneSpeed final : public Controller {
 public:
  explicit OneSpeed(double vx) : vx_(vx) {}
  CommandOutcome command(const RobotState&, const Path&, const CostGrid&, const Tracks&) override {
    CommandOutcome outcome;
    outcome.twist.vx = vx_;
    return outcome;
  }
  void reset() override {}

 private:
  double vx_;
};

double speed_of(Controller& controller) { return controller.command({}, {}, {}, {}).twist.vx; }

bool has_field(const std::vector<ConfigField>& fields, const std::string& name) {
  return std::count_if(fields.begin(), fields.end(),
                       [&](const ConfigField& field) { return field.name == name; }) == 1;
}

TEST(StagedController, TheNextCommandIsTheNewestControllers) {
  StagedController staged(std::make_unique<OneSpeed>(1.0));
  EXPECT_EQ(speed_of(staged), 1.0);
  staged.stage(std::make_unique<OneSpeed>(2.0));
  staged.stage(std::make_unique<OneSpeed>(3.0));
  EXPECT_EQ(speed_of(staged), 3.0);
  EXPECT_EQ(speed_of(staged), 3.0);
}

TEST(StagedController, IsReplacedByOneThreadWhileAnotherCommands) {
  StagedController staged(std::make_unique<OneSpeed>(0.0));
  constexpr int kCount = 1000;
  std::thread other([&] {
    for (int i = 1; i <= kCount; ++i) staged.stage(std::make_unique<OneSpeed>(i));
  });
  double last = 0.0;
  while (last < kCount) {
    const double next = speed_of(staged);
    ASSERT_GE(next, last) << "an older controller came back";
    last = next;
  }
  other.join();
}

TEST(PluginFields, OfALocalPlannerAreTheRobotsAndTheLawsOnce) {
  const std::vector<ConfigField> fields = controller_fields("dwa_local_planner/DWAPlannerROS");
  for (const char* name : {"max_vel_x", "acc_lim_theta", "xy_goal_tolerance", "sim_time",
                           "max_vel_trans", "vx_samples"}) {
    EXPECT_TRUE(has_field(fields, name)) << name;
  }
}

TEST(PluginFields, AreKnownOfEveryControllerAndPlanner) {
  for (const std::string& name : builtin_control_laws().names()) {
    EXPECT_FALSE(builtin_control_laws().get(name).fields.empty()) << name;
  }
  EXPECT_TRUE(has_field(planner_fields("navfn/NavfnROS"), "allow_unknown"));
  EXPECT_TRUE(has_field(planner_fields("global_planner/GlobalPlanner"), "neutral_cost"));
}

}  // namespace
}  // namespace trident::nav
