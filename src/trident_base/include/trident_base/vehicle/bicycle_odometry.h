// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_base/se2.h"

namespace trident {

/// A car whose front wheels turn about one point on the line of the rear axle (Ackermann's
/// steering; Rajamani, Vehicle Dynamics and Control, 2012, section 2.2). `steering` is that of the
/// bicycle of the same wheelbase: tan(steering) = wheelbase / radius of the middle of the rear
/// axle, positive to the left.
struct AckermannGeometry {
  double wheelbase_m = 1.0;                        ///< between the axles, > 0
  double front_track_m = 0.5, rear_track_m = 0.5;  ///< between the wheels of an axle, > 0

  /// Angles of the left and the right front wheel.
  Eigen::Vector2d wheel_angles(double steering_rad) const;
  /// The inverse of `wheel_angles`: the mean of tan(steering) over both wheels.
  double steering_of(double left_rad, double right_rad) const;
  /// The steering at which the inner wheel stands at an angle.
  double steering_of_inner(double inner_rad) const;
  /// Speeds of the left and the right rear wheel, when the middle of their axle moves at `speed`.
  Eigen::Vector2d rear_speeds(double speed, double steering_rad) const;
};
/// Throws Error when a length is not > 0.
void validate(const AckermannGeometry& geometry);

/// Lengths of the car and the errors of its encoders.
struct BicycleOdometryParams {
  double wheelbase_m = 1.0;     ///< between the axles, > 0
  double wheel_radius_m = 0.1;  ///< of the rear wheels, > 0
  /// Variance of the travel for each metre that is travelled [m^2/m]. 0: no error.
  double travel_variance_m = 0.0;
  /// Variance of the heading for each metre that is travelled [rad^2/m]. 0: no error.
  double turn_variance_rad2_m = 0.0;
};
/// Throws Error when wheelbase or radius is not > 0, or a variance is not >= 0.
void validate(const BicycleOdometryParams& params);

/// Pose of the middle of a rear axle from the turning of its wheels and the steering, along exact
/// arcs, with its covariance. Slip is not seen.
class BicycleOdometry {
 public:
  /// Throws Error as validate() does.
  explicit BicycleOdometry(const BicycleOdometryParams& params);

  /// The rear wheels have turned by so much (their mean, positive forwards) since the last call, at
  /// this steering.
  void update(double rear_rad, double steering_rad);
  /// Pose and covariance as constructed: the axle is at the origin again.
  void reset();

  const SE2& T_odom_axle() const { return T_odom_axle_; }  ///< of the middle of the rear axle
  /// Of (x, y, yaw) in the frame in which the axle started [m^2, m rad, rad^2].
  const Eigen::Matrix3d& covariance() const { return covariance_; }
  const BicycleOdometryParams& params() const { return params_; }  ///< as constructed

 private:
  BicycleOdometryParams params_;
  SE2 T_odom_axle_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace trident
