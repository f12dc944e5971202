// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What single control laws and their parameters do beyond what all of them keep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "control/config_split.h"
#include "control/dwb/dwb_critics.h"
#include "control/graceful/smooth_law.h"
#include "control/scene.h"
#include "control/trajectory_planner/dead_end_escape.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/control/motion.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav::testing {
namespace {

// The keys and values of Jackal's file in the BARN challenge that are not the robot's limits.
constexpr const char* kBarnParams = R"({
  min_vel_x: 0.1, min_vel_theta: -1.57, min_in_place_vel_theta: 0.314, holonomic_robot: false,
  escape_vel: -0.5, sim_time: 2.0, sim_granularity: 0.02, angular_sim_granularity: 0.02,
  vx_samples: 6, vtheta_samples: 20, controller_frequency: 20.0, meter_scoring: true,
  occdist_scale: 0.1, path_distance_bias: 0.75, goal_distance_bias: 1.0, heading_lookahead: 0.325,
  heading_scoring: false, heading_scoring_timestep: 0.8, dwa: true, simple_attractor: false,
  latch_xy_goal_tolerance: false, oscillation_reset_dist: 0.05, escape_reset_dist: 0.1,
  escape_reset_theta: 0.1})";

ControlSetup barn_jackal() {
  ControlSetup setup = jackal();
  setup.limits = {0.5, 0.0, 0.0, 1.57, 10.0, 10.0, 0.0, 20.0, 0.0};
  setup.tolerance.xy_goal_tolerance = 0.25;
  setup.tolerance.yaw_goal_tolerance = 0.157;
  return setup;
}

TEST(TrajectoryPlanner, TheFileOfTheBarnChallengeDrives) {
  const ControlSetup setup = barn_jackal();
  const ConfigNode params = parse_yaml(kBarnParams, "barn.yaml");
  for (const Scene& scene : {corner_scene(setup.footprint), dead_end_scene(setup.footprint)}) {
    const auto controller =
        make_controller("base_local_planner/TrajectoryPlannerROS", setup, params, "barn.yaml");
    const Drive result = drive(*controller, setup, scene, 90.0);
    EXPECT_TRUE(result.is_reached) << scene.name << ": " << result.last_reason;
    EXPECT_FALSE(result.has_contact) << scene.name;
  }
}

TEST(TrajectoryPlanner, ANarrowDeadEndIsLeftBackwardsThoughTheRobotsLimitsKnowNoReverse) {
  ControlSetup setup = barn_jackal();
  GridWorld world(5.0, 3.0);
  world.fill({2.6, 0.0, 2.7, 3.0});
  world.fill({1.2, 0.0, 2.7, 1.27});
  world.fill({1.2, 1.73, 2.7, 3.0});
  world.inflate(0.165, 0.5, 5.0);
  const Scene scene{"narrow", world, {2.3, 1.5, 0.0}, {0.6, 1.5, kPi}};
  const auto controller =
      make_controller("trajectory_planner", setup, parse_yaml(kBarnParams, "barn.yaml"));
  setup.limits.vx_min = -0.5;  // of the base
  const Drive result =
      drive(*controller, setup, scene, 60.0, {scene.start, {1.5, 1.5, 0.0}, scene.goal});
  EXPECT_TRUE(result.is_reached) << result.last_reason;
  EXPECT_FALSE(result.has_contact);
}

TEST(DeadEndEscape, GoesBackTwiceAsFarEachTime) {
  DeadEndEscape escape({0.1, 0.2, 2.0});
  RobotState state;
  for (const double far_m : {0.1, 0.2, 0.4, 0.8, 1.0, 1.0}) {
    state.pose.x = 0.0;
    escape.update(state);
    escape.begin(state);
    state.pose.x = -far_m + 0.01;
    escape.update(state);
    EXPECT_TRUE(escape.is_active()) << far_m;
    EXPECT_EQ(escape.is_straight(), far_m > 0.1);
    state.pose.x = -far_m - 0.01;
    escape.update(state);
    EXPECT_FALSE(escape.is_active()) << far_m;
    EXPECT_TRUE(escape.is_near_dead_end());
  }
  state.pose.x = -2.1;
  escape.update(state);
  EXPECT_FALSE(escape.is_near_dead_end());
}

