// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "trident_control/vessel_control_params.h"

namespace trident::control {

/// Integral line-of-sight guidance along straight legs (Borhaug, Pavlov and Pettersen 2008): from
/// the distance e to the left of a leg in direction gamma, with the lookahead D,
///   chi_d = gamma - atan((e + c + sigma s) / D),  ds/dt = D e / (D^2 + (e + c + sigma s)^2),
/// where c is as far as the drift that is known already would set a vessel aside. The integral
/// cancels what else is steady across the leg, and hardly grows far from it. What legs have shown
/// of that, each the part across it, is kept as a vector, from which the next leg begins.
class LineOfSight {
 public:
  /// Has no path before start().
  explicit LineOfSight(const GuidanceParams& params) : params_(params) {}

  /// Follows the waypoints [m] from where the vessel is now; one in whose circle it is already
  /// begins the path. There is at least one.
  void start(const std::vector<Eigen::Vector2d>& waypoints, const Eigen::Vector2d& p_world);
  /// The course to steer through the water [rad] while that carries the vessel along by
  /// `drift_world` and it makes `speed` through it [m/s].
  double update(const Eigen::Vector2d& p_world, const Eigen::Vector2d& drift_world, double speed,
                double dt_s);

  /// Whether the last waypoint's circle was reached; true before start(), too.
  bool is_finished() const { return leg_ + 1 >= points_.size(); }
  /// Distance to the left of the present leg [m].
  double cross_track_m() const { return cross_track_m_; }
  /// Of the last waypoint; start() came before.
  const Eigen::Vector2d& goal() const { return points_.back(); }
  /// The leg's direction [rad].
  double direction() const { return direction_; }
  std::size_t leg() const { return leg_; }  ///< index of the waypoint that it begins at

 private:
  void enter(std::size_t leg);
  void advance(const Eigen::Vector2d& p_world);
  Eigen::Vector2d left() const { return {-std::sin(direction_), std::cos(direction_)}; }

  GuidanceParams params_;
  std::vector<Eigen::Vector2d> points_;
  std::size_t leg_ = 0;  // from points_[leg_] to points_[leg_ + 1]
  double direction_ = 0.0, integral_m_ = 0.0, cross_track_m_ = 0.0;
  Eigen::Vector2d steady_m_ = Eigen::Vector2d::Zero();  // of the integral, world
};

}  // namespace trident::control
