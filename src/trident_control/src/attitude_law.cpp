// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/attitude_law.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "gain_validation.h"
#include "trident_base/error.h"

namespace trident::control {
namespace {

/// One matrix takes angular acceleration [rad/s^2] and thrust [N] to squared rotor speeds
/// [rad^2/s^2]: the inertia makes moments of accelerations, the inverse allocation shares them out.
AllocationInverse accelerations_to_squared_speeds(const VehicleParams& vehicle) {
  Eigen::Matrix4d to_wrench = Eigen::Matrix4d::Identity();
  to_wrench.topLeftCorner<3, 3>() = vehicle.inertia;
  return allocation_inverse(allocation_matrix(vehicle)) * to_wrench;
}

}  // namespace

void validate_gain(const std::string& name, const Eigen::Vector3d& gain) {
  const char* const axes[] = {"/x", "/y", "/z"};
  for (int i = 0; i < 3; ++i) {
    if (std::isfinite(gain[i]) && gain[i] >= 0.0) continue;
    throw Error("controller parameter '" + name + axes[i] + "' is " + std::to_string(gain[i]) +
                ": it must be a finite number >= 0");
  }
}

void AttitudeGains::validate() const {
  validate_gain("attitude_gain", attitude);
  validate_gain("angular_rate_gain", angular_rate);
}

AttitudeLaw::AttitudeLaw(const VehicleParams& vehicle, const AttitudeGains& gains,
                         const AttitudeQuirks& quirks)
    : to_squared_speeds_(accelerations_to_squared_speeds(vehicle)),
      inertia_(vehicle.inertia),
      inertia_inverse_(vehicle.inertia.inverse()),
      quirks_(quirks) {
  gains.validate();
  if (!quirks.unlimited_rotor_speed &&
      !(std::isfinite(quirks.max_rotor_speed) && quirks.max_rotor_speed > 0.0)) {
    throw Error("controller parameter 'max_rotor_speed' is " +
                std::to_string(quirks.max_rotor_speed) +
                ": it must be a finite number > 0 [rad/s]");
  }
  // Row vector times inverse, as RotorS; it matters only for products of inertia.
  attitude_gain_ = inertia_inverse_.transpose() * gains.attitude;
  angular_rate_gain_ = inertia_inverse_.transpose() * gains.angular_rate;
}

void AttitudeLaw::compute(const Eigen::Matrix3d& R_WB, const Eigen::Vector3d& w_B,
                          const Eigen::Matrix3d& R_WD, double yaw_rate, double thrust,
                          Span<double> rotor_speeds) const {
  // Attitude error, equation 10.
  const Eigen::Matrix3d R_DB = R_WD.transpose() * R_WB;
  // vee(R_DB - R_DB')/2, and R_DB e3 (or R_BD e3) times the yaw rate.
  const Eigen::Vector3d e_R =
      0.5 *
      Eigen::Vector3d(R_DB(2, 1) - R_DB(1, 2), R_DB(0, 2) - R_DB(2, 0), R_DB(1, 0) - R_DB(0, 1));
  const Eigen::Vector3d yaw_axis = quirks_.rotate_yaw_rate_with_RdT_R
                                       ? Eigen::Vector3d(R_DB.col(2))
                                       : Eigen::Vector3d(R_DB.row(2).transpose());
  // Rate error, equation 11, for a wanted rate about the desired body's z axis alone.
  const Eigen::Vector3d e_w = w_B - yaw_axis * yaw_rate;
  allocate(w_B, -e_R.cwiseProduct(attitude_gain_) - e_w.cwiseProduct(angular_rate_gain_), thrust,
           rotor_speeds);
}

void AttitudeLaw::compute_rates(const Eigen::Vector3d& w_B, const Eigen::Vector3d& w_desired,
                                double thrust, Span<double> rotor_speeds) const {
  allocate(w_B, -(w_B - w_desired).cwiseProduct(angular_rate_gain_), thrust, rotor_speeds);
}

/// Rotor speeds of an angular acceleration [rad/s^2] and a thrust [N].
void AttitudeLaw::allocate(const Eigen::Vector3d& w_B, const Eigen::Vector3d& wanted, double thrust,
                           Span<double> rotor_speeds) const {
  Eigen::Vector3d acceleration = wanted;
  // The gyroscopic term of equation 16; RotorS leaves it out.
  if (!quirks_.omit_gyroscopic_term) {
    acceleration += inertia_inverse_ * w_B.cross(inertia_ * w_B);
  }

  const double upper = quirks_.unlimited_rotor_speed ? HUGE_VAL : quirks_.max_rotor_speed;
  for (std::size_t i = 0; i < rotor_speeds.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double squared = to_squared_speeds_(row, 0) * acceleration.x() +
                           to_squared_speeds_(row, 1) * acceleration.y() +
                           to_squared_speeds_(row, 2) * acceleration.z() +
                           to_squared_speeds_(row, 3) * thrust;
    // A rotor cannot reverse its thrust, so that a negative square means that it stands.
    rotor_speeds[i] = std::min(std::sqrt(std::max(squared, 0.0)), upper);
  }
}

}  // namespace trident::control
