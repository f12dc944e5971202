// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

namespace trident::estimation {

/// How a belief about some degrees of freedom is corrected.
struct Correction {
  Eigen::VectorXd moved;       ///< by how much
  Eigen::MatrixXd covariance;  ///< afterwards
};

/// The covariance intersection of a belief and a measurement of it, whatever their errors have to
/// do with one another: P'^-1 = w P^-1 + (1 - w) H' R^-1 H, of all weights w in [0, 1] with the one
/// whose P' has the least determinant (Julier and Uhlmann, "A non-divergent estimation algorithm in
/// the presence of unknown correlations", ACC 1997). Nothing where that is the belief itself.
std::optional<Correction> intersect(const Eigen::MatrixXd& P, const Eigen::MatrixXd& H,
                                    const Eigen::MatrixXd& R, const Eigen::VectorXd& innovation);

}  // namespace trident::estimation
