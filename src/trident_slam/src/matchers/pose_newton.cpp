// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "pose_newton.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::slam {

PoseCost prior_cost(const PosePrior& prior, const SE2& T_ref_base) {
  constexpr double kKernel = 9.0;  // squared standard deviations
  const Eigen::Vector3d off(T_ref_base.p.x() - prior.T_ref_base.p.x(),
                            T_ref_base.p.y() - prior.T_ref_base.p.y(),
                            angle_difference(T_ref_base.angle, prior.T_ref_base.angle));
  const Eigen::Vector3d pull = prior.information * off;
  const double distance = off.dot(pull);
  const double trust = 1.0 / (1.0 + distance / kKernel);
  return {trust * prior.information, trust * pull, 0.5 * kKernel * std::log1p(distance / kKernel)};
}

Eigen::Vector3d newton_step(const PoseCost& at, double range, double longest) {
  constexpr double kMinRatio = 1e-6;  // of the largest eigenvalue
  const Eigen::Vector3d scale(1.0, 1.0, 1.0 / std::max(range, 0.1));
  const Eigen::Matrix3d H = scale.asDiagonal() * at.H * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(H);
  Eigen::Vector3d amounts = solver.eigenvalues().cwiseAbs();
  const double largest = amounts.maxCoeff();
  if (!(largest > 0.0)) return Eigen::Vector3d::Zero();
  amounts = amounts.cwiseMax(kMinRatio * largest);
  const Eigen::Matrix3d& V = solver.eigenvectors();
  const Eigen::Vector3d g = V.transpose() * scale.cwiseProduct(at.g);
  Eigen::Vector3d step = -(V * g.cwiseQuotient(amounts));
  const double length = step.norm();
  if (length > longest) step *= longest / length;
  return scale.cwiseProduct(step);
}

}  // namespace trident::slam
