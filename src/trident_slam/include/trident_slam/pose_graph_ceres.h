// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

/// Ceres' choices under the names and with the defaults of slam_toolbox' ceres_* parameters.
struct CeresOptions {
  std::string linear_solver = "SPARSE_NORMAL_CHOLESKY";  ///< or SPARSE_SCHUR, ITERATIVE_SCHUR, CGNR
  std::string preconditioner = "SCHUR_JACOBI";  ///< or JACOBI, IDENTITY; of the iterative solvers
  std::string trust_strategy = "LEVENBERG_MARQUARDT";  ///< or DOGLEG
  std::string dogleg_type = "TRADITIONAL_DOGLEG";      ///< or SUBSPACE_DOGLEG
  /// None, HuberLoss (0.7 standard deviations) or CauchyLoss (0.2): of edges without a kernel.
  std::string loss_function = "None";
  PoseGraphStart start = PoseGraphStart::kGraph;  ///< where Ceres begins
  int max_iterations = 100;                       ///< >= 1
  double relative_tolerance = 1e-6;  ///< least decrease of the cost, as a part of it, > 0

  /// Throws Error naming field, value and what is known.
  void validate() const;
};

/// The same problem solved by Ceres (library trident_slam_ceres), on one thread. Graduated
/// non-convexity is not offered. Group is SE2 or SE3.
template <class Group>
std::unique_ptr<PoseGraphSolver<Group>> make_ceres_solver(const CeresOptions& options);

}  // namespace trident::slam
