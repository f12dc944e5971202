// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

namespace trident::estimation {

/// Why a matrix is no covariance of `size` numbers, in words; empty: it is one. It has to be
/// finite, symmetric to 1e-9 of its largest entry, and positive definite.
std::string covariance_problem(const Eigen::MatrixXd& matrix, Eigen::Index size);

/// The nearest symmetric matrix, and where rounding has left that without a Cholesky factor, with
/// eigenvalues of at least 1e-15 of the largest. Of finite matrices.
Eigen::MatrixXd positive_definite(const Eigen::MatrixXd& matrix);

}  // namespace trident::estimation
