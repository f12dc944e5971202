// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/navigator/navigator.h"

#include <gtest/gtest.h>

#include <utility>

#include "trident_base/angle.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav {
namespace {

/// Answers as it is scripted.
class ScriptedWorld : public NavigatorWorld {
 public:
  void request_plan(const Pose2& start, const Pose2& goal) override {
    ++requests;
    if (plan_failure.empty()) {
      outcome = PlanOutcome{path.empty() ? Path{start, goal} : path, Failure::kNone, "", 1.0};
    } else {
      outcome = PlanOutcome{{}, Failure::kNoPath, plan_failure, 0.0};
    }
  }
  std::optional<PlanOutcome> take_plan() override { return std::exchange(outcome, std::nullopt); }
  void cancel_plan() override { outcome.reset(); }
  double path_cost(const Path& path, std::size_t) override {
    return distance(path.front().x, path.front().y, path.back().x, path.back().y);
  }
  void avoid(const Path& ahead) override { avoided += ahead.empty() ? 0 : 1; }
  void forget(const ClearedArea& area) override { forgotten.push_back(area); }
  std::vector<StaleSource> stale_sources(double) override { return stale; }
  std::string obstacle_text(const Pose2&) override { return "A box is ahead."; }

  Path path;  ///< Empty: straight to the goal.
  std::string plan_failure;
  std::optional<PlanOutcome> outcome;
  std::vector<ClearedArea> forgotten;
  std::vector<StaleSource> stale;
  int requests = 0, avoided = 0;
};

class ScriptedController : public Controller {
 public:
  CommandOutcome command(const RobotState& state, const Path&, const CostGrid&,
                         const Tracks&) override {
    seen = state;
    return outcome;
  }
  void reset() override {}
  RobotState seen;
  CommandOutcome outcome{{0.3, 0.0, 0.0}, Failure::kNone, "", false};
};

class ScriptedNavigator : public ::testing::Test {
 protected:
  ScriptedNavigator() {
    parts_.limits = {0.5, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 2.0, 0.0};
    parts_.footprint = circle_footprint(0.2);
    parts_.params.controller_frequency = 10.0;
    costs_.assign(100 * 100, kFreeCost);
  }

  Navigator make(std::vector<NamedRecovery> recoveries = {}) {
    parts_.recoveries = std::move(recoveries);
    return {std::move(parts_), world_, controller_};
  }
  std::vector<NamedRecovery> clearings(int count) {
    std::vector<NamedRecovery> result;
    for (int i = 0; i < count; ++i) {
      result.push_back({"clear_" + std::to_string(i),
                        builtin_recoveries().get("clear_costmap_recovery/ClearCostmapRecovery")(
                            {}, parse_yaml("{}", "test"), "test")});
    }
    return result;
  }
  /// Steps until the goal has an outcome, at most so long.
  NavigatorOutput run(Navigator& navigator, double limit_s) {
    NavigatorOutput output;
    for (const double end_s = input_.now_s + limit_s; input_.now_s < end_s;) {
      output = step(navigator);
      if (output.status != NavigatorStatus::kActive) break;
    }
    return output;
  }
  NavigatorOutput step(Navigator& navigator) {
    input_.local.geometry = {100, 100, 0.05, 0.0, 0.0};
    input_.local.cost = costs_.data();
    const NavigatorOutput output = navigator.step(input_);
    if (output.recovery) recoveries_.push_back(*output.recovery);
    input_.now_s += 0.1;
    input_.state.time_s = input_.now_s;
    return output;
  }