TEST(DeadEndEscape, EndsByATurnTheFirstTimeAlone) {
  DeadEndEscape escape({0.1, 0.2, 2.0});
  RobotState state;
  escape.begin(state);
  state.pose.yaw = 0.3;
  escape.update(state);
  EXPECT_FALSE(escape.is_active());
  escape.begin(state);
  state.pose.yaw = 0.6;
  escape.update(state);
  EXPECT_TRUE(escape.is_active());
}

TEST(DeadEndEscape, ARobotThatDoesNotMoveForASecondIsStuck) {
  DeadEndEscape escape({0.1, 0.2, 2.0});
  RobotState state;
  for (int i = 0; i < 20; ++i) {
    state.time_s = 0.1 * i;
    EXPECT_EQ(escape.update(state), i == 10) << i;
    state.pose.yaw += 1e-3;
  }
}

TEST(TrajectoryPlanner, ATightBendIsDrivenWithoutShuttling) {
  ControlSetup setup = barn_jackal();
  GridWorld world(6.0, 4.0);
  // A passage, 0.17 m wider than the robot, and another one, 0.3 m to the left.
  world.fill({1.5, 0.0, 2.5, 1.475});
  world.fill({1.5, 1.975, 2.5, 4.0});
  world.fill({3.1, 0.0, 4.1, 1.775});
  world.fill({3.1, 2.275, 4.1, 4.0});
  world.inflate(0.165, 0.3, 10.0);
  const Scene scene{"bend", world, {0.8, 1.72, 0.0}, {5.3, 2.02, 0.0}};
  const Path path{scene.start, {2.5, 1.72, 0.0}, {3.1, 2.02, 0.0}, scene.goal};
  const auto controller =
      make_controller("trajectory_planner", setup, parse_yaml(kBarnParams, "barn.yaml"));
  setup.limits.vx_min = -0.5;  // of the base
  const Drive result = drive(*controller, setup, scene, 60.0, path);
  EXPECT_TRUE(result.is_reached) << result.last_reason;
  EXPECT_FALSE(result.has_contact);
  const auto backwards = std::count_if(result.commands.begin(), result.commands.end(),
                                       [](const Twist2& twist) { return twist.vx < 0.0; });
  EXPECT_LT(backwards, 20);        // a second
  EXPECT_LT(result.time_s, 18.0);  // at least 9.1 s
}

TEST(TrajectoryPlanner, EachKindOfScoringDrives) {
  const ControlSetup setup = jackal();
  for (const char* params : {"{heading_scoring: true}", "{simple_attractor: true}", "{dwa: false}",
                             "{meter_scoring: true, occdist_scale: 0.001}"}) {
    const auto controller = make_controller("trajectory_planner", setup, parse_yaml(params, "t"));
    const Drive result = drive(*controller, setup, straight_scene(setup.footprint));
    EXPECT_TRUE(result.is_reached) << params << " " << result.last_reason;
  }
}

TEST(RotationShim, TurnsOnTheSpotFirstAndThenFollows) {
  const ControlSetup setup = jackal();
  GridWorld world(6.0, 4.0);
  const Path path = {{3.0, 2.0, 0.0}, {4.0, 2.0, 0.0}, {5.0, 2.0, 0.0}};
  const RobotState state{{3.0, 2.0, 2.0}, {}, 0.0};
  const auto controller = make_controller(
      "nav2_rotation_shim_controller::RotationShimController", setup,
      parse_yaml("{primary_controller: 'nav2_mppi_controller::MPPIController', batch_size: 300, "
                 "rotate_to_heading_angular_vel: 1.0, max_angular_accel: 2.0}",
                 "shim.yaml"));
  const CommandOutcome outcome = controller->command(state, path, world.grid(), {});
  EXPECT_EQ(outcome.twist.vx, 0.0);
  EXPECT_NEAR(outcome.twist.wz, -2.0 * setup.period_s, 1e-9);
  const Drive result =
      drive(*controller, setup, {"turn", world, state.pose, path.back()}, 20.0, path);
  EXPECT_TRUE(result.is_reached);
  for (const Twist2& twist : result.commands) EXPECT_GE(twist.wz, -4.0);
}

