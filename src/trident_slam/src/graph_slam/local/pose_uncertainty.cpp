// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "pose_uncertainty.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace trident::slam {
namespace {

/// What the points say of the directions that they show; of an open one they say nothing.
Eigen::Matrix3d shown_information(const MatchResult& match, double mean_range) {
  const double range = std::max(mean_range, 0.1);
  const Eigen::Vector3d scale(1.0, 1.0, 1.0 / range);  // yaw in meters at the points
  const Eigen::Matrix3d scaled = scale.asDiagonal() * match.information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scaled);
  Eigen::Vector3d values = solver.eigenvalues().cwiseMax(0.0);
  for (int i = 0; i < 3; ++i) {
    if (values(i) < Degeneracy::kDegenerateRatio * values(2)) values(i) = 0.0;
  }
  const Eigen::Matrix3d shown =
      solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
  const Eigen::Vector3d back(1.0, 1.0, range);
  return back.asDiagonal() * shown * back.asDiagonal();
}

}  // namespace

void PoseUncertainty::add(const ScanStep& step, const MatchResult& match, double mean_range) {
  is_open_ = match.degeneracy.is_degenerate();
  // (R, p) of the pose before, up to the step's own size: F moves the error of its yaw along.
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = (match.T_ref_base * step.T_before_now.inverse()).rotation();
  const Eigen::Vector2d moved = R.topLeftCorner<2, 2>() * step.T_before_now.p;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -moved.y();
  F(1, 2) = moved.x();
  const Eigen::Matrix3d expected =
      F * covariance_ * F.transpose() + R * step.covariance * R.transpose();
  covariance_ = (expected.inverse() + shown_information(match, mean_range)).inverse();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

}  // namespace trident::slam
