// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "rotor_axis.h"

namespace trident {
namespace {

/// The rotation by which ODE moves a body that turns at w: first order, then normalised.
Eigen::Quaterniond step_rotation(const Eigen::Vector3d& w, double dt_s) {
  const Eigen::Vector3d half = 0.5 * dt_s * w;
  return Eigen::Quaterniond(1.0, half.x(), half.y(), half.z()).normalized();
}

}  // namespace

Eigen::Vector3d rotor_axis_reaction(const Joint& joint, double erp, double dt_s) {
  return -joint.transverse_inertia * erp / (dt_s * dt_s) *
         joint.rotor_axis_body.cross(joint.axis_body);
}

void advance_rotor_axis(Joint& joint, double erp, double dt_s) {
  const Body& body = *joint.child->body;
  const Eigen::Vector3d& axis = joint.rotor_axis_body;
  const Eigen::Vector3d w_body = body.R_world_body.transpose() * body.w_world;
  const Eigen::Vector3d w_rotor =
      w_body + joint.spun_velocity * axis + erp / dt_s * axis.cross(joint.axis_body);
  const Eigen::Quaterniond turn =
      step_rotation(w_body, dt_s).conjugate() * step_rotation(w_rotor, dt_s);
  joint.rotor_axis_body = (turn * axis).normalized();
}

}  // namespace trident
