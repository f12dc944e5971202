// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/environment/current.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "scratch_folder.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

CurrentParams flow(CurrentKind kind, double speed) {
  CurrentParams params;
  params.kind = kind;
  params.speed = speed;
  return params;
}

TEST(Current, UniformFlowsTowardsItsDirection) {
  CurrentParams params = flow(CurrentKind::kUniform, 0.5);
  params.direction = kPi / 2;
  const Current current(params);
  EXPECT_TRUE(is_near(current.velocity({3, 4, -1}, 7.0), Eigen::Vector3d(0, 0.5, 0), 1e-12));
  EXPECT_TRUE(is_near(current.rate({3, 4, -1}, {1, 2, 3}, 7.0), Eigen::Vector3d::Zero(), 1e-12));
}

TEST(Current, ShearGrowsToTheLeftAndIsSeenChangingByWhoCrossesIt) {
  CurrentParams params = flow(CurrentKind::kShear, 0.5);
  params.shear = 0.02;
  const Current current(params);
  EXPECT_TRUE(is_near(current.velocity({9, 10, 0}, 0), Eigen::Vector3d(0.7, 0, 0), 1e-12));
  EXPECT_TRUE(is_near(current.rate({9, 10, 0}, {0, 3, 0}, 0), Eigen::Vector3d(0.06, 0, 0), 1e-9));
}

TEST(Current, VortexTurnsFastestAtItsCoreAndHasNoSources) {
  CurrentParams params = flow(CurrentKind::kVortex, 0.8);
  params.center = {5, -3};
  params.core_radius = 4.0;
  const Current current(params);
  const auto speed = [&](double r) { return current.velocity({5 + r, -3, 0}, 0).y(); };
  EXPECT_NEAR(speed(4.0), 0.8, 1e-9);
  EXPECT_LT(speed(3.9), 0.8);
  EXPECT_LT(speed(4.1), 0.8);
  EXPECT_EQ(current.velocity({5, -3, 0}, 0).norm(), 0.0);
  EXPECT_NEAR(speed(40.0) * 40.0, speed(80.0) * 80.0, 1e-6);  // a free vortex far out
  constexpr double h = 1e-4;
  const double divergence =
      (current.velocity({7 + h, -1, 0}, 0) - current.velocity({7 - h, -1, 0}, 0)).x() +
      (current.velocity({7, -1 + h, 0}, 0) - current.velocity({7, -1 - h, 0}, 0)).y();
  EXPECT_NEAR(divergence / (2 * h), 0.0, 1e-6);
}

TEST(Current, TideSwings) {
  CurrentParams params = flow(CurrentKind::kUniform, 0.5);
  params.tide_amplitude = 2.0;
  params.tide_period = 100.0;
  const Current current(params);
  EXPECT_NEAR(current.velocity({0, 0, 0}, 25.0).x(), 1.5, 1e-12);
  EXPECT_NEAR(current.velocity({0, 0, 0}, 75.0).x(), -0.5, 1e-12);
  EXPECT_NEAR(current.rate({0, 0, 0}, {0, 0, 0}, 0.0).x(), 0.5 * 2.0 * 2 * kPi / 100.0, 1e-5);
}

TEST(Current, ReadsAGrid) {
  const ScratchFolder folder;
  const std::string file = folder.write(
      "flow.txt",
      "min_x: 0 min_y: 0 n_x: 2 n_y: 2 res_x: 10 res_y: 10 vertical_spacing_factors: 0 1\n"
      "bottom_z: -5 -5 -5 -5 top_z: 1 1 1 1\n"
      "u: 0 1 0 1 0 1 0 1 v: 0 0 0 0 0 0 0 0 w: 0 0 0 0 0 0 0 0\n");
  CurrentParams params = flow(CurrentKind::kFile, 0.0);
  params.file = file;
  const Current current(params);
  EXPECT_NEAR(current.velocity({2.5, 5, 0}, 0).x(), 0.25, 1e-12);
  EXPECT_EQ(current.velocity({-50, 5, 0}, 0).norm(), 0.0);

  params.file = "no such file.txt";
  EXPECT_TRUE(contains(error_of([&] { Current{params}; }), "no such file.txt"));
  params.file.clear();
  EXPECT_TRUE(contains(error_of([&] { Current{params}; }), "file = ''"));
}

TEST(Current, IsHandedToAHullInItsOwnAxes) {
  CurrentParams params = flow(CurrentKind::kUniform, 0.5);
  HullWater water;
  water.velocity[2] = 1.0;
  Current(params).add_to(SE3::from_xyz_rpy({1, 2, 3}, 0, 0, kPi / 2), {0, 0, 0}, 0.0, &water);
  EXPECT_NEAR(water.velocity[1], -0.5, 1e-12);
  EXPECT_NEAR(water.velocity[2], 1.0, 1e-12);
}

}  // namespace
}  // namespace trident::sim
