// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Analytic derivatives of what the matchers minimise against central differences. The occupancy
// grid's are checked in map_match_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "matchers/line_match.h"
#include "matchers/ndt_match.h"
#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::slam {
namespace {

SE2 moved(const SE2& T, int axis, double by) {
  Eigen::Vector3d d = Eigen::Vector3d::Zero();
  d[axis] = by;
  return SE2::from_xy_yaw(T.p.x() + d.x(), T.p.y() + d.y(), T.angle + d.z());
}

Eigen::Vector3d numeric_gradient(const SE2& T, double h,
                                 const std::function<double(const SE2&)>& cost) {
  Eigen::Vector3d g;
  for (int axis = 0; axis < 3; ++axis) {
    g[axis] = (cost(moved(T, axis, h)) - cost(moved(T, axis, -h))) / (2.0 * h);
  }
  return g;
}

Eigen::Matrix3d numeric_jacobian(const SE2& T, double h,
                                 const std::function<Eigen::Vector3d(const SE2&)>& gradient) {
  Eigen::Matrix3d H;
  for (int axis = 0; axis < 3; ++axis) {
    H.col(axis) = (gradient(moved(T, axis, h)) - gradient(moved(T, axis, -h))) / (2.0 * h);
  }
  return H;
}

/// Points far enough apart that each keeps its own surfel: on walls, and in the open.
PointScan sparse_scan() {
  PointScan scan;
  for (int i = 0; i < 8; ++i) {
    const auto s = static_cast<float>(i);
    scan.points.push_back({{0.75F * s - 2.02F, 2.03F}, {0.0F, -1.0F}});
    scan.points.push_back({{3.53F, 0.65F * s - 2.51F}, {-0.8F, 0.6F}});
    scan.points.push_back({{-2.47F + 0.1F * s, -0.8F * s}, {0.0F, 0.0F}});
  }
  return scan;
}

class LineMatchDerivatives : public testing::Test {
 protected:
  LineMatchDerivatives() { reference_.insert(SE2::identity(), scan_); }
  NormalEquations at(const SE2& T) const { return line_match_sums(reference_, scan_, T, options_); }

  SurfelMap reference_;
  PointScan scan_ = sparse_scan();
  LineMatchOptions options_;
};

TEST_F(LineMatchDerivatives, TheGradientIsThatOfTheCost) {
  // Of the cost, by (sigma / kernel)^2: see NormalEquations.
  const double scale = std::pow(options_.sigma / options_.kernel, 2);
  for (const auto& [x, y, yaw] : {std::array{0.02, -0.03, 0.01}, std::array{-0.05, 0.01, -0.008},
                                  std::array{0.0, 0.06, 0.004}}) {
    const SE2 T = SE2::from_xy_yaw(x, y, yaw);
    ASSERT_GT(at(T).inliers, 20U);
    const Eigen::Vector3d numeric =
        numeric_gradient(T, 1e-3, [&](const SE2& there) { return at(there).cost; });
    EXPECT_LT((scale * at(T).g - numeric).norm(), 2e-3 * numeric.norm())
        << scale * at(T).g.transpose() << " numeric " << numeric.transpose();
  }
}

TEST_F(LineMatchDerivatives, WhereNothingIsOffTheHessianIsThatOfTheCost) {
  const Eigen::Matrix3d numeric = numeric_jacobian(
      SE2::identity(), 4e-4, [&](const SE2& there) -> Eigen::Vector3d { return at(there).g; });
  EXPECT_LT((at(SE2::identity()).H - numeric).norm(), 2e-3 * numeric.norm());
}

TEST_F(LineMatchDerivatives, APointOffItsLineGivesNoInformationAlongIt) {
  PointScan wall;
  for (int i = 0; i < 9; ++i) {
    wall.points.push_back({{static_cast<float>(i) - 4.0F, 1.05F}, {0.0F, -1.0F}});
  }
  SurfelMap reference;
  reference.insert(SE2::identity(), wall);
  const NormalEquations sums =
      line_match_sums(reference, wall, SE2::from_xy_yaw(0.02, 0.03, 0.0), options_);
  EXPECT_EQ(sums.H(0, 0), 0.0);
  EXPECT_EQ(sums.g[0], 0.0);
  EXPECT_GT(sums.g[1], 0.0);
  EXPECT_TRUE(degeneracy_of(sums.H, 2.5).is_degenerate());
  EXPECT_NEAR(std::abs(degeneracy_of(sums.H, 2.5).weakest.x()), 1.0, 1e-9);
}

/// Two walls and a corner of them with noise, so that distributions are of every shape.
PointScan noisy_corner() {
  const RandomStream random(5, "corner");
  PointScan scan;
  for (std::uint64_t i = 0; i < 150; ++i) {
    const double s = 0.03 * static_cast<double>(i);
    scan.points.push_back({Eigen::Vector2d(s, 1.5 + 0.03 * random.normal(i, 0)).cast<float>(), {}});
    scan.points.push_back(
        {Eigen::Vector2d(-1.2 + 0.03 * random.normal(i, 1), 1.5 - 0.7 * s).cast<float>(), {}});
  }
  return scan;
}

class NdtDerivatives : public testing::Test {
 protected:
  NdtDerivatives() {
    const PointScan corner = noisy_corner();
    map_.insert(SE2::identity(), corner);
    // Without the points that a difference would carry into another cell.
    for (const SurfacePoint& point : corner.points) {
      if (is_inside(at_.p + at_.rotation() * point.p.cast<double>())) scan_.points.push_back(point);
    }
  }
  bool is_inside(const Eigen::Vector2d& p) const {
    for (const double v : {p.x(), p.y()}) {
      const double part = std::abs(std::remainder(v, 0.5 * map_.cell()));
      if (part < 0.01) return false;
    }
    return true;
  }

