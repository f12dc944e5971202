// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trident::trajectories {

/// Position, velocity and acceleration in the team's common frame, z up.
struct MotionState {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d a = Eigen::Vector3d::Zero();  ///< [m/s^2]
};

/// Where something that is not planned (a person, a ship, a deck) will be: a cubic Hermite curve
/// through knots, straight on with the first and last velocity outside of them.
class Prediction {
 public:
  /// Where and how fast it is at one instant.
  struct Knot {
    double t = 0.0;                               ///< from the begin of the plan [s]
    Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< [m]
    Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< [m/s]
  };

  /// Throws Error naming the knot: no knot, one that is not finite, or times that do not grow.
  explicit Prediction(std::vector<Knot> knots);

  /// Straight on from `p` with `v`; the same errors.
  static Prediction constant_velocity(const Eigen::Vector3d& p, const Eigen::Vector3d& v);

  /// At time t [s].
  MotionState at(double t) const;

  /// Third derivative of the position at time t [m/s^3].
  Eigen::Vector3d jerk(double t) const;

  /// Instants between which the curve is one polynomial, growing [s].
  const std::vector<double>& times() const { return times_; }

 private:
  std::size_t piece(double t) const;

  std::vector<Knot> knots_;
  std::vector<double> times_;
};

}  // namespace trident::trajectories
