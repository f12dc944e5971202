// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "rotor_axis.h"

namespace trident {
namespace {

/// Turns v by the rotation with which ODE moves a body that turns at w, 2 half = dt w: the
/// quaternion (1, half), normalised.
Eigen::Vector3d step_turned(const Eigen::Vector3d& half, const Eigen::Vector3d& v) {
  const Eigen::Vector3d across = half.cross(v);
  return v + 2.0 / (1.0 + half.squaredNorm()) * (across + half.cross(across));
}

}  // namespace

Eigen::Vector3d rotor_axis_reaction(const Joint& joint, double erp, double dt_s) {
  return -joint.transverse_inertia * erp / (dt_s * dt_s) *
         joint.rotor_axis_body.cross(joint.axis_body);
}

void advance_rotor_axis(Joint& joint, const Eigen::Vector3d& w_body, double erp, double dt_s) {
  const Eigen::Vector3d& axis = joint.rotor_axis_body;
  const Eigen::Vector3d w_rotor =
      w_body + joint.spun_velocity * axis + erp / dt_s * axis.cross(joint.axis_body);
  const Eigen::Vector3d turned = step_turned(0.5 * dt_s * w_rotor, axis);
  joint.rotor_axis_body = step_turned(-0.5 * dt_s * w_body, turned).normalized();
}

}  // namespace trident
