// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Drives of the timed elastic band in the places that it is known to fail in.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "control/scene.h"
#include "control/teb/teb_planner.h"
#include "trident_base/angle.h"
#include "trident_base/random_stream.h"
#include "trident_base/yaml_config.h"

namespace trident::nav::testing {
namespace {

std::unique_ptr<Controller> make_teb(const ControlSetup& setup, const std::string& params = "{}") {
  return make_controller("teb_local_planner/TebLocalPlannerROS", setup,
                         parse_yaml(params, "teb.yaml"), "teb.yaml");
}

TEST(TebDrives, OutOfAUShapedObstacleAlongThePathAroundIt) {
  const ControlSetup setup = jackal();
  GridWorld world(8.0, 6.0);
  world.fill({3.0, 2.0, 4.5, 2.15});
  world.fill({3.0, 3.85, 4.5, 4.0});
  world.fill({4.5, 2.0, 4.65, 4.0});
  world.inflate(0.165, 0.6, 5.0);
  const Scene scene{"U", world, {3.8, 3.0, 0.0}, {6.5, 3.0, 0.0}};
  const Drive result = drive(*make_teb(setup), setup, scene, 40.0);
  EXPECT_FALSE(result.has_contact);
  EXPECT_TRUE(result.is_reached) << result.last_reason;
}

TEST(TebDrives, BetweenTwoObstaclesThatTheFootprintFitsBetween) {
  const ControlSetup setup = jackal();
  GridWorld world(6.0, 4.0);
  world.fill({2.8, 0.1, 3.2, 1.75});
  world.fill({2.8, 2.25, 3.2, 3.9});
  world.inflate(0.165, 0.6, 5.0);
  const Scene scene{"gap", world, {1.0, 2.0, 0.0}, {5.0, 2.0, 0.0}};
  const Drive result = drive(*make_teb(setup), setup, scene, 30.0);
  EXPECT_FALSE(result.has_contact);
  EXPECT_TRUE(result.is_reached) << result.last_reason;
}

TEST(TebDrives, ACarBacksIntoAParkingPlaceWithItsHeading) {
  const ControlSetup setup = car();  // 0.5 m long, turns about 0.5 m
  GridWorld world(6.0, 4.0);
  // A place next to the lane, 0.6 m wide and 0.8 m deep, between two cars.
  world.fill({1.4, 0.6, 2.4, 1.3});
  world.fill({3.0, 0.6, 4.0, 1.3});
  world.fill({1.4, 0.4, 4.0, 0.5});
  world.inflate(0.15, 0.5, 5.0);
  // Past the place, then backwards around a quarter of a circle of 0.7 m into it.
  Path path;
  for (int i = 0; i <= 25; ++i) path.push_back({1.0 + 0.096 * i, 1.9, 0.0});
  constexpr double kRadius = 0.7;
  for (int i = 1; i <= 20; ++i) {
    const double turn = 0.5 * kPi * i / 20.0;
    path.push_back({3.4 - kRadius * std::sin(turn), 1.9 - kRadius * (1.0 - std::cos(turn)), turn});
  }
  for (int i = 1; i <= 5; ++i) path.push_back({2.7, 1.2 - 0.08 * i, 0.5 * kPi});
  const Scene scene{"parking", world, path.front(), path.back()};
  const Drive result = drive(*make_teb(setup), setup, scene, 60.0, path);
  EXPECT_FALSE(result.has_contact);
  EXPECT_TRUE(result.is_reached) << result.last_reason << " at " << result.track.back().x << " "
                                 << result.track.back().y << " " << result.track.back().yaw;
  EXPECT_LE(result.heading_error_rad, setup.tolerance.yaw_goal_tolerance);
}

// What drives at a pillar in the middle of its path.
struct TwoSides {
  ControlSetup setup = jackal();
  GridWorld world{8.0, 6.0};
  Path path;

  TwoSides() {
    world.fill({3.3, 2.6, 4.1, 3.4});
    world.inflate(0.165, 0.6, 5.0);
    for (int i = 0; i <= 60; ++i) path.push_back({1.0 + 0.1 * i, 3.0, 0.0});
  }
};

TEST(TebDrives, BeforeTwoEqualPathsNoiseDoesNotMakeItChangeSides) {
  TwoSides scene;
  const CostGrid grid = scene.world.grid();
  const FootprintChecker body(scene.setup.footprint);
  const TebModel model(TebParams{}, scene.setup);
  TebPlanner planner(model, UnknownCells::kFree);
  const RandomStream random(4, "pose noise");
  int changes = 0;
  double side = 0.0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const RobotState state{
        {1.0 + 0.01 * random.normal(i, 0), 3.0 + 0.01 * random.normal(i, 1), 0.0}, {}, 0.05 * i};
    PathTracker tracker(2.0);
    const LocalPath local = tracker.update(scene.path, state.pose, 0.05, 5.0);
    const TwistWindow window = reachable_window(scene.setup.limits, state.twist, 0.05);
    const Situation situation{state, local, scene.path.back(), grid, {}, body, window};
    const TebBand* const band = planner.plan(situation, grid);
    ASSERT_NE(band, nullptr) << i;
    double highest = 0.0;
    for (const TebNode& node : *band) {
      if (std::fabs(node.pose.y - 3.0) > std::fabs(highest)) highest = node.pose.y - 3.0;
    }
    if (side * highest < 0.0) ++changes;
    side = highest;
  }
  EXPECT_GE(planner.bands(), 2U);
  EXPECT_LE(changes, 1);
}

TEST(TebDrives, AnObstacleOnThePathIsPassed) {
  const TwoSides scene;
  const Scene there{"pillar", scene.world, scene.path.front(), scene.path.back()};
  const Drive result = drive(*make_teb(scene.setup), scene.setup, there, 30.0, scene.path);
  EXPECT_FALSE(result.has_contact);
  EXPECT_TRUE(result.is_reached) << result.last_reason;
}

TEST(TebParams, TheFileOfTheDocumentationLoadsAndBadValuesAreNamed) {
  EXPECT_NO_THROW(make_teb(jackal(), R"({
      odom_topic: odom, map_frame: /odom, teb_autosize: true, dt_ref: 0.3, dt_hysteresis: 0.1,
      global_plan_overwrite_orientation: true, max_global_plan_lookahead_dist: 3.0,
      feasibility_check_no_poses: 5, max_vel_x: 0.4, max_vel_x_backwards: 0.2, max_vel_y: 0.0,
      max_vel_theta: 0.3, acc_lim_x: 0.5, acc_lim_theta: 0.5, min_turning_radius: 0.0,
      footprint_model: {type: polygon, vertices: [[0.25, -0.05], [0.18, -0.05], [0.18, -0.18]]},
      min_obstacle_dist: 0.25, include_costmap_obstacles: true,
      costmap_obstacles_behind_robot_dist: 1.0, obstacle_poses_affected: 30,
      no_inner_iterations: 5, no_outer_iterations: 4, penalty_epsilon: 0.1, weight_max_vel_x: 2,
      weight_kinematics_nh: 1000, weight_obstacle: 50, enable_homotopy_class_planning: true,
      max_number_classes: 4, selection_cost_hysteresis: 1.0, roadmap_graph_no_samples: 15})"));
  const auto message = [](const char* params) -> std::string {
    try {
      make_teb(jackal(), params);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("{dt_ref: 0}").find("dt_ref"), std::string::npos);
  EXPECT_NE(message("{max_number_classes: 0}").find("max_number_classes"), std::string::npos);
}

}  // namespace
}  // namespace trident::nav::testing