TEST(RotationShim, KeysOfBothReachBothAndWrongOnesAreRefused) {
  const ControlSetup setup = jackal();
  const auto make = [&](const char* params) {
    return make_controller("rotation_shim", setup, parse_yaml(params, "shim.yaml"));
  };
  EXPECT_NO_THROW(make("{rotate_to_heading_angular_vel: 1.0, lookahead_dist: 0.7}"));
  EXPECT_THROW(make("{rotate_to_heading_angular_vel: -1.0}"), ConfigError);
  EXPECT_THROW(make("{batch_size: 100}"), ConfigError);
  EXPECT_THROW(make("{angular_dist_threshold: 0.2}"), ConfigError);
  EXPECT_THROW(make("{primary_controller: rotation_shim}"), ConfigError);
  EXPECT_THROW(make("{primary_controller: nobody}"), Error);
}

TEST(Graceful, TheCurveLeadsToThePoseAndItsHeading) {
  const RandomStream random(11, "targets");
  for (std::uint64_t i = 0; i < 50; ++i) {
    const double bearing = 2.4 * random.uniform(i, 0) - 1.2;
    const Pose2 target{2.0 * std::cos(bearing), 2.0 * std::sin(bearing),
                       bearing + 2.0 * random.uniform(i, 1) - 1.0};
    Pose2 robot{0.0, 0.0, 0.0};
    constexpr double kStep = 0.002;  // [m]
    for (int k = 0; k < 5000 && egocentric(robot, target, false).distance_m > 0.05; ++k) {
      const double bend = smooth_curvature(egocentric(robot, target, false), {2.0, 3.0});
      robot = integrate(robot, {kStep, 0.0, bend * kStep}, 1.0);
    }
    EXPECT_LE(distance(robot.x, robot.y, target.x, target.y), 0.05) << "target " << i;
    EXPECT_NEAR(wrap_angle(robot.yaw - target.yaw), 0.0, 0.15) << "target " << i;
  }
}

TEST(Graceful, BackwardIsTheMirrorOfForward) {
  const Pose2 ahead{1.0, 0.4, 0.3};
  const Pose2 behind{-1.0, -0.4, 0.3};
  const double forward = smooth_curvature(egocentric({}, ahead, false), {});
  const double backward = smooth_curvature(egocentric({}, behind, true), {});
  EXPECT_NEAR(forward, backward, 1e-12);
}

TEST(Graceful, APathBehindIsDrivenBackwardsWhereThatIsAllowed) {
  const ControlSetup setup = jackal();
  GridWorld world(6.0, 4.0);
  const Path path = {{4.0, 2.0, 0.0}, {3.0, 2.0, 0.0}, {2.0, 2.0, 0.0}};
  const auto controller = make_controller(
      "graceful", setup, parse_yaml("{allow_backward: true, prefer_final_rotation: false}", "g"));
  const Scene scene{"back", world, path.front(), path.back()};
  const Drive result = drive(*controller, setup, scene, 30.0, path);
  EXPECT_TRUE(result.is_reached) << result.last_reason;
  double highest = 0.0;
  for (const Twist2& twist : result.commands) highest = std::max(highest, twist.vx);
  EXPECT_LT(highest, 0.05);
}

