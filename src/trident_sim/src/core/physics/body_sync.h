// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include "core/physics/engine_body.h"

namespace trident::sim {

/// Copies the state of a body into its ODE body, and back.
inline void push(const EngineBody& body) {
  const SE3& T = body.T_world_body;
  dBodySetPosition(body.ode, T.p.x(), T.p.y(), T.p.z());
  const dQuaternion q = {T.R.w(), T.R.x(), T.R.y(), T.R.z()};
  dBodySetQuaternion(body.ode, q);
  dBodySetLinearVel(body.ode, body.v_world.x(), body.v_world.y(), body.v_world.z());
  dBodySetAngularVel(body.ode, body.w_world.x(), body.w_world.y(), body.w_world.z());
}

/// Where ODE has a body.
inline SE3 ode_pose(const EngineBody& body) {
  const dReal* p = dBodyGetPosition(body.ode);
  const dReal* q = dBodyGetQuaternion(body.ode);
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]), {p[0], p[1], p[2]}};
}

inline void pull(EngineBody& body) {
  const SE3 pose = ode_pose(body);
  const dReal* v = dBodyGetLinearVel(body.ode);
  const dReal* w = dBodyGetAngularVel(body.ode);
  body.T_world_body.p = pose.p;
  body.set_orientation(pose.R);
  body.v_world = {v[0], v[1], v[2]};
  body.w_world = {w[0], w[1], w[2]};
}

}  // namespace trident::sim
