// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_slam/match_result.h"

namespace trident::slam {

/// A cost at a pose, with its derivatives by (x [m], y [m], yaw [rad]).
struct PoseCost {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double cost = 0.0;

  PoseCost& operator+=(const PoseCost& other) {
    H += other.H;
    g += other.g;
    cost += other.cost;
    return *this;
  }
};

/// Half the squared Mahalanobis distance to a prior under a Cauchy kernel: wheels slip, so that a
/// prior that errs by more than three standard deviations is doubted.
PoseCost prior_cost(const PosePrior& prior, const SE2& T_ref_base);

struct NewtonOptions {
  int max_iterations = 20;
  double longest_step = 0.2;  ///< [m], of the points, too
  double tolerance = 2e-4;    ///< [m]: a shorter step ends the search
};

struct NewtonResult {
  SE2 T_ref_base;
  PoseCost at_end;
  int iterations = 0;
  bool is_converged = false;
};

/// The step -H^-1 g with a turn counted at `range` [m]. Where H is not convex its eigenvalues are
/// taken by their amounts, so that the step goes downhill; it is cut to `longest` [m].
Eigen::Vector3d newton_step(const PoseCost& at, double range, double longest);

/// The minimum of `cost_at(T) -> PoseCost` about `start`: Newton's method, steps halved until the
/// cost falls.
template <class CostAt>
NewtonResult minimize_pose(const SE2& start, double range, const NewtonOptions& options,
                           const CostAt& cost_at) {
  NewtonResult result;
  result.T_ref_base = start;
  result.at_end = cost_at(start);
  while (result.iterations < options.max_iterations && !result.is_converged) {
    ++result.iterations;
    Eigen::Vector3d step = newton_step(result.at_end, range, options.longest_step);
    const SE2 T = result.T_ref_base;
    bool is_lower = false;
    while (!is_lower && step.head<2>().norm() + std::abs(step.z()) * range >= options.tolerance) {
      const SE2 there =
          SE2::from_xy_yaw(T.p.x() + step.x(), T.p.y() + step.y(), T.angle + step.z());
      const PoseCost cost = cost_at(there);
      is_lower = cost.cost < result.at_end.cost;
      if (is_lower) {
        result.T_ref_base = there;
        result.at_end = cost;
      }
      step *= 0.5;
    }
    result.is_converged = !is_lower;
  }
  return result;
}

}  // namespace trident::slam
