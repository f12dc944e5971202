// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ekf_slam/landmark_models.h"

#include <gtest/gtest.h>

#include "trident_base/random_stream.h"

namespace trident::slam {
namespace {

constexpr double kStep = 1e-6;

/// Central differences of f at x.
template <int Rows, int Columns, class Function>
Eigen::Matrix<double, Rows, Columns> numeric(const Function& f,
                                             const Eigen::Matrix<double, Columns, 1>& x) {
  Eigen::Matrix<double, Rows, Columns> J;
  for (int i = 0; i < Columns; ++i) {
    Eigen::Matrix<double, Columns, 1> d = Eigen::Matrix<double, Columns, 1>::Zero();
    d[i] = kStep;
    J.col(i) = (f(x + d) - f(x - d)) / (2.0 * kStep);
  }
  return J;
}

class Jacobians : public testing::TestWithParam<int> {
 protected:
  template <int N>
  Eigen::Matrix<double, N, 1> random(std::uint32_t channel, double scale) const {
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i) {
      v[i] = scale * (2.0 * stream_.uniform(static_cast<std::uint64_t>(i), channel) - 1.0);
    }
    return v;
  }
  RandomStream stream_{static_cast<std::uint64_t>(GetParam()), "landmark_models"};
};

TEST_P(Jacobians, OfMotion) {
  const RobotState state = random<5>(0, 1.5);
  const Eigen::Vector3d u = random<3>(1, 0.5);
  const SE2 T = SE2::from_xy_yaw(u[0], u[1], u[2]);
  const auto after = [&](const RobotState& x) { return move(x, T).after; };
  const auto expected = numeric<5, 5>(after, state);
  EXPECT_LT((move(state, T).F - expected).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_P(Jacobians, OfSight) {
  const Eigen::Matrix<double, 5, 1> x = random<5>(2, 3.0);
  const auto seen = [](const Eigen::Matrix<double, 5, 1>& v) -> Eigen::Vector2d {
    return see(v.head<3>(), v.tail<2>()).p_base;
  };
  EXPECT_LT((see(x.head<3>(), x.tail<2>()).H - numeric<2, 5>(seen, x)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_P(Jacobians, OfPlace) {
  const Eigen::Vector3d pose = random<3>(3, 3.0);
  const Eigen::Vector2d z = random<2>(4, 10.0);
  const PlacedLandmark placed = place(pose, z);
  const auto by_pose = [&](const Eigen::Vector3d& x) { return place(x, z).landmark_map; };
  const auto by_seen = [&](const Eigen::Vector2d& x) { return place(pose, x).landmark_map; };
  EXPECT_LT((placed.G_pose - numeric<2, 3>(by_pose, pose)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((placed.G_seen - numeric<2, 2>(by_seen, z)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((see(pose, placed.landmark_map).p_base - z).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Random, Jacobians, testing::Range(0, 20));

}  // namespace
}  // namespace trident::slam
