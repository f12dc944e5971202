// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/roll_pitch_yawrate_thrust_controller.h"

#include <Eigen/Geometry>
#include <cmath>

namespace trident::control {

RollPitchYawrateThrustController::RollPitchYawrateThrustController(
    const RollPitchYawrateThrustParams& params)
    : attitude_law_(params.vehicle, params.gains, params.quirks) {}

ControlStatus RollPitchYawrateThrustController::compute(const OdometryState& state,
                                                        const AttitudeCommand& command,
                                                        Span<double> rotor_speeds) const {
  if (rotor_speeds.size() != rotor_count()) return ControlStatus::wrong_rotor_count;
  if (!is_valid(state)) return ControlStatus::invalid_state;
  if (!is_valid(command)) return ControlStatus::invalid_reference;

  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const Eigen::Matrix3d R_WB = state.R_world_body.toRotationMatrix();
  const double yaw = std::atan2(R_WB(1, 0), R_WB(0, 0));
  const Eigen::Matrix3d R_WD =
      (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(command.roll, Vector3d::UnitX()) *
       AngleAxisd(command.pitch, Vector3d::UnitY()))
          .toRotationMatrix();
  attitude_law_.compute(R_WB, state.w_body, R_WD, command.yaw_rate, command.thrust, rotor_speeds);
  return ControlStatus::ok;
}

}  // namespace trident::control
