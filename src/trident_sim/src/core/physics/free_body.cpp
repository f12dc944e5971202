// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "free_body.h"

namespace trident::sim {

void integrate_free_body(EngineBody& body, double dt_s) {
  if (!body.kinematic) {
    body.v_world += (dt_s / body.composite.mass_kg) * body.force;
    const Eigen::Matrix3d& R = body.R_world_body;
    const Eigen::Vector3d w = R.transpose() * body.w_world;
    const Eigen::Vector3d torque =
        R.transpose() * body.torque - w.cross(body.composite.inertia * w + body.rotor_momentum);
    body.w_world += dt_s * (R * (body.composite.inertia_inverse * torque));
    apply_velocity_decay(body, dt_s);
  }
  body.T_world_body.p += dt_s * body.v_world;
  const Eigen::Quaterniond& q = body.T_world_body.R;
  const Eigen::Quaterniond w_quaternion(0.0, body.w_world.x(), body.w_world.y(), body.w_world.z());
  Eigen::Quaterniond next;
  next.coeffs() = q.coeffs() + (0.5 * dt_s) * (w_quaternion * q).coeffs();
  next.normalize();
  body.set_orientation(next);
}

}  // namespace trident::sim
