// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What every registered controller keeps. A new one is tested by being registered.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "control/scene.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/control/motion.h"

namespace trident::nav::testing {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-9;

// Names without a package are those of the laws; the others are the same ones for ROS users.
std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const std::string& name : builtin_control_laws().names()) {
    if (name.find_first_of("/:") == std::string::npos) names.push_back(name);
  }
  return names;
}

GridWorld open_world() {
  GridWorld world(6.0, 4.0);
  world.fill({0.0, 0.0, 6.0, 0.1});
  world.fill({0.0, 3.9, 6.0, 4.0});
  world.inflate(0.165, 0.6, 5.0);
  return world;
}

Path straight_path(const Pose2& from, const Pose2& to, int count = 40) {
  Path path;
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    path.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                    std::atan2(to.y - from.y, to.x - from.x)});
  }
  path.back().yaw = to.yaw;
  return path;
}

// The period of the command and the hardest braking after it, in contact with nothing.
bool is_braking_free(const ControlSetup& setup, const FootprintChecker& body, const CostGrid& grid,
                     const Twist2& command, RobotState state) {
  if (!follow_command(setup, body, grid, command, &state)) return false;
  constexpr double kStep = 0.002;  // [s]
  while (state.twist.vx != 0.0 || state.twist.vy != 0.0 || state.twist.wz != 0.0) {
    state.twist = braked(setup.limits, state.twist, kStep);
    state.pose = integrate(state.pose, state.twist, kStep);
    if (!body.is_free(grid, state.pose)) return false;
  }
  return true;
}

void expect_within_limits(const MotionLimits& limits, const Twist2& twist) {
  EXPECT_LE(twist.vx, limits.vx_max + kRounding);
  EXPECT_GE(twist.vx, limits.vx_min - kRounding);
  EXPECT_LE(std::fabs(twist.vy), limits.vy_max + kRounding);
  EXPECT_LE(std::fabs(twist.wz), limits.wz_max + kRounding);
  if (limits.min_turning_radius > 0.0) {
    EXPECT_LE(std::fabs(twist.wz) * limits.min_turning_radius, std::fabs(twist.vx) + kRounding);
  }
}

class ControllerConformance : public ::testing::TestWithParam<std::string> {
 protected:
  static std::unique_ptr<Controller> make(const ControlSetup& setup) {
    return make_controller(GetParam(), setup);
  }
};

TEST_P(ControllerConformance, DrivesFreeOfContactWithinItsLimits) {
  for (const ControlSetup& setup : {jackal(), car(), omni_robot()}) {
    const Drive result = drive(*make(setup), setup, corner_scene(setup.footprint), 20.0);
    EXPECT_FALSE(result.has_contact);
    EXPECT_LE(result.max_acceleration_ratio, 1.0 + kRounding);
    for (const Twist2& twist : result.commands) expect_within_limits(setup.limits, twist);
  }
}

TEST_P(ControllerConformance, AGoalBehindAWallIsNotReachedAndTheReasonIsNamed) {
  const ControlSetup setup = jackal();
  GridWorld world = open_world();
  world.fill({3.0, 0.0, 3.1, 4.0});
  world.inflate(0.165, 0.6, 5.0);
  const Pose2 start{1.0, 2.0, 0.0};
  const Pose2 goal{5.0, 2.0, 0.0};
  const Drive result =
      drive(*make(setup), setup, {"wall", world, start, goal}, 15.0, straight_path(start, goal));
  EXPECT_FALSE(result.has_contact);
  EXPECT_FALSE(result.is_reached);
  EXPECT_TRUE(result.failures == 0 || !result.last_reason.empty());
}

TEST_P(ControllerConformance, TheBrakingTrajectoryIsFreeInTheNewestMap) {
  const ControlSetup setup = jackal();
  const FootprintChecker body(setup.footprint);
  const auto controller = make(setup);
  const RandomStream random(3, "boxes");
  const Pose2 goal{5.0, 2.0, 0.0};
  RobotState state{{0.8, 2.0, 0.0}, {}, 0.0};
  const Path path = straight_path(state.pose, goal);
  int judged = 0;
  for (std::uint64_t i = 0; i < 120; ++i) {
    // Obstacles come and go around the robot, too near for some commands.
    GridWorld world = open_world();
    const double x = state.pose.x + 0.3 + random.uniform(i / 8, 0);
    const double y = state.pose.y - 0.6 + 1.2 * random.uniform(i / 8, 1);
    if ((i / 8) % 2 == 1) world.fill({x, y, x + 0.1, y + 0.1});
    const CostGrid grid = world.grid();
    const CommandOutcome outcome = controller->command(state, path, grid, {});
    expect_within_limits(setup.limits, outcome.twist);
    if (outcome.failure != Failure::kNone) {
      EXPECT_FALSE(outcome.reason.empty());
      EXPECT_TRUE(are_equal(outcome.twist, braked(setup.limits, state.twist, setup.period_s)));
    } else if (body.is_free(grid, state.pose)) {
      ++judged;
      EXPECT_TRUE(is_braking_free(setup, body, grid, outcome.twist, state))
          << "command " << i << ": " << outcome.twist.vx << " " << outcome.twist.wz << " at "
          << state.pose.x << " " << state.pose.y << " " << state.pose.yaw << " with "
          << state.twist.vx << " " << state.twist.wz << ", box at " << x << " " << y;
    }
    // The robot moves on; what the next map says is what counts.
    follow_command(setup, body, open_world().grid(), outcome.twist, &state);
  }
  EXPECT_GT(judged, 40);
}

