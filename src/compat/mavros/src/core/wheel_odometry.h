// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/extras_params.h"
#include "trident_base/se2.h"
#include "trident_base/sim_time.h"

namespace trident::mavros {

/// What the wheels say of the vehicle.
struct WheelMotion {
  SE2 T_odom_base;                                            ///< of the vehicle's origin
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< of x [m], y [m], yaw [rad]
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();  ///< forward, left [m/s], yaw rate [rad/s]
  Eigen::Vector3d twist_variance = Eigen::Vector3d::Zero();  ///< of the same
};

/// Odometry of a vehicle with two parallel wheels that do not slip, about an origin that need not
/// be between them, by WheelArc. One wheel goes straight. No clock.
class WheelOdometry {
 public:
  /// `params` are valid and have wheel0.
  explicit WheelOdometry(const WheelOdometryParams& params);

  /// Turns all that has been driven so far, so that the present heading is `yaw` [rad].
  void set_yaw(double yaw);
  /// Of the wheels' cumulative distances [m], at a time of the vehicle's clock. nullopt: the first
  /// measurement, one of another number of wheels, or the time has not advanced.
  std::optional<WheelMotion> add_distances(const std::vector<double>& distance_m, SimTime time);
  /// The same of their turns per minute, which count as their mean since the one before.
  std::optional<WheelMotion> add_turns(const std::vector<double>& rpm, SimTime time);

 private:
  /// Values of the measurement before and the time since then [s]; `values` take their place.
  struct Step {
    std::vector<double> before;
    double dt_s;
  };
  bool is_first_at(SimTime time) const;
  bool is_usable(const std::vector<double>& values, SimTime time) const;
  std::optional<Step> advance(const std::vector<double>& values, SimTime time);
  WheelMotion drive(double travel0_m, double travel1_m, double dt_s);

  WheelParams wheel0_, wheel1_;
  bool is_single_;
  double wheel_variance_m2_s2_;
  SE2 T_base_axle_;  ///< of the middle between the wheels
  SE2 T_odom_axle_;
  Eigen::Matrix3d axle_covariance_ = Eigen::Matrix3d::Zero();
  std::vector<double> values_;
  std::optional<SimTime> time_;
};

}  // namespace trident::mavros