  NdtMap map_{0.5, 0.05};
  PointScan scan_;
  SE2 at_ = SE2::from_xy_yaw(0.04, -0.06, 0.03);
};

TEST_F(NdtDerivatives, TheGradientIsThatOfTheCost) {
  ASSERT_GT(scan_.points.size(), 200U);
  const Eigen::Vector3d numeric =
      numeric_gradient(at_, 1e-5, [&](const SE2& T) { return ndt_cost(map_, scan_, T).cost; });
  EXPECT_LT((ndt_cost(map_, scan_, at_).g - numeric).norm(), 1e-5 * numeric.norm());
}

TEST_F(NdtDerivatives, TheHessianIsThatOfTheGradient) {
  const Eigen::Matrix3d numeric = numeric_jacobian(
      at_, 1e-5, [&](const SE2& T) -> Eigen::Vector3d { return ndt_cost(map_, scan_, T).g; });
  EXPECT_LT((ndt_cost(map_, scan_, at_).H - numeric).norm(), 1e-5 * numeric.norm());
}

TEST(NdtMap, ACellIsTheMeanAndTheCovarianceOfItsPoints) {
  PointScan scan;
  for (const auto& [x, y] : {std::pair{0.1F, 0.1F}, {0.3F, 0.1F}, {0.1F, 0.3F}, {0.3F, 0.3F}}) {
    scan.points.push_back({{x, y}, {}});
  }
  NdtMap map(1.0, 0.01);
  map.insert(SE2::identity(), scan);
  const NdtMap::Normal* normal = map.over(0, {0.5, 0.5});
  ASSERT_NE(normal, nullptr);
  EXPECT_NEAR((normal->mean - Eigen::Vector2d(0.2, 0.2)).norm(), 0.0, 1e-7);
  EXPECT_NEAR((normal->information - 100.0 * Eigen::Matrix2d::Identity()).norm(), 0.0, 1e-3);
  EXPECT_EQ(map.over(0, {1.5, 0.5}), nullptr);
  EXPECT_NE(map.over(3, {0.4, -0.4}), nullptr) << "the cell of the grid shifted by half of one";
  map.clear();
  EXPECT_EQ(map.over(0, {0.5, 0.5}), nullptr);
}

TEST(NdtMap, ALineIsNoNarrowerThanItsSigma) {
  PointScan scan;
  for (int i = 0; i < 5; ++i) scan.points.push_back({{0.1F * static_cast<float>(i), 0.25F}, {}});
  NdtMap map(1.0, 0.05);
  map.insert(SE2::identity(), scan);
  EXPECT_NEAR(map.over(0, {0.5, 0.5})->information(1, 1), 400.0, 1e-3);
}

TEST(PoseNewton, ThePriorsGradientIsThatOfItsCost) {
  PosePrior prior;
  prior.T_ref_base = SE2::from_xy_yaw(1.0, 2.0, 3.1);
  prior.information = Eigen::Vector3d(100.0, 400.0, 900.0).asDiagonal();
  prior.information(0, 1) = prior.information(1, 0) = 50.0;
  const SE2 T = SE2::from_xy_yaw(1.1, 1.8, -3.1);  // beyond pi
  const Eigen::Vector3d numeric =
      numeric_gradient(T, 1e-6, [&](const SE2& there) { return prior_cost(prior, there).cost; });
  EXPECT_LT((prior_cost(prior, T).g - numeric).norm(), 1e-6 * numeric.norm());
}

TEST(PoseNewton, FindsTheMinimumOfACostThatIsNotConvexWhereItBegins) {
  const auto cost_at = [](const SE2& T) {
    // 1 - cos along both axes and in yaw: concave beyond a quarter turn.
    PoseCost at;
    const Eigen::Vector3d v(T.p.x() - 0.5, T.p.y() + 0.25, T.angle);
    for (int i = 0; i < 3; ++i) {
      at.cost += 1.0 - std::cos(v[i]);
      at.g[i] = std::sin(v[i]);
      at.H(i, i) = std::cos(v[i]);
    }
    return at;
  };
  NewtonOptions options;
  options.max_iterations = 100;
  const NewtonResult found = minimize_pose(SE2::from_xy_yaw(2.6, -2.4, 1.9), 1.0, options, cost_at);
  EXPECT_TRUE(found.is_converged);
  EXPECT_LT((found.T_ref_base.p - Eigen::Vector2d(0.5, -0.25)).norm(), 1e-3);
  EXPECT_LT(std::abs(found.T_ref_base.angle), 1e-3);
}

}  // namespace
}  // namespace trident::slam
