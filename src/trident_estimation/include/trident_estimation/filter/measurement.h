// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::estimation {

/// What a sensor says at a moment, and how that follows from the state. Its functions are pure.
struct Measurement {
  SimTime stamp;       ///< of the state that was measured, not of the arrival
  std::string source;  ///< e.g. a topic; orders measurements of one stamp
  Eigen::VectorXd z;   ///< what was measured
  Eigen::MatrixXd R;   ///< its covariance, symmetric and positive definite
  /// What it would be in the state x.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> h;
  /// How h changes with boxplus(x, d), z.size() x the size of `dofs`, or dim() where that is empty.
  /// Empty: central differences.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)> H;
  /// z less z_hat, for angles on the shorter side. Empty: the difference.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& z, const Eigen::VectorXd& z_hat)> residual;
  /// Greatest Mahalanobis distance from what was expected; without it all is used.
  std::optional<double> gate;
  /// Degrees of freedom that h depends on, each once. Empty: all.
  std::vector<Eigen::Index> dofs;
  /// Whether its errors may have to do with those of the belief, nobody knows how much: what a team
  /// mate made of measurements that are in the belief already. Then it is used by covariance
  /// intersection (Julier and Uhlmann 1997): `dofs` get the intersection with the least
  /// determinant, and all else what follows from them.
  bool is_shared = false;
};

/// The Mahalanobis distance that `share` of the measurements of `size` numbers stay within, by
/// chi-squared to about 1 % (Wilson and Hilferty 1931). `share` is above 0 and below 1.
double gate_of(double share, Eigen::Index size);

/// What became of a measurement.
struct Outcome {
  /// Of a measurement.
  enum class Kind {
    kUsed,
    kGated,   ///< farther from the expectation than its gate
    kRefused  ///< not usable: `reason` says why
  };
  Kind kind = Kind::kRefused;
  Eigen::VectorXd innovation;       ///< residual of z and the expectation; empty when refused
  Eigen::MatrixXd S;                ///< covariance of the innovation
  double normalized_squared = 0.0;  ///< innovation' S^-1 innovation, the NIS
  std::string reason;               ///< one line; empty when used
};

}  // namespace trident::estimation
