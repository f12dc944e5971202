// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "control/scene.h"

namespace trident::nav::testing {
namespace {

struct NamedRobot {
  const char* name;
  ControlSetup (*make)();
};

struct NamedScene {
  const char* name;
  Scene (*make)(const Footprint&);
};

using Case = std::tuple<const char*, NamedRobot, NamedScene>;

class DrivesScene : public ::testing::TestWithParam<Case> {};

TEST_P(DrivesScene, ToTheGoalFreeOfContactWithinItsLimits) {
  const auto& [law, robot, named_scene] = GetParam();
  const ControlSetup setup = robot.make();
  const auto controller = make_controller(law, setup);
  const Scene scene = named_scene.make(setup.footprint);
  const Drive result = drive(*controller, setup, scene);
  RecordProperty("time_ms", static_cast<int>(1000.0 * result.time_s));
  EXPECT_FALSE(result.has_contact) << result.track.back().x << " " << result.track.back().y;
  EXPECT_TRUE(result.is_reached) << "after " << result.time_s << " s at " << result.track.back().x
                                 << " " << result.track.back().y << ": " << result.last_reason;
  EXPECT_LE(result.position_error_m, setup.tolerance.xy_goal_tolerance);
  EXPECT_LE(result.heading_error_rad, setup.tolerance.yaw_goal_tolerance);
  EXPECT_LE(result.max_acceleration_ratio, 1.0 + 1e-9);
  if (std::getenv("SCENE_TIMES") != nullptr) {
    std::printf("%s %s %s: %.2f s, %d failures %s\n", law, robot.name, named_scene.name,
                result.is_reached ? result.time_s : -result.time_s, result.failures,
                result.last_reason.c_str());
  }
}

constexpr NamedRobot kTurning[] = {{"burger", burger}, {"jackal", jackal}, {"omni", omni_robot}};
constexpr NamedScene kScenes[] = {{"straight", straight_scene},
                                  {"corner", corner_scene},
                                  {"doorway", doorway_scene},
                                  {"dead_end", dead_end_scene},
                                  {"goal_behind", goal_behind_scene}};

std::string case_name(const ::testing::TestParamInfo<Case>& info) {
  return std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param).name + "_" +
         std::get<2>(info.param).name;
}

INSTANTIATE_TEST_SUITE_P(
    Laws, DrivesScene,
    ::testing::Combine(::testing::Values("dwa", "trajectory_planner", "regulated_pure_pursuit",
                                         "rotation_shim", "graceful", "dwb", "mppi", "teb"),
                       ::testing::ValuesIn(kTurning), ::testing::ValuesIn(kScenes)),
    case_name);

constexpr NamedRobot kCars[] = {{"car", car}};
// Pure pursuit of a path that no car can drive misses the heading that was wanted.
constexpr NamedScene kWideScenes[] = {{"straight", straight_scene}};
INSTANTIATE_TEST_SUITE_P(Cars, DrivesScene,
                         ::testing::Combine(::testing::Values("regulated_pure_pursuit"),
                                            ::testing::ValuesIn(kCars),
                                            ::testing::ValuesIn(kWideScenes)),
                         case_name);
INSTANTIATE_TEST_SUITE_P(CarsThatSample, DrivesScene,
                         ::testing::Combine(::testing::Values("mppi", "teb"),
                                            ::testing::ValuesIn(kCars),
                                            ::testing::ValuesIn(kScenes)),
                         case_name);

}  // namespace
}  // namespace trident::nav::testing
