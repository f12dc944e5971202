// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "calibrated_motion.h"

namespace trident::slam {

/// Names of the parameters, in their order.
constexpr std::array<const char*, kCalibrationParameters> kCalibrationNames = {
    "distance_scale", "turn_scale", "yaw_drift", "laser_x", "laser_y", "laser_yaw"};

struct OdometryCalibrationOptions {
  /// Of the start: scales, [rad/m], [m], [m], [rad].
  std::array<double, kCalibrationParameters> sigma = {0.1, 0.1, 0.03, 0.1, 0.1, 0.1};
  /// How fast each changes by itself, per root metre: tyres, load and floor do, the laser does not.
  std::array<double, kCalibrationParameters> walk = {1e-3, 1e-3, 3e-4, 0.0, 0.0, 0.0};
  double wheel_base = 0.0;  ///< of a differential drive, as its odometry assumes; 0: not known [m]

  /// Increments are put together until they are a motion of this size [m], [rad]; what is below the
  /// smallest says nothing of the parameters that such a motion would show.
  double distance = 0.5;
  double turn = 0.3;
  double smallest_distance = 0.1;
  double smallest_turn = 0.1;

  double distance_noise = 0.02;     ///< of odometry apart from its systematic errors [m/sqrt(m)]
  double yaw_noise = 0.01;          ///< [rad/sqrt(m)]
  double turn_noise = 0.02;         ///< [rad/sqrt(rad)]
  double largest_distance2 = 16.3;  ///< squared Mahalanobis distance of a motion that is believed
};

/// The wheels of a differential drive, as calibrated.
struct DifferentialDrive {
  double left_scale = 1.0;   ///< true by reported distance
  double right_scale = 1.0;  ///< true by reported distance
  double wheel_base = 0.0;   ///< [m]
};

/// Estimates odometry's systematic errors and the laser's place on the base while a robot drives,
/// from the laser's motion by odometry and by scan matching: recursive least squares over the six
/// parameters of CalibratedMotion, with gating (after A. Censi, A. Franchi, L. Marchionni,
/// G. Oriolo, Simultaneous calibration of odometry and sensor parameters for mobile robots, T-RO
/// 2013, for increments of odometry instead of wheels' velocities). What the motions so far do not
/// show stays near its nominal value: driving straight ahead says nothing of turns or of where the
/// laser sits, a circle driven again and again not how far it is to the side.
class OdometryCalibration {
 public:
  explicit OdometryCalibration(const SE2& T_base_laser,
                               const OdometryCalibrationOptions& options = {});

  enum class Outcome { kPending, kUsed, kOutlier };
  /// The motion between two scans by odometry and, of the laser, by scan matching; `covariance` is
  /// of the laser's newest pose by its scan, as a tangent (vx, vy, w) there.
  Outcome add(const SE2& T_before_now, const SE2& T_laser_before_now,
              const Eigen::Matrix3d& covariance);
  /// The next increment does not follow from the last one: something was not measured.
  void interrupt();

  /// The true motion, as far as known, for a motion that odometry reports. It is that of the base
  /// at its nominal pose relative to the laser, so that maps of the nominal and of the calibrated
  /// base are one.
  SE2 calibrated(const SE2& T_before_now) const;

  const CalibrationVector& parameters() const { return parameters_; }
  const CalibrationMatrix& covariance() const { return covariance_; }
  double sigma(CalibrationParameter parameter) const;
  /// Do the motions so far show it, whatever was believed before?
  bool is_observed(CalibrationParameter parameter) const;
  /// Nothing without a wheel base.
  std::optional<DifferentialDrive> drive() const;
  int used() const { return used_; }
  int outliers() const { return outliers_; }

 private:
  Outcome use_window();
  Eigen::Matrix3d noise_of_window(const Eigen::Matrix3d& covariance) const;
  Eigen::Matrix<double, 3, kCalibrationParameters> shown_by_window() const;
  void let_walk();

  /// Increments since the last motion that was used.
  struct Window {
    explicit Window(const CalibratedMotion& motion) : motion(motion) {}
    CalibratedMotion motion;
    SE2 T_laser_first_now;
    double meters = 0.0;
    double radians = 0.0;
    Eigen::Matrix3d first_covariance = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d last_covariance = Eigen::Matrix3d::Zero();
    bool is_empty = true;
  };
  void start_window();

  OdometryCalibrationOptions options_;
  SE2 T_base_laser_nominal_;
  CalibrationVector parameters_;
  CalibrationMatrix covariance_;
  CalibrationMatrix information_;  ///< of the motions alone
  Window window_;
  int used_ = 0;
  int outliers_ = 0;
};

}  // namespace trident::slam
