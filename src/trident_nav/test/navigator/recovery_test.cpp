// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/navigator/recovery.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trident_base/angle.h"
#include "trident_nav/control/motion.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav {
namespace {

class NoWorld : public NavigatorWorld {
 public:
  void request_plan(const Pose2&, const Pose2&) override {}
  std::optional<PlanOutcome> take_plan() override { return std::nullopt; }
  void cancel_plan() override {}
  double path_cost(const Path&, std::size_t) override { return 0.0; }
  void forget(const ClearedArea& area) override { forgotten = area; }
  std::vector<StaleSource> stale_sources(double) override { return {}; }
  std::string obstacle_text(const Pose2&) override { return ""; }
  ClearedArea forgotten;
};

/// An oblong robot on a grid that stands in a corner of it, [m] from there.
class RecoveryTest : public ::testing::Test {
 protected:
  RecoveryTest() : cost_(60 * 60, kFreeCost) {
    setup_.limits = {0.5, -0.3, 0.0, 1.0, 1.0, 1.5, 0.0, 3.0, 0.0};
    setup_.footprint = polygon_footprint({{-0.3, -0.1}, {0.3, -0.1}, {0.3, 0.1}, {-0.3, 0.1}});
    grid_.geometry = {60, 60, 0.05, -1.5, -1.5};
    grid_.cost = cost_.data();
    ControlSetup control;
    control.limits = setup_.limits;
    control.footprint = setup_.footprint;
    controller_ = make_controller("regulated_pure_pursuit", control);
  }

  void block(double x, double y) {
    cost_[grid_.geometry.index(grid_.geometry.cell(x, y))] = kLethalCost;
  }

  /// Runs a recovery on a robot that follows commands; returns its note, "" when it has no end.
  std::string run(Recovery& recovery) {
    const FootprintChecker checker(setup_.footprint);
    recovery.start();
    turned_ = least_ = most_ = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const RecoveryStep step =
          recovery.step({state_.time_s, state_, grid_, {}, trail_, world_, *controller_});
      if (step.is_done) return step.note;
      state_.twist =
          reachable_window(setup_.limits, state_.twist, setup_.period_s).clamp(step.twist);
      state_.pose = integrate(state_.pose, state_.twist, setup_.period_s);
      state_.time_s += setup_.period_s;
      turned_ += state_.twist.wz * setup_.period_s;
      least_ = std::min(least_, turned_);
      most_ = std::max(most_, turned_);
      is_free_ = is_free_ && checker.is_free(grid_, state_.pose);
    }
    return "";
  }
  std::unique_ptr<Recovery> make(const std::string& plugin, const std::string& keys = "{}") {
    return builtin_recoveries().get(plugin)(setup_, parse_yaml(keys, "test"), "test");
  }

  std::vector<std::uint8_t> cost_;
  CostGrid grid_;
  RecoverySetup setup_;
  RobotState state_;
  Path trail_;
  NoWorld world_;
  std::unique_ptr<Controller> controller_;
  double turned_ = 0.0, least_ = 0.0, most_ = 0.0;
  bool is_free_ = true;
};

TEST_F(RecoveryTest, ATurnLeavesTheRoomThatTheGuardKeeps) {
  block(0.275, 0.225);  // 4 mm beyond the circle that the corners turn on
  run(*make("rotate_recovery/RotateRecovery"));
  EXPECT_LT(most_ - least_, 6.0);
  EXPECT_GT(most_ - least_, 1.0);
}

TEST_F(RecoveryTest, TurnsOnceAroundWhereThereIsRoom) {
  const auto rotate = make("rotate_recovery/RotateRecovery");
  EXPECT_NE(run(*rotate), "");
  EXPECT_NEAR(std::fabs(turned_), 2.0 * kPi, 0.1);
  EXPECT_NEAR(state_.pose.x, 0.0, 1e-6);
}

TEST_F(RecoveryTest, TurnsToAndFroAsFarAsTheFootprintIsFree) {
  block(0.0, 0.25);
  block(0.1, -0.25);
  const auto rotate = make("rotate_recovery/RotateRecovery");
  EXPECT_NE(run(*rotate), "");
  EXPECT_TRUE(is_free_);
  EXPECT_LT(least_, -0.3);
  EXPECT_GT(most_, 0.3);
  EXPECT_LT(most_ - least_, kPi);
}

