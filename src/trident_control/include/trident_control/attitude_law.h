// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "trident_base/span.h"
#include "trident_control/vehicle_params.h"

namespace trident::control {

/// Where the RotorS controllers depart from the paper. Each default is RotorS' behavior.
struct AttitudeQuirks {
  /// The desired body rate is rotated by Rd' R; the paper says R' Rd.
  bool rotate_yaw_rate_with_RdT_R = true;
  /// The paper's w x J w is left out (RotorS writes w x w, which is zero).
  bool omit_gyroscopic_term = true;
  /// Rotor speeds have no upper bound; false clamps them to `max_rotor_speed`.
  bool unlimited_rotor_speed = true;
  double max_rotor_speed = 838.0;  ///< [rad/s], read only when unlimited_rotor_speed is false
};

/// Gains of the attitude errors about the body axes. Defaults: RotorS' for the Firefly.
struct AttitudeGains {
  Eigen::Vector3d attitude{3.0, 3.0, 0.035};        ///< [N m/rad]
  Eigen::Vector3d angular_rate{0.52, 0.52, 0.025};  ///< [N m s/rad]

  /// Throws trident::Error naming the gain, its value and the legal range.
  void validate() const;
};

/// Attitude error -> rotor speeds: the inner half shared by all multirotor controllers here.
///   e_R = 1/2 vee(Rd' R - R' Rd);  e_w = w - Rd' R (0, 0, yaw_rate)
///   acc = -(k_R J^-1) e_R - (k_w J^-1) e_w;  speed^2 = A^+ diag(J, 1) (acc, thrust), negative -> 0
/// T. Lee, M. Leok, N. H. McClamroch, "Geometric tracking control of a quadrotor UAV on SE(3)", CDC
/// 2010, eq. 10, 11, 16. Copyable, immutable, allocates only while it is constructed.
class AttitudeLaw {
 public:
  /// Throws trident::Error naming the field, value and legal range.
  AttitudeLaw(const VehicleParams& vehicle, const AttitudeGains& gains,
              const AttitudeQuirks& quirks);

  /// Of the vehicle that it was made for.
  std::size_t rotor_count() const { return static_cast<std::size_t>(to_squared_speeds_.rows()); }

  /// Inputs must be finite. `thrust` along body z [N]; `rotor_speeds` [rad/s], exactly
  /// rotor_count() long.
  void compute(const Eigen::Matrix3d& R_world_body, const Eigen::Vector3d& w_body,
               const Eigen::Matrix3d& R_world_desired, double yaw_rate, double thrust,
               Span<double> rotor_speeds) const;
  /// Body rates [rad/s] in the place of an attitude: e_R = 0, e_w = w - w_desired.
  void compute_rates(const Eigen::Vector3d& w_body, const Eigen::Vector3d& w_desired, double thrust,
                     Span<double> rotor_speeds) const;

 private:
  void allocate(const Eigen::Vector3d& w_body, const Eigen::Vector3d& acceleration, double thrust,
                Span<double> rotor_speeds) const;

  AllocationInverse to_squared_speeds_;  // A^+ diag(J, 1)
  Eigen::Vector3d attitude_gain_;        // k_R J^-1 [1/s^2]
  Eigen::Vector3d angular_rate_gain_;    // k_w J^-1 [1/s]
  Eigen::Matrix3d inertia_;
  Eigen::Matrix3d inertia_inverse_;
  AttitudeQuirks quirks_;
};

}  // namespace trident::control
