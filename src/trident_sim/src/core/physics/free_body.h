// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/physics/engine_body.h"

namespace trident::sim {

/// -w x (I w + h) in the world frame: h is the momentum of the rotor joints.
inline Eigen::Vector3d gyroscopic_torque(const EngineBody& body) {
  const Eigen::Vector3d w = body.R_world_body.transpose() * body.w_world;
  return body.R_world_body * -w.cross(body.composite.inertia * w + body.rotor_momentum);
}

/// Gazebo's <velocity_decay>.
inline void apply_velocity_decay(EngineBody& body, double dt_s) {
  if (body.damping.linear > 0.0) body.v_world *= std::max(0.0, 1.0 - dt_s * body.damping.linear);
  if (body.damping.angular > 0.0) body.w_world *= std::max(0.0, 1.0 - dt_s * body.damping.angular);
}

/// Not a number, or beyond what any vehicle does: the next steps could only make it worse.
inline bool is_diverged(const EngineBody& body) {
  return !(body.v_world.squaredNorm() < 1e10 && body.w_world.squaredNorm() < 1e8 &&
           body.T_world_body.p.squaredNorm() < 1e14);
}

/// Semi-implicit Euler: velocities from the forces at the beginning of the step, then the pose with
/// the new velocities, as ODE does (quaternion by its derivative, then normalised).
void integrate_free_body(EngineBody& body, double dt_s);

}  // namespace trident::sim
