// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_base/se2.h"

namespace trident {

/// Lengths of the base and the errors of its encoders.
struct DiffDriveOdometryParams {
  double wheel_separation_m = 0.34;  ///< between the middles of the wheels, > 0
  double wheel_radius_m = 0.075;     ///< > 0
  /// Variance of the travel of one wheel for each metre that it rolls [m^2/m]. 0: no error.
  double travel_variance_m = 0.0;
};

/// Throws Error when separation or radius is not > 0, or the variance is not >= 0.
void validate(const DiffDriveOdometryParams& params);

/// What two wheels, that are `separation_m` apart and roll by `left_m` and `right_m` with a
/// constant ratio, do to the base between them: it goes along an arc.
///
///   turn = (right - left) / separation,  chord = (left + right) / 2 * sin(turn / 2) / (turn / 2)
///
/// and the chord points along the heading in the middle of the arc. This is exact for any turn; the
/// usual sum (Siegwart, Nourbakhsh, Scaramuzza, Introduction to Autonomous Mobile Robots, 2011,
/// eq. 5.7) takes the arc's length for the chord's.
struct WheelArc {
  /// Travels are positive forwards; `separation_m` > 0 is not checked here.
  WheelArc(double left_m, double right_m, double separation_m);

  double turn_rad = 0.0;  ///< positive to the left
  double chord_m = 0.0;   ///< straight from beginning to end, negative backwards

  /// Pose of the base afterwards, when it was T_odom_base before. The angle is kept in (-pi, pi].
  SE2 applied_to(const SE2& T_odom_base) const;
  /// d (x, y, yaw) / d (x, y, yaw before).
  Eigen::Matrix3d jacobian_pose(double yaw_before) const;
  /// d (x, y, yaw) / d (left, right).
  Eigen::Matrix<double, 3, 2> jacobian_travel(double yaw_before) const;

 private:
  double separation_m_;
  double sinc_ = 1.0;               ///< chord per length of the arc
  double sinc_by_half_turn_ = 0.0;  ///< its derivative by half the turn
  double length_m_;
};

/// Pose of a base from the angles of its two wheels, with its covariance. Slip is not seen.
class DiffDriveOdometry {
 public:
  /// Throws Error as validate() does.
  explicit DiffDriveOdometry(const DiffDriveOdometryParams& params);

  /// The wheels have turned by so much since the last call, positive forwards.
  void update(double left_rad, double right_rad);
  /// Pose, covariance and path as constructed: the base is at the origin again.
  void reset();

  const SE2& T_odom_base() const { return T_odom_base_; }  ///< of the middle between the wheels
  /// Of (x, y, yaw) in the frame in which the base started [m^2, m rad, rad^2].
  const Eigen::Matrix3d& covariance() const { return covariance_; }
  /// Path of the middle between the wheels, backwards counted as such [m].
  double distance_m() const { return distance_m_; }
  const DiffDriveOdometryParams& params() const { return params_; }  ///< as constructed

 private:
  DiffDriveOdometryParams params_;
  SE2 T_odom_base_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  double distance_m_ = 0.0;
};

}  // namespace trident