  NavigatorParts parts_;
  ScriptedWorld world_;
  ScriptedController controller_;
  NavigatorInput input_;
  std::vector<std::uint8_t> costs_;
  std::vector<RecoveryNote> recoveries_;
};

TEST_F(ScriptedNavigator, SaysNothingWithoutAGoal) {
  Navigator navigator = make();
  const NavigatorOutput output = step(navigator);
  EXPECT_EQ(output.status, NavigatorStatus::kIdle);
  EXPECT_EQ(world_.requests, 0);
}

TEST_F(ScriptedNavigator, CommandsInTheStepAfterTheGoalAndEndsWithUpstreamsSentence) {
  Navigator navigator = make();
  navigator.set_goal({2.0, 2.0, 0.0}, 0.0);
  const NavigatorOutput first = step(navigator);
  EXPECT_EQ(first.status, NavigatorStatus::kActive);
  EXPECT_TRUE(first.has_new_path);
  EXPECT_DOUBLE_EQ(first.twist.vx, 0.3);
  controller_.outcome.goal_reached = true;
  const NavigatorOutput last = step(navigator);
  EXPECT_EQ(last.status, NavigatorStatus::kSucceeded);
  EXPECT_EQ(last.text, "Goal reached.");
  EXPECT_FALSE(navigator.is_active());
}

TEST_F(ScriptedNavigator, WithoutAPlanTriesEachRecoveryOnceAndSaysWhy) {
  world_.plan_failure = "The goal (9.00, 9.00) is walled in.";
  Navigator navigator = make(clearings(2));
  navigator.set_goal({9.0, 9.0, 0.0}, 0.0);
  const NavigatorOutput output = run(navigator, 60.0);
  EXPECT_EQ(output.status, NavigatorStatus::kAborted);
  EXPECT_EQ(output.text,
            "Failed to find a valid plan. Even after executing recovery behaviors. The goal (9.00, "
            "9.00) is walled in. planner_patience of 5 s is over.");
  ASSERT_EQ(recoveries_.size(), 2U);
  EXPECT_EQ(recoveries_[1].name, "clear_1");
  EXPECT_EQ(recoveries_[1].index, 1U);
  EXPECT_EQ(world_.forgotten.size(), 2U);
  EXPECT_GT(input_.now_s, 5.0);
  EXPECT_LT(input_.now_s, 9.0);
}

TEST_F(ScriptedNavigator, CountsPlansWhereRetriesAreLimited) {
  world_.plan_failure = "No path.";
  parts_.params.max_planning_retries = 2;
  Navigator navigator = make();
  navigator.set_goal({}, 0.0);
  const NavigatorOutput output = run(navigator, 4.0);
  EXPECT_EQ(output.status, NavigatorStatus::kAborted);
  EXPECT_EQ(world_.requests, 3);
  EXPECT_NE(output.text.find("max_planning_retries of 2"), std::string::npos) << output.text;
}

TEST_F(ScriptedNavigator, WithoutACommandBrakesReplansAndSaysWhatBlocksIt) {
  parts_.params.controller_patience = 3.0;
  controller_.outcome = {{}, Failure::kBlocked, "Every trajectory is in contact.", false};
  Navigator navigator = make(clearings(1));
  navigator.set_goal({2.0, 0.0, 0.0}, 0.0);
  const NavigatorOutput output = run(navigator, 20.0);
  EXPECT_EQ(output.text,
            "Failed to find a valid control. Even after executing recovery behaviors. Every "
            "trajectory is in contact. A box is ahead. controller_patience of 3 s is over.");
  EXPECT_EQ(recoveries_.size(), 1U);
  EXPECT_GE(world_.requests, 6);
}

TEST_F(ScriptedNavigator, ARobotThatGetsNowhereOscillates) {
  parts_.params.oscillation_timeout = 4.0;
  Navigator navigator = make();
  navigator.set_goal({2.0, 0.0, 0.0}, 0.0);
  const NavigatorOutput output = run(navigator, 20.0);
  EXPECT_EQ(output.status, NavigatorStatus::kAborted);
  EXPECT_EQ(output.text.rfind("Robot is oscillating. Even after executing recovery behaviors. "
                              "Within oscillation_timeout of 4 s",
                              0),
            0U)
      << output.text;
}

TEST_F(ScriptedNavigator, ARobotThatShuttlesByItsPathDoesNotOscillate) {
  constexpr double kPart_m = 0.05;
  parts_.params.oscillation_timeout = 4.0;
  parts_.params.oscillation_distance = 0.2;
  world_.path = {{0.0, 0.0, 0.001}};
  for (int i = 1; i <= 40; ++i) world_.path.push_back({i % 2 == 0 ? 0.0 : kPart_m, 0.0, 0.001});
  world_.path.push_back({3.0, 0.0, 0.001});
  Navigator navigator = make();
  navigator.set_goal({3.0, 0.0, 0.0}, 0.0);
  step(navigator);
  for (int i = 1; i <= 40; ++i) {
    input_.state.pose = input_.robot_global = world_.path[static_cast<std::size_t>(i)];
    for (int k = 0; k < 5; ++k) {
      ASSERT_EQ(step(navigator).status, NavigatorStatus::kActive) << "part " << i;
    }
  }
  // Where it stays, it gets nowhere.
  EXPECT_EQ(run(navigator, 10.0).status, NavigatorStatus::kAborted);
}

TEST_F(ScriptedNavigator, ACarTakesTheNextPlanOnceItsPathTouchesSomething) {
  const auto replaces = [&](double min_turning_radius) {
    parts_.limits.min_turning_radius = min_turning_radius;
    parts_.params.planner_frequency = 5.0;
    parts_.params.controller_frequency = 10.0;
    controller_.outcome.failure = Failure::kNone;
    Navigator navigator = make();
    navigator.set_goal({3.0, 0.0, 0.0}, input_.now_s);
    for (int i = 0; i < 10; ++i) step(navigator);
    controller_.outcome.failure = Failure::kBlocked;
    bool is_new = false;
    for (int i = 0; i < 5; ++i) is_new = step(navigator).has_new_path || is_new;
    return is_new;
  };
  EXPECT_TRUE(replaces(0.75));
  EXPECT_FALSE(replaces(0.0));
}

TEST_F(ScriptedNavigator, BrakesAsHardThoughOdometryIsLate) {
  Navigator navigator = make();
  navigator.set_goal({30.0, 0.0, 0.0}, 0.0);
  controller_.outcome.twist.vx = 0.5;
  input_.state.twist.vx = 0.5;
  for (int i = 0; i < 5; ++i) step(navigator);
  world_.stale.push_back({"obstacle_layer", "scan", "scan", 1.0, 0.3});
  // The limit is 1 m/s^2; what is measured is still the speed of before.
  EXPECT_NEAR(step(navigator).twist.vx, 0.4, 1e-9);
  EXPECT_NEAR(step(navigator).twist.vx, 0.3, 1e-9);
}

TEST_F(ScriptedNavigator, NoPatienceRunsOutWhileASourceIsSilent) {
  parts_.params.oscillation_timeout = 4.0;
  Navigator navigator = make();
  navigator.set_goal({2.0, 0.0, 0.0}, 0.0);
  step(navigator);
  ASSERT_DOUBLE_EQ(step(navigator).twist.vx, 0.3);
  world_.stale = {{"obstacle_layer", "scan", "/scan", 0.6, 0.3}};
  input_.state.twist = {0.3, 0.0, 0.0};
  EXPECT_NEAR(step(navigator).twist.vx, 0.2, 1e-9);  // the hardest braking
  // Odometry says the same for ever, as when it is silent itself.
  const NavigatorOutput output = run(navigator, 60.0);
  EXPECT_EQ(output.status, NavigatorStatus::kActive);
  EXPECT_EQ(output.twist.vx, 0.0);
  EXPECT_NE(output.waiting.find("/scan"), std::string::npos);
  world_.stale.clear();
  EXPECT_DOUBLE_EQ(step(navigator).twist.vx, 0.3);
}

TEST_F(ScriptedNavigator, RecoveriesBeginAgainOnlyOnceTheRobotGotSomewhere) {
  parts_.params.controller_patience = 1.0;
  Navigator navigator = make(clearings(1));
  navigator.set_goal({4.0, 0.0, 0.0}, 0.0);
  controller_.outcome.failure = Failure::kBlocked;
  while (recoveries_.empty()) step(navigator);
  controller_.outcome.failure = Failure::kNone;
  for (int i = 0; i < 10; ++i) {
    input_.state.pose.x += 0.1;
    input_.robot_global.x += 0.1;
    step(navigator);
  }
  controller_.outcome.failure = Failure::kBlocked;
  const NavigatorOutput output = run(navigator, 20.0);
  EXPECT_EQ(output.status, NavigatorStatus::kAborted);
  EXPECT_EQ(recoveries_.size(), 2U);
}

TEST_F(ScriptedNavigator, RecoveriesDoNotBeginAgainAtAPlaceWhereTheyWereTried) {
  Navigator navigator = make(clearings(2));
  navigator.set_goal({9.0, 9.0, 0.0}, 0.0);
  std::vector<std::string> names;
  for (int round = 0; round < 6; ++round) {
    world_.plan_failure.clear();
    // To the other place, which makes recoveries begin again.
    for (int i = 0; i < 30; ++i) {
      input_.state.pose.x += round % 2 == 0 ? 0.1 : -0.1;
      input_.robot_global = input_.state.pose;
      if (step(navigator).status != NavigatorStatus::kActive) break;
    }
    world_.plan_failure = "The goal (9.00, 9.00) is walled in.";
    controller_.outcome.failure = Failure::kBlocked;
    if (run(navigator, 16.5).status == NavigatorStatus::kAborted) break;
    controller_.outcome.failure = Failure::kNone;
  }
  for (const RecoveryNote& note : recoveries_) names.push_back(note.name);
  EXPECT_EQ(navigator.is_active(), false);
  EXPECT_LE(names.size(), 4U) << names.size();
}

TEST_F(ScriptedNavigator, ACanceledGoalLeavesTheRobotToOthers) {
  Navigator navigator = make();
  navigator.set_goal({2.0, 2.0, 0.0}, 0.0);
  step(navigator);
  navigator.cancel();
  EXPECT_EQ(step(navigator).status, NavigatorStatus::kIdle);
  EXPECT_TRUE(navigator.path().empty());
}

TEST(PathKeeper, KeepsAFreePathAgainstOneThatIsHardlyBetter) {
  ScriptedWorld world;
  NavigatorParams params;
  PathKeeper keeper(params);
  const Pose2 robot{0.0, 0.0, 0.0};
  const Path old = {{0, 0, 0}, {2, 1, 0}, {10, 0, 0}};
  EXPECT_TRUE(keeper.offer(old, 0.0, robot, 0.2, world));
  EXPECT_FALSE(keeper.offer({{0.9, 0, 0}, {10, 0, 0}}, 10.0, robot, 0.2, world));
  EXPECT_FALSE(keeper.offer({{5, 0, 0}, {10, 0, 0}}, 1.0, robot, 0.2, world));  // committed
  EXPECT_TRUE(keeper.offer({{5, 0, 0}, {10, 0, 0}}, 10.0, robot, 0.2, world));  // half the cost
  EXPECT_TRUE(keeper.offer(old, 10.5, {0.0, 5.0, 0.0}, 0.2, world));            // it was left
}

TEST(PathKeeper, DrivesEachPartOfAShuttleBeforeTheNext) {
  ScriptedWorld world;
  PathKeeper keeper(NavigatorParams{});
  Path path;
  for (int i = 0; i <= 4; ++i) path.push_back({0.01 * i, 0.0, 0.001});
  for (int i = 3; i >= 0; --i) path.push_back({0.01 * i, 0.0, 0.001});
  for (int i = 1; i <= 4; ++i) path.push_back({0.01 * i, 0.0, 0.001});
  ASSERT_TRUE(keeper.offer(path, 0.0, path.front(), 0.2, world));
  const auto left_at = [&](double x) {
    keeper.advance({x, 0.0, 0.001});
    return keeper.remaining().size();
  };
  EXPECT_NEAR(keeper.left_m({-0.03, 0.04, 0.0}), 0.05 + keeper.left_m({0.0, 0.0, 0.0}), 1e-9);
  EXPECT_NEAR(keeper.left_m({0.001, 0.0, 0.0}), keeper.left_m({0.0, 0.0, 0.0}) - 0.001, 1e-9);
  EXPECT_EQ(left_at(0.0), 13U);
  EXPECT_EQ(left_at(0.028), 12U);  // from two poses behind it
  EXPECT_EQ(left_at(0.0322), 12U);
  EXPECT_EQ(left_at(0.0324), 9U);  // it has stopped within a quarter of the part: from the cusp
  EXPECT_EQ(left_at(0.02), 9U);    // two poses behind it
  EXPECT_EQ(left_at(0.004), 5U);   // within millimeters
  EXPECT_EQ(left_at(0.04), 3U);
}

TEST_F(ScriptedNavigator, ARobotThatGetsNowhereLooksForAnotherPath) {
  Navigator navigator = make();
  navigator.set_goal({3.0, 0.0, 0.0}, 0.0);
  run(navigator, 3.0);  // turning around takes longer
  EXPECT_EQ(world_.avoided, 0);
  run(navigator, 3.0);
  EXPECT_EQ(world_.avoided, 1);
  EXPECT_TRUE(recoveries_.empty());
}

TEST_F(ScriptedNavigator, ARobotThatShuttlesGetsNowhere) {
  parts_.params.planner_frequency = 5.0;
  Navigator navigator = make();
  navigator.set_goal({3.0, 0.0, 0.0}, 0.0);
  for (int i = 0; i < 100; ++i) {
    const double x = 0.5 * std::sin(0.3 * i);  // farther than it is long, to either side
    input_.state.pose.x = input_.robot_global.x = x;
    step(navigator);
  }
  EXPECT_EQ(world_.avoided, 1);
  EXPECT_TRUE(recoveries_.empty());
}

TEST_F(ScriptedNavigator, ARobotThatGetsNowhereOnThePathThatNoPlanReplacesGivesUp) {
  Navigator navigator = make(clearings(1));
  navigator.set_goal({3.0, 0.0, 0.0}, 0.0);
  run(navigator, 1.0);
  world_.plan_failure = "The goal (3.00, 0.00) is walled in.";
  const NavigatorOutput output = run(navigator, 60.0);
  EXPECT_EQ(output.status, NavigatorStatus::kAborted);
  EXPECT_EQ(output.text.rfind("Failed to find a valid plan.", 0), 0U) << output.text;
  EXPECT_NE(output.text.find(world_.plan_failure), std::string::npos) << output.text;
  EXPECT_EQ(recoveries_.size(), 1U);
}

TEST_F(ScriptedNavigator, ARobotThatGetsOnKeepsItsPathThoughNoPlanReplacesIt) {
  parts_.params.planner_frequency = 5.0;
  Navigator navigator = make(clearings(1));
  navigator.set_goal({30.0, 0.0, 0.0}, 0.0);
  run(navigator, 1.0);
  world_.plan_failure = "The planner is out of order.";
  for (int i = 0; i < 200; ++i) {
    input_.state.pose.x += 0.03;
    input_.robot_global.x += 0.03;
    EXPECT_EQ(step(navigator).status, NavigatorStatus::kActive);
  }
  EXPECT_TRUE(recoveries_.empty());
}

TEST_F(ScriptedNavigator, NextToTheGoalNothingIsAvoided) {
  Navigator navigator = make();
  navigator.set_goal({0.3, 0.0, 0.0}, 0.0);
  run(navigator, 10.0);
  EXPECT_EQ(world_.avoided, 0);
}

TEST_F(ScriptedNavigator, AnOldStateIsTakenToWhereTheRobotIsNow) {
  Navigator navigator = make();
  navigator.set_goal({3.0, 0.0, 0.0}, 0.0);
  run(navigator, 0.3);
  input_.state.pose = {1.0, 1.0, kPi / 2.0};
  input_.state.twist = {0.5, 0.0, 0.0};
  input_.state.time_s = input_.now_s - 0.2;
  step(navigator);
  EXPECT_NEAR(controller_.seen.pose.x, 1.0, 1e-9);
  EXPECT_NEAR(controller_.seen.pose.y, 1.1, 1e-9);
  EXPECT_EQ(controller_.seen.time_s, input_.now_s - 0.1);
}

}  // namespace
}  // namespace trident::nav