TEST_P(ControllerConformance, TwoRunsAndARunAfterAResetGiveEqualBits) {
  const ControlSetup setup = jackal();
  const Scene scene = doorway_scene(setup.footprint);
  const auto controller = make(setup);
  const Drive first = drive(*controller, setup, scene, 4.0);
  EXPECT_TRUE(are_equal(first, drive(*make(setup), setup, scene, 4.0)));
  controller->reset();
  EXPECT_TRUE(are_equal(first, drive(*controller, setup, scene, 4.0)));
}

TEST_P(ControllerConformance, BadInputIsNamedAndDoesNotOutliveItsCall) {
  const ControlSetup setup = jackal();
  const auto controller = make(setup);
  const GridWorld world = open_world();
  const RobotState state{{1.0, 2.0, 0.0}, {0.5, 0.0, 0.1}, 0.0};
  const Path path = straight_path(state.pose, {4.0, 2.0, 0.0});
  const auto expect_refusal = [&](const RobotState& bad, const Path& bad_path, const CostGrid& grid,
                                  Failure failure) {
    const CommandOutcome outcome = controller->command(bad, bad_path, grid, {});
    EXPECT_EQ(outcome.failure, failure);
    EXPECT_FALSE(outcome.reason.empty());
    EXPECT_TRUE(is_finite(outcome.twist));
    EXPECT_LE(std::fabs(outcome.twist.vx), 0.5);
  };
  RobotState lost = state;
  lost.pose.x = kNaN;
  expect_refusal(lost, path, world.grid(), Failure::kInvalidInput);
  lost = state;
  lost.twist.wz = kNaN;
  expect_refusal(lost, path, world.grid(), Failure::kInvalidInput);
  expect_refusal(state, {}, world.grid(), Failure::kInvalidPath);
  Path torn = path;
  torn[3].y = kNaN;
  expect_refusal(state, torn, world.grid(), Failure::kInvalidInput);
  expect_refusal(state, path, CostGrid{}, Failure::kInvalidInput);
  EXPECT_EQ(controller->command(state, path, world.grid(), {}).failure, Failure::kNone);
}

TEST_P(ControllerConformance, APathOfOnePoseIsDriven) {
  const ControlSetup setup = jackal();
  const Scene scene{"one pose", open_world(), {2.0, 2.0, 0.0}, {3.0, 2.2, 0.5}};
  const Drive result = drive(*make(setup), setup, scene, 20.0, {scene.goal});
  EXPECT_TRUE(result.is_reached) << result.last_reason;
}

TEST_P(ControllerConformance, AGoalBehindIsReached) {
  const ControlSetup setup = jackal();
  const Scene scene{"behind", open_world(), {3.0, 2.0, 0.0}, {1.5, 2.0, 3.0}};
  const Drive result =
      drive(*make(setup), setup, scene, 30.0, straight_path(scene.start, scene.goal));
  EXPECT_TRUE(result.is_reached) << result.last_reason;
  EXPECT_FALSE(result.has_contact);
}

TEST_P(ControllerConformance, UnknownSpaceIsEnteredOnlyWhereItIsFree) {
  ControlSetup setup = jackal();
  GridWorld world = open_world();
  world.fill({3.0, 0.1, 3.6, 3.9}, kUnknownCost);
  const Pose2 start{1.0, 2.0, 0.0};
  const Pose2 goal{5.0, 2.0, 0.0};
  const Path path = straight_path(start, goal);
  const Scene scene{"unknown", world, start, goal};
  EXPECT_TRUE(drive(*make(setup), setup, scene, 20.0, path).is_reached);
  setup.unknown = UnknownCells::kOccupied;
  const Drive held = drive(*make(setup), setup, scene, 10.0, path);
  EXPECT_FALSE(held.is_reached);
  const FootprintChecker strict(setup.footprint, UnknownCells::kOccupied);
  const CostGrid grid = world.grid();
  for (const Pose2& pose : held.track) EXPECT_TRUE(strict.is_free(grid, pose));
}

TEST_P(ControllerConformance, AMapOfOneCellAndAPathOfTenThousandPosesAreSurvived) {
  const ControlSetup setup = jackal();
  const GridWorld cell(0.05, 0.05);
  const RobotState state{{0.02, 0.02, 0.0}, {}, 0.0};
  const Path path = straight_path(state.pose, {4.0, 0.02, 0.0});
  const CommandOutcome outcome = make(setup)->command(state, path, cell.grid(), {});
  EXPECT_TRUE(is_finite(outcome.twist));
  const GridWorld world = open_world();
  const RobotState there{{1.0, 2.0, 0.0}, {}, 0.0};
  const Path dense = straight_path(there.pose, {5.0, 2.0, 0.0}, 10000);
  const CommandOutcome driven = make(setup)->command(there, dense, world.grid(), {});
  EXPECT_EQ(driven.failure, Failure::kNone) << driven.reason;
}