TEST_F(RecoveryTest, DoesNotTurnWithoutRoom) {
  for (double x = -0.3; x <= 0.3; x += 0.05) {
    block(x, 0.13);
    block(x, -0.13);
  }
  const auto rotate = make("rotate_recovery/RotateRecovery");
  EXPECT_EQ(run(*rotate), "The footprint has no room to turn on the spot.");
  EXPECT_EQ(turned_, 0.0);
}

TEST_F(RecoveryTest, GoesBackAlongTheTrail) {
  for (double x = -1.0; x < 0.0; x += 0.05) trail_.push_back({x, 0.0, 0.0});
  const auto retreat = make("trident_nav/Retreat");
  EXPECT_EQ(run(*retreat), "The robot went back along its trail.");
  EXPECT_TRUE(is_free_);
  EXPECT_LT(state_.pose.x, -0.2);
  EXPECT_GT(state_.pose.x, -0.8);
}

TEST_F(RecoveryTest, GoesBackBetweenWallsWhereItCannotTurn) {
  for (double x = -1.4; x < 0.4; x += 0.05) {
    block(x, 0.175);
    block(x, -0.175);
  }
  for (double x = -1.0; x < 0.0; x += 0.05) trail_.push_back({x, 0.0, 0.0});
  state_.pose = {0.0, 0.01, 0.05};
  const auto retreat = make("trident_nav/Retreat");
  EXPECT_EQ(run(*retreat), "The robot went back along its trail.");
  EXPECT_TRUE(is_free_);
  EXPECT_LT(state_.pose.x, -0.4);
  EXPECT_LT(most_ - least_, 0.3);
}

TEST_F(RecoveryTest, ARetreatEndsWhereSomethingHasComeBehind) {
  for (double y = -0.5; y <= 0.5; y += 0.05) block(-0.45, y);
  for (double x = -1.0; x < 0.0; x += 0.05) trail_.push_back({x, 0.0, 0.0});
  const auto retreat = make("trident_nav/Retreat");
  EXPECT_EQ(run(*retreat), "Retreat is blocked.");
  EXPECT_TRUE(is_free_);
}

TEST_F(RecoveryTest, ClearsWhatItShould) {
  const auto clear = make("clear_costmap_recovery/ClearCostmapRecovery",
                          "{reset_distance: 1.5, affected_maps: local, layer_names: [sonar]}");
  EXPECT_NE(run(*clear).find("1.5 m"), std::string::npos);
  EXPECT_EQ(world_.forgotten.side_m, 1.5);
  EXPECT_EQ(world_.forgotten.side, Layer::Side::kOutside);
  EXPECT_EQ(world_.forgotten.maps, AffectedMaps::kLocal);
  EXPECT_EQ(world_.forgotten.layers, std::vector<std::string>{"sonar"});
}

TEST_F(RecoveryTest, ForgetsWhatIsCloseAndWantsToDriveSlowly) {
  const auto slow = make("move_slow_and_clear/MoveSlowAndClear",
                         "{clearing_distance: 0.75, limited_trans_speed: 0.1}");
  slow->start();
  const RecoveryStep step =
      slow->step({state_.time_s, state_, grid_, {}, trail_, world_, *controller_});
  EXPECT_TRUE(step.is_done);
  EXPECT_EQ(world_.forgotten.side_m, 1.5);
  EXPECT_EQ(world_.forgotten.side, Layer::Side::kInside);
  ASSERT_TRUE(step.slow);
  EXPECT_EQ(step.slow->trans_max, 0.1);
  EXPECT_EQ(step.slow->rot_max, 0.45);
  EXPECT_EQ(step.slow->distance_m, 0.3);
}

TEST(SlowDrive, KeepsTheCurvatureOfACommand) {
  const SlowDrive slow{0.2, 0.5, 1.0};
  const Twist2 fast = slow.limited({0.8, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(fast.vx, 0.2);
  EXPECT_DOUBLE_EQ(fast.wz, 0.25);
  const Twist2 turning = slow.limited({0.1, 0.0, -2.0});
  EXPECT_DOUBLE_EQ(turning.vx, 0.025);
  EXPECT_DOUBLE_EQ(turning.wz, -0.5);
  const Twist2 gentle = slow.limited({0.1, 0.0, 0.2});
  EXPECT_DOUBLE_EQ(gentle.vx, 0.1);
}

TEST_F(RecoveryTest, AnUnknownNameListsTheKnownOnes) {
  try {
    make("rotate_recovery/RotateRecovry");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("rotate_recovery/RotateRecovery"), std::string::npos);
  }
}

}  // namespace
}  // namespace trident::nav
