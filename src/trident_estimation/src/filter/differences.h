// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trident::estimation {

/// Jacobian at zero of a function of `dim` numbers, by central differences.
template <typename Function>
Eigen::MatrixXd central_differences(Eigen::Index dim, const Function& function) {
  constexpr double kStep = 1e-5;
  Eigen::MatrixXd result;
  for (Eigen::Index i = 0; i < dim; ++i) {
    const Eigen::VectorXd d = kStep * Eigen::VectorXd::Unit(dim, i);
    const Eigen::VectorXd column = (function(d) - function(-d)) / (2.0 * kStep);
    if (i == 0) result.resize(column.size(), dim);
    result.col(i) = column;
  }
  return result;
}

}  // namespace trident::estimation
