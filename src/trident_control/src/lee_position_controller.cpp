// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/lee_position_controller.h"

#include <algorithm>
#include <cmath>

#include "gain_validation.h"

namespace trident::control {
namespace {

// Below this the direction of a vector is rounding noise: of an acceleration [m/s^2], of a unit
// cross product.
constexpr double kMinLength = 1e-9;

// Columns b1d, b2d, b3d of the desired attitude; a_W is minus the wanted specific force.
Eigen::Matrix3d desired_attitude(const Eigen::Vector3d& a_W, double yaw,
                                 const Eigen::Matrix3d& R_WB) {
  // In free fall no direction of thrust is wanted, and the present one is kept.
  const double length = a_W.norm();
  const Eigen::Vector3d b3 =
      length > kMinLength ? Eigen::Vector3d(a_W / -length) : Eigen::Vector3d(R_WB.col(2));
  const Eigen::Vector3d heading(std::cos(yaw), std::sin(yaw), 0.0);
  Eigen::Vector3d b2 = b3.cross(heading);
  double b2_length = b2.norm();
  // Thrust along the heading leaves yaw undefined: the present
  // left axis is kept as far as it is perpendicular to the thrust.
  if (b2_length < kMinLength) {
    b2 = R_WB.col(1) - b3 * b3.dot(R_WB.col(1));
    b2_length = b2.norm();
  }
  // The left axis is parallel to the thrust, too; the forward axis cannot be.
  if (b2_length < kMinLength) {
    b2 = b3.cross(R_WB.col(0));
    b2_length = b2.norm();
  }
  b2 /= b2_length;
  Eigen::Matrix3d R_WD;
  R_WD << b2.cross(b3), b2, b3;
  return R_WD;
}

}  // namespace

void LeeGains::validate() const {
  validate_gain("position_gain", position);
  validate_gain("velocity_gain", velocity);
  AttitudeGains::validate();
}

LeePositionController::LeePositionController(const LeeParams& params)
    : attitude_law_(params.vehicle, params.gains, params.quirks),
      position_gain_(params.gains.position / params.vehicle.mass),
      velocity_gain_(params.gains.velocity / params.vehicle.mass),
      mass_(params.vehicle.mass),
      gravity_(params.vehicle.gravity) {
  params.gains.validate();
}

ControlStatus LeePositionController::compute(const OdometryState& state,
                                             const TrajectoryPoint& reference,
                                             Span<double> rotor_speeds) const {
  if (rotor_speeds.size() != rotor_count()) return ControlStatus::wrong_rotor_count;
  if (!is_valid(state)) return ControlStatus::invalid_state;
  if (!is_valid(reference)) return ControlStatus::invalid_reference;

  const Eigen::Matrix3d R_WB = state.R_world_body.toRotationMatrix();
  if (reference.level != ControlLevel::position) {
    compute_part(R_WB, state.w_body, reference, rotor_speeds);
    return ControlStatus::ok;
  }
  // Position loop: errors and feed-forward acceleration in the world frame, z up.
  const Eigen::Vector3d e_p = state.p_world_body - reference.p_world;
  const Eigen::Vector3d e_v = R_WB * state.v_body - reference.v_world;
  Eigen::Vector3d a_W =
      position_gain_.cwiseProduct(e_p) + velocity_gain_.cwiseProduct(e_v) - reference.a_world;
  a_W.z() -= gravity_;

  // Equation 15: the wanted force is projected on the present thrust axis.
  const double thrust = -mass_ * a_W.dot(R_WB.col(2));
  attitude_law_.compute(R_WB, state.w_body, desired_attitude(a_W, reference.yaw, R_WB),
                        reference.yaw_rate, thrust, rotor_speeds);
  return ControlStatus::ok;
}

/// Levels below position: the position loop has no part in them.
void LeePositionController::compute_part(const Eigen::Matrix3d& R_WB, const Eigen::Vector3d& w_body,
                                         const TrajectoryPoint& reference,
                                         Span<double> rotor_speeds) const {
  switch (reference.level) {
    case ControlLevel::attitude:
      attitude_law_.compute(R_WB, w_body, reference.R_world_body.normalized().toRotationMatrix(),
                            reference.yaw_rate, reference.thrust, rotor_speeds);
      return;
    case ControlLevel::rates:
      attitude_law_.compute_rates(w_body, reference.w_body, reference.thrust, rotor_speeds);
      return;
    default:
      std::fill(rotor_speeds.begin(), rotor_speeds.end(), 0.0);
  }
}

}  // namespace trident::control