TEST(Dwb, Nav2sFileWithDottedKeysDrives) {
  const ControlSetup setup = jackal();
  const char* const params = R"({
    critics: [RotateToGoal, Oscillation, BaseObstacle, GoalAlign, PathAlign, PathDist, GoalDist],
    trajectory_generator_name: 'dwb_plugins::LimitedAccelGenerator', decel_lim_x: -2.5,
    acc_lim_x: 2.5, sim_time: 1.7, linear_granularity: 0.05, angular_granularity: 0.025,
    BaseObstacle.scale: 0.02, PathAlign.scale: 32.0, PathAlign.forward_point_distance: 0.1,
    GoalAlign.scale: 24.0, GoalAlign.forward_point_distance: 0.1, PathDist.scale: 32.0,
    GoalDist.scale: 24.0, RotateToGoal.scale: 32.0, RotateToGoal.slowing_factor: 5.0,
    RotateToGoal.lookahead_time: -1.0})";
  const auto controller =
      make_controller("dwb_core::DWBLocalPlanner", setup, parse_yaml(params, "dwb.yaml"));
  const Drive result = drive(*controller, setup, corner_scene(setup.footprint));
  EXPECT_TRUE(result.is_reached) << result.last_reason;
}

TEST(Dwb, EachCriticHasANameAndDrives) {
  const ControlSetup setup = jackal();
  for (const std::string& name : dwb_critics().names()) {
    const std::string params = "{critics: [PathDist, GoalDist, 'dwb_critics::" + name + "Critic']}";
    const bool is_twice = name == "PathDist" || name == "GoalDist";
    const auto controller =
        make_controller("dwb", setup, parse_yaml(is_twice ? "{}" : params, "dwb.yaml"));
    const Drive result = drive(*controller, setup, straight_scene(setup.footprint), 20.0);
    EXPECT_TRUE(result.is_reached) << name << " " << result.last_reason;
  }
}

TEST(ControllerName, ColonsAndASlashAreTheSame) {
  EXPECT_EQ(controller_name("nav2_mppi_controller/MPPIController"),
            "nav2_mppi_controller::MPPIController");
  EXPECT_EQ(controller_name("dwa_local_planner::DWAPlannerROS"), "dwa_local_planner/DWAPlannerROS");
  EXPECT_EQ(controller_name("mppi"), "mppi");
  EXPECT_EQ(controller_name("nobody/Knows"), "nobody/Knows");
}

TEST(Dwb, UnknownCriticsAndKeysAreNamed) {
  const auto message = [](const char* params) -> std::string {
    try {
      make_controller("dwb", jackal(), parse_yaml(params, "dwb.yaml"), "dwb.yaml");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("{critics: [PathDits]}").find("PathDist"), std::string::npos);
  EXPECT_NE(message("{PathDist.scal: 1.0}").find("PathDist.scal"), std::string::npos);
  EXPECT_NE(message("{PathDist.scale: -1.0}").find(">= 0"), std::string::npos);
  EXPECT_NE(message("{PathDist: {scale: 1.0}, PathDist.scale: 2.0}").find("twice"),
            std::string::npos);
}

TEST(DottedKeys, BecomeMapsThatKeepTheirLines) {
  const ConfigNode map = expand_dotted_keys(parse_yaml("a.b: 1\na.c.d: 2\ne: 3\n", "t"), "t");
  ASSERT_EQ(map.keys.size(), 2U);
  const ConfigNode* const a = map.find("a");
  ASSERT_NE(a, nullptr);
  EXPECT_EQ(a->find("b")->scalar, "1");
  EXPECT_NE(a->find("c.d"), nullptr);
  EXPECT_EQ(a->key_lines[1], 2);
}

// Where a walker will be is what counts: he who goes out of the path is ignored, he who comes into
// it is not.
class PredictsWalkers : public ::testing::TestWithParam<const char*> {};

TEST_P(PredictsWalkers, FromTheSamePlaceByTheirVelocity) {
  const ControlSetup setup = jackal();
  GridWorld world(8.0, 6.0);
  const CostGrid grid = world.grid();
  const FootprintChecker body(setup.footprint);
  const auto made_good = [&](double speed) {
    const auto controller = make_controller(GetParam(), setup);
    RobotState state{{1.0, 3.0, 0.0}, {}, 0.0};
    const Path path = {{1.0, 3.0, 0.0}, {4.0, 3.0, 0.0}, {7.0, 3.0, 0.0}};
    for (int i = 0; i < 25; ++i) {
      const Track walker{1, {2.3, 4.0 + speed * state.time_s}, {0.0, speed}, 0.25, {}};
      const auto outcome = controller->command(state, path, grid, {walker});
      follow_command(setup, body, grid, outcome.twist, &state);
    }
    return state.pose.x;
  };
  const double leaves = made_good(1.0);
  const double comes = made_good(-1.0);
  EXPECT_GT(std::fabs(leaves - comes), 0.02) << leaves << " " << comes;
}

INSTANTIATE_TEST_SUITE_P(Laws, PredictsWalkers,
                         ::testing::Values("dwa", "dwb", "mppi", "teb", "trajectory_planner"),
                         [](const auto& info) { return std::string(info.param); });

// TurtleBot3's Waffle with move_forward_only: it is longer behind than to its sides.
constexpr const char* kWaffleParams = R"({
  min_vel_x: 0.0, min_vel_trans: 0.13, max_vel_trans: 0.26, min_vel_theta: 0.9, sim_time: 2.0,
  vx_samples: 20, vy_samples: 0, vth_samples: 40, path_distance_bias: 32.0,
  goal_distance_bias: 20.0, occdist_scale: 0.02, forward_point_distance: 0.325})";

