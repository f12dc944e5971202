// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_base/span.h"
#include "trident_control/attitude_law.h"
#include "trident_control/control_types.h"
#include "trident_control/vehicle_params.h"

namespace trident::control {

/// Defaults: RotorS' controller for the Firefly.
struct LeeGains : AttitudeGains {
  Eigen::Vector3d position{6.0, 6.0, 6.0};  ///< [N/m]
  Eigen::Vector3d velocity{4.7, 4.7, 4.7};  ///< [N s/m]

  /// Throws trident::Error naming the gain, its value and the legal range.
  void validate() const;
};

/// What LeePositionController is made from.
struct LeeParams {
  LeeGains gains;         ///< not yet divided by the mass
  VehicleParams vehicle;  ///< mass, inertia and rotors that it reckons with
  AttitudeQuirks quirks;  ///< where it keeps RotorS' departures from the paper
};

/// Geometric position controller as RotorS flies it.
///   a   = (k_p e_p + k_v e_v) / m - g e3 - a_d
///   b3d = -a / |a|;  b2d = normalize(b3d x (cos yaw, sin yaw, 0));  b1d = b2d x b3d;  T = -m a .
///   (R e3)
/// then AttitudeLaw. Lee, Leok, McClamroch, CDC 2010, eq. 12, 15 (gains in N/m, divided by the mass
/// here). A wanted acceleration of zero length keeps the present thrust axis; one along the
/// heading, for which b2d has no direction, keeps the present body y. References of a lower level
/// skip the position loop. Copyable, immutable, no
/// allocation in compute().
class LeePositionController {
 public:
  /// Throws trident::Error naming the field, value and legal range.
  explicit LeePositionController(const LeeParams& params);

  /// Length of compute()'s output.
  std::size_t rotor_count() const { return attitude_law_.rotor_count(); }

  /// `rotor_speeds`: rotor_count() values [rad/s, >= 0], untouched unless the result is ok.
  [[nodiscard]] ControlStatus compute(const OdometryState& state, const TrajectoryPoint& reference,
                                      Span<double> rotor_speeds) const;

 private:
  void compute_part(const Eigen::Matrix3d& R_WB, const Eigen::Vector3d& w_body,
                    const TrajectoryPoint& reference, Span<double> rotor_speeds) const;

  AttitudeLaw attitude_law_;
  Eigen::Vector3d position_gain_;  // k_p / m [1/s^2]
  Eigen::Vector3d velocity_gain_;  // k_v / m [1/s]
  double mass_;
  double gravity_;
};

}  // namespace trident::control
