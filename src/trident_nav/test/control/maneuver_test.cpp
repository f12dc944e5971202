// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "control/scene.h"
#include "trident_base/angle.h"
#include "trident_nav/control/path_tracker.h"

namespace trident::nav::testing {
namespace {

/// A move of a car: its length, negative backwards, and the curvature of its path, as its turn rate
/// by its speed [m, 1/m].
struct Move {
  double length_m, curvature;
};

Path moved(const Pose2& start, const std::vector<Move>& moves) {
  Path path{start};
  for (const Move& move : moves) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(move.length_m) / 0.02)));
    const double gear = std::copysign(1.0, move.length_m);
    const Pose2 from = path.back();
    for (int i = 1; i <= steps; ++i) {
      path.push_back(integrate(from, {gear, 0.0, gear * move.curvature},
                               std::fabs(move.length_m) * i / steps));
    }
  }
  return path;
}

double distance_to(const Path& path, const Pose2& pose) {
  double least_m = 1e9;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Pose2 &a = path[i], &b = path[i + 1];
    const double length_m = distance(a.x, a.y, b.x, b.y);
    const double along =
        ((pose.x - a.x) * (b.x - a.x) + (pose.y - a.y) * (b.y - a.y)) / (length_m * length_m);
    const double t = std::clamp(along, 0.0, 1.0);
    least_m =
        std::min(least_m, distance(pose.x, pose.y, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)));
  }
  return least_m;
}

ControlSetup exact_car() {
  ControlSetup setup = car();
  setup.tolerance.xy_goal_tolerance = 0.01;
  setup.tolerance.yaw_goal_tolerance = 0.03;
  return setup;
}

// A slot that the car leaves by six moves of hardly more than centimeters, turning to the left
// whatever the gear.
TEST(Maneuver, ArcsOfCentimetersAreDrivenBetweenParkedCars) {
  const ControlSetup setup = exact_car();
  const double most = 1.0 / (1.04 * setup.limits.min_turning_radius);
  std::vector<Move> moves;
  for (int i = 0; i < 3; ++i) moves.insert(moves.end(), {{0.08, most}, {-0.08, -most}});
  moves.push_back({1.5, most});
  const Pose2 start{3.0, 1.5, 0.0};
  const Path path = moved(start, moves);
  Footprint body = setup.footprint;
  double ahead_m = 0.0, behind_m = 0.0;
  for (const Point2& p : body.points) {
    ahead_m = std::max(ahead_m, p.x);
    behind_m = std::min(behind_m, p.x);
  }
  Scene scene{"slot", GridWorld(8.0, 6.0, 0.01), start, path.back()};
  scene.world.fill({2.0, 1.2, 3.0 + behind_m - 0.08, 1.5});
  scene.world.fill({3.0 + ahead_m + 0.18, 1.2, 5.5, 1.5});
  const auto controller = make_controller("mppi", setup);
  const Drive result = drive(*controller, setup, scene, 60.0, path);
  EXPECT_TRUE(result.is_reached) << result.last_reason;
  EXPECT_FALSE(result.has_contact);
  EXPECT_EQ(result.failures, 0) << result.last_reason;
  int changes = 0;
  double gear = 1.0, off_m = 0.0, last_off_m = 0.0;
  for (std::size_t i = 0; i < result.commands.size(); ++i) {
    double& worst_m = changes < 6 ? off_m : last_off_m;
    worst_m = std::max(worst_m, distance_to(path, result.track[i]));
    if (result.commands[i].vx * gear >= 0.0) continue;
    gear = -gear;
    ++changes;
  }
  EXPECT_EQ(changes, 6);
  EXPECT_LT(off_m, 0.005);
  // At nearly the least radius there is little to steer away what the heading lacks after it.
  EXPECT_LT(last_off_m, 0.03);
}

TEST(Maneuver, DeviationsAreSteeredAwayInBothGears) {
  const ControlSetup setup = exact_car();
  const Path path = moved({3.0, 3.0, 0.5}, {{0.5, 0.0}, {-1.2, 0.0}, {0.6, 0.0}});
  Scene scene{"open", GridWorld(8.0, 6.0), path.front(), path.back()};
  scene.start.y += 0.04;
  scene.start.yaw -= 0.1;
  const auto controller = make_controller("mppi", setup);
  const Drive result = drive(*controller, setup, scene, 60.0, path);
  EXPECT_TRUE(result.is_reached) << result.last_reason;
  EXPECT_LT(distance_to(path, result.track.back()), 0.005);
  EXPECT_LT(result.heading_error_rad, 0.02);
}

TEST(Maneuver, AParameterLeavesThemToTheOptimizer) {
  const ControlSetup setup = exact_car();
  const Path path = moved({3.0, 3.0, 0.5}, {{0.5, 0.0}, {-0.8, 0.0}});
  const Scene scene{"open", GridWorld(8.0, 6.0), path.front(), path.back()};
  const auto commands = [&](const char* params) {
    const auto controller = make_controller("mppi", setup, parse_yaml(params, "t"), "t");
    return drive(*controller, setup, scene, 2.0, path).commands;
  };
  const auto exact = commands("{}"), sampled = commands("{follow_maneuvers: false}");
  ASSERT_FALSE(exact.empty());
  EXPECT_FALSE(std::equal(exact.begin(), exact.end(), sampled.begin(), sampled.end(),
                          [](const Twist2& a, const Twist2& b) { return are_equal(a, b); }));
  // Straight ahead there is nothing to steer.
  for (const Twist2& twist : exact) EXPECT_NEAR(twist.wz, 0.0, 1e-6);
}

TEST(PathTracker, PartsOfCentimetersComeOneAfterTheOther) {
  const Path path = moved({0.0, 0.0, 0.001}, {{0.04, 0.0}, {-0.04, 0.0}, {0.04, 0.0}});
  PathTracker tracker(1.0);
  const auto part = [&](double x) {
    const LocalPath local = tracker.update(path, {x, 0.0, 0.001}, 0.01, 1.0);
    return std::pair{local.is_reverse, local.length_m()};
  };
  EXPECT_FALSE(part(0.0).first);
  EXPECT_NEAR(part(0.02).second, 0.02, 1e-6);
  EXPECT_FALSE(part(0.025).first);
  EXPECT_FALSE(part(0.033).first);
  EXPECT_TRUE(part(0.0335).first);  // it has stopped within a quarter of the part
  EXPECT_NEAR(part(0.02).second, 0.02, 1e-6);
  EXPECT_FALSE(part(0.004).first);
  EXPECT_NEAR(part(0.04).second, 0.0, 1e-6);
}

}  // namespace
}  // namespace trident::nav::testing
