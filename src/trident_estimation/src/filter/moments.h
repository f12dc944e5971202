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

/// What a filter expects to be measured; the measurement's own noise is not in it.
struct Expectation {
  Eigen::VectorXd innovation;  ///< what was measured less what is expected
  Eigen::MatrixXd S;           ///< covariance of what is expected
  /// How the expectation follows the degrees of freedom it depends on: rows of z.
  Eigen::MatrixXd H;
  /// What of S no straight line explains; zero by Jacobians.
  Eigen::MatrixXd unexplained;
};

/// Columns of a covariance for the degrees of freedom that a measurement depends on.
Eigen::MatrixXd columns_of(const Eigen::MatrixXd& covariance, const Measurement& measurement);
/// Rows of such columns.
Eigen::MatrixXd rows_of(const Eigen::MatrixXd& columns, const Measurement& measurement);

/// The belief `dt` [s] later by the model's Jacobian.
Belief predict_extended(const Model& model, const Belief& belief, const Eigen::VectorXd& u,
                        double dt);
/// The belief `dt` [s] later by sigma points.
Belief predict_unscented(const Model& model, const Belief& belief, const SigmaPoints& points,
                         const Eigen::VectorXd& u, double dt);
/// What is expected by the measurement's Jacobian. `columns`: see columns_of().
Expectation expect_extended(const Model& model, const Belief& belief,
                            const Eigen::MatrixXd& columns, const Measurement& measurement);
/// What is expected by sigma points. `columns`: see columns_of().
Expectation expect_unscented(const Model& model, const Belief& belief,
                             const Eigen::MatrixXd& columns, const SigmaPoints& points,
                             const Measurement& measurement);

}  // namespace trident::estimation
