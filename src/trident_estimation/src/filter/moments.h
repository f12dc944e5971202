// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_estimation/filter/filter.h"

namespace trident::estimation {

/// State and covariance.
struct Belief {
  Eigen::VectorXd state;
  Eigen::MatrixXd covariance;  ///< of the model's degrees of freedom
};

/// What a filter expects to be measured.
struct Expectation {
  Eigen::VectorXd innovation;  ///< what was measured less what is expected
  Eigen::MatrixXd S;           ///< covariance of the innovation
  Eigen::MatrixXd H;           ///< how the expectation follows the state, rows of z x dim()
  /// S less H P H': R, and for sigma points what no straight line explains.
  Eigen::MatrixXd unexplained;
};

/// The belief `dt` [s] later by the model's Jacobian.
Belief predict_extended(const Model& model, const Belief& belief, const Eigen::VectorXd& u,
                        double dt);
/// The belief `dt` [s] later by sigma points.
Belief predict_unscented(const Model& model, const Belief& belief, const SigmaPoints& points,
                         const Eigen::VectorXd& u, double dt);
/// What is expected by the measurement's Jacobian.
Expectation expect_extended(const Model& model, const Belief& belief,
                            const Measurement& measurement);
/// What is expected by sigma points.
Expectation expect_unscented(const Model& model, const Belief& belief, const SigmaPoints& points,
                             const Measurement& measurement);

}  // namespace trident::estimation