TEST_P(ControllerConformance, ARobotThatIsTooFastIsBrakedAtItsLimits) {
  const ControlSetup setup = jackal();
  const GridWorld world = open_world();
  const RobotState state{{1.0, 2.0, 0.0}, {2.0 * setup.limits.vx_max, 0.0, 0.0}, 0.0};
  const Path path = straight_path(state.pose, {5.0, 2.0, 0.0});
  const CommandOutcome outcome = make(setup)->command(state, path, world.grid(), {});
  EXPECT_NEAR(outcome.twist.vx, state.twist.vx - setup.limits.decel_max * setup.period_s,
              kRounding);
}

TEST_P(ControllerConformance, StandsOrHasPassedWhenAWalkerIsThere) {
  constexpr double kStands = 0.05;  // [m/s]
  constexpr double kRadius = 0.25;  // of the walker [m]
  const ControlSetup setup = jackal();
  const FootprintChecker body(setup.footprint);
  const GridWorld world = open_world();
  const CostGrid grid = world.grid();
  for (const double speed : {0.4, 0.8, 1.2}) {
    const auto controller = make(setup);
    RobotState state{{0.8, 2.0, 0.0}, {}, 0.0};
    const Path path = straight_path(state.pose, {5.0, 2.0, 0.0});
    for (int i = 0; i < 160; ++i) {
      const Track walker{1, {3.0, 3.5 - speed * state.time_s}, {0.0, -speed}, kRadius, {}};
      const CommandOutcome outcome = controller->command(state, path, grid, {walker});
      ASSERT_TRUE(follow_command(setup, body, grid, outcome.twist, &state));
      const Point2 p = walker.position_at(setup.period_s);
      const double reach = setup.footprint.circumscribed_radius + kRadius;
      if (distance(p.x, p.y, state.pose.x, state.pose.y) < reach) {
        EXPECT_LE(std::fabs(state.twist.vx), kStands)
            << "walker at " << speed << " m/s, " << p.y << " m; robot at " << state.pose.x
            << " m after " << state.time_s << " s: " << outcome.reason;
      }
    }
  }
}

struct BadSetup {
  const char* key;
  const char* range;
  std::function<void(ControlSetup&, double)> set;
  std::vector<double> values;
};

TEST_P(ControllerConformance, LimitsThatAreNoneAreRefusedByKeyValueAndRange) {
  const std::vector<double> none = {0.0, -1.0, kNaN};
  const BadSetup rows[] = {
      {"vx_max", "> 0", [](ControlSetup& s, double v) { s.limits.vx_max = v; }, none},
      {"ax_max", "> 0", [](ControlSetup& s, double v) { s.limits.ax_max = v; }, none},
      {"decel_max", "> 0", [](ControlSetup& s, double v) { s.limits.decel_max = v; }, none},
      {"alpha_max", "> 0", [](ControlSetup& s, double v) { s.limits.alpha_max = v; }, none},
      {"wz_max", "> 0", [](ControlSetup& s, double v) { s.limits.wz_max = v; }, none},
      {"period", "> 0", [](ControlSetup& s, double v) { s.period_s = v; }, none},
      {"vx_min", "<= 0", [](ControlSetup& s, double v) { s.limits.vx_min = v; }, {0.1, kNaN}},
      {"vy_max", ">= 0", [](ControlSetup& s, double v) { s.limits.vy_max = v; }, {-1.0, kNaN}},
      {"min_turning_radius",
       ">= 0",
       [](ControlSetup& s, double v) { s.limits.min_turning_radius = v; },
       {-1.0, kNaN}},
  };
  for (const BadSetup& row : rows) {
    for (const double value : row.values) {
      ControlSetup setup = jackal();
      row.set(setup, value);
      try {
        make(setup);
        ADD_FAILURE() << row.key << " " << value << " was taken";
      } catch (const Error& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find(row.key), std::string::npos) << what;
        EXPECT_NE(what.find(row.range), std::string::npos) << what;
      }
    }
  }
}

TEST_P(ControllerConformance, AKeyThatNobodyKnowsIsRefusedByName) {
  const ConfigNode params = parse_yaml("{no_such_key: 1}", "test.yaml");
  try {
    make_controller(GetParam(), jackal(), params, "test.yaml");
    ADD_FAILURE() << "the key was taken";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.key(), "no_such_key") << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, ControllerConformance, ::testing::ValuesIn(law_names()),
                         [](const auto& info) { return info.param; });

TEST(ControllerNames, EachMakesAController) {
  for (const std::string& name : builtin_control_laws().names()) {
    EXPECT_NE(make_controller(name, jackal()), nullptr) << name;
  }
  try {
    make_controller("dwa_local_planner/DWAPlannerRos", jackal());
    ADD_FAILURE() << "the name was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("DWAPlannerROS"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace trident::nav::testing