ControlSetup waffle() {
  ControlSetup setup;
  setup.limits = {0.26, 0.0, 0.0, 1.82, 2.5, 2.5, 0.0, 3.2, 0.0};
  setup.footprint =
      polygon_footprint({{-0.205, -0.155}, {-0.205, 0.155}, {0.077, 0.155}, {0.077, -0.155}});
  setup.tolerance.xy_goal_tolerance = 0.05;
  setup.tolerance.yaw_goal_tolerance = 0.17;
  setup.period_s = 0.1;
  return setup;
}

Drive drive_waffle(const Scene& scene) {
  const ConfigNode params = parse_yaml(kWaffleParams, "waffle.yaml");
  const auto controller = make_controller("dwa", waffle(), params, "waffle.yaml");
  return drive(*controller, waffle(), scene);
}

TEST(Dwa, APillarIsPassedByARobotThatMayNotReverse) {
  const RandomStream random(7, "pillar");
  for (std::uint64_t i = 0; i < 16; ++i) {
    GridWorld world(4.0, 4.0);
    world.fill({1.825, 1.825, 2.175, 2.175});
    world.inflate(waffle().footprint.inscribed_radius, 1.0, 3.0);
    const double bearing = 2.0 * kPi * random.uniform(i, 0);
    const double c = std::cos(bearing), s = std::sin(bearing);
    const Pose2 start{2.0 + 0.7 * c, 2.0 + 0.7 * s, kPi * (2.0 * random.uniform(i, 1) - 1.0)};
    const Drive result =
        drive_waffle({"pillar", std::move(world), start, {2.0 - 1.3 * c, 2.0 - 1.3 * s, 0.0}});
    EXPECT_TRUE(result.is_reached) << i << ": at " << result.track.back().x << " "
                                   << result.track.back().y << ": " << result.last_reason;
  }
}

TEST(Dwa, ADoorInWhichTheRobotCannotTurnIsPassed) {
  constexpr double kWidth_m = 0.42, kY_m = 1.525;
  for (const double deep_m : {0.1, 0.8}) {
    GridWorld world(4.0, 3.0);
    world.fill({2.0, 0.0, 2.0 + deep_m, kY_m - 0.5 * kWidth_m});
    world.fill({2.0, kY_m + 0.5 * kWidth_m, 2.0 + deep_m, 3.0});
    world.inflate(waffle().footprint.inscribed_radius, 1.0, 3.0);
    const Drive result = drive_waffle({"door", std::move(world), {0.7, 1.2, 0.0}, {3.5, 1.5, 0.0}});
    EXPECT_TRUE(result.is_reached) << deep_m << ": " << result.last_reason;
  }
}

}  // namespace
}  // namespace trident::nav::testing
