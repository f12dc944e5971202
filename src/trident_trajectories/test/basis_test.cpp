// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "program.h"
#include "team_problems.h"

namespace trident::trajectories {
namespace {

TEST(SplineBasis, WeightsSumToOneAndTheirDerivativesToZero) {
  const SplineBasis basis(5);
  for (int segment = 0; segment < basis.segments(); ++segment) {
    const double s = (segment + 0.3) / basis.segments();
    EXPECT_NEAR(basis.weights_at(0, segment, s).sum(), 1.0, 1e-12);
    for (int derivative = 1; derivative <= kDegree; ++derivative)
      EXPECT_NEAR(basis.weights_at(derivative, segment, s).sum(), 0.0, 1e-6);
  }
}

TEST(SplineBasis, IsSmoothToTheFourthDerivativeBetweenSegments) {
  const SplineBasis basis(5);
  for (int derivative = 0; derivative < kDegree; ++derivative) {
    const auto left = basis.weights_at(derivative, 1, 0.4);
    const auto right = basis.weights_at(derivative, 2, 0.4);
    const double scale = std::max(1.0, left.cwiseAbs().maxCoeff());
    EXPECT_NEAR(left[0] / scale, 0.0, 1e-9);
    for (int i = 0; i + 1 < kOrder; ++i) EXPECT_NEAR(left[i + 1] / scale, right[i] / scale, 1e-9);
  }
}

TEST(SplineBasis, UndisturbedPathIsTheQuinticOfLeastJerk) {
  Problem problem = antipodal_swap(1);
  Program program(problem, std::make_shared<SplineBasis>(7));
  const std::vector<double> x(program.decision().variables(), 0.0);
  const Trajectory path = program.trajectories(x.data()).front();
  EXPECT_NEAR(squared_jerk(path), 720.0 * 16.0 * 16.0 / std::pow(6.0, 5), 1e-6);
  for (const double u : {0.1, 0.5, 0.77}) {
    const double part = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
    EXPECT_NEAR(path.at(6.0 * u).p.x(), 8.0 - 16.0 * part, 1e-9);
  }
}

TEST(Trajectory, KeepsTheEndsOfItsProblem) {
  const Problem problem = everything();
  Program program(problem, std::make_shared<SplineBasis>(7));
  const std::vector<double> x(program.decision().variables(), 0.05);
  const std::vector<Trajectory> paths = program.trajectories(x.data());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const MotionState begin = paths[i].at(0.0);
    EXPECT_TRUE(begin.p.isApprox(problem.robots[i].start.p, 1e-9));
    EXPECT_NEAR((begin.v - problem.robots[i].start.v).norm(), 0.0, 1e-9);
    EXPECT_NEAR((begin.a - problem.robots[i].start.a).norm(), 0.0, 1e-8);
  }
  const MotionState deck = problem.robots[3].goal.deck->at(paths[3].duration());
  const MotionState end = paths[3].at(paths[3].duration());
  EXPECT_NEAR((end.p - deck.p - Eigen::Vector3d(0.0, 0.0, 0.8)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((end.v - deck.v).norm(), 0.0, 1e-9);
}

TEST(GridDistanceMap, EqualsTheMapItWasSampledFromAtItsNodes) {
  const RoundObstacles round({{{1.0, 2.0, 0.0}, 0.7, true}});
  GridDistanceMap::Grid grid;
  grid.origin = {-2.0, -2.0, 0.0};
  grid.nodes = {20, 20, 1};
  const GridDistanceMap sampled = GridDistanceMap::sampled(grid, round);
  Eigen::Vector3d slope, true_slope;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0.5, 1.0, 3.0), Eigen::Vector3d(3.0, -1.5, 0.0)}) {
    EXPECT_NEAR(sampled.distance(p, slope), round.distance(p, true_slope), 1e-12);
    EXPECT_NEAR(slope.z(), 0.0, 0.0);
  }
}

}  // namespace
}  // namespace trident::trajectories
