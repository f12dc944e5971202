// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include <string>
#include <vector>

#include "trident_sim/model.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/world/body.h"

namespace trident::sim {

/// A collision shape with its ODE geometry.
struct EngineGeom final : Geom {
  using Geom::name;
  using Geom::watchers;

  dGeomID id = nullptr;
  dTriMeshDataID mesh = nullptr;
  dHeightfieldDataID heightfield = nullptr;
  Surface surface;  ///< fdir1 in the frame of the body, of the world for a static geometry
  /// By which ODE's shape is larger all round [m], so that a contact is found before it is there
  double margin_m = 0.0;
};

/// A body as the engine knows it: all its state, and its ODE body.
struct EngineBody final : Body {
  using Body::before;
  using Body::composite;
  using Body::damping;
  using Body::force;
  using Body::in_contact;
  using Body::kinematic;
  using Body::name;
  using Body::R_world_body;
  using Body::rotor_momentum;
  using Body::T_world_body;
  using Body::T_world_body_initial;
  using Body::torque;
  using Body::v_world;
  using Body::w_world;

  dBodyID ode = nullptr;
  std::vector<EngineGeom> geoms;
  Eigen::Vector3d bound_center = Eigen::Vector3d::Zero();  ///< body frame
  double bound_radius_m = 0.0;                             ///< 0: nothing to collide with
  int joint_count = 0;     ///< ODE joints that last longer than a step
  std::size_t number = 0;  ///< in the order of the engine
  /// Put somewhere by hand, and not free of what it was put into since: it is pushed out slowly
  bool placed = true;
  bool depenetrating = false;  ///< this step
  bool frozen = false;         ///< its state grew without bound: it stands until a reset
  bool self_collide = false;
  const void* owner = nullptr;  ///< bodies of one model do not collide unless self_collide

  void set_orientation(const Eigen::Quaterniond& R_world_body_new) {
    T_world_body.R = R_world_body_new;
    R_world_body = R_world_body_new.toRotationMatrix();
  }
  void state(StateArchive& archive) {
    archive(T_world_body, R_world_body, v_world, w_world, before.T_world_body, before.v_world,
            before.w_world, force, torque, rotor_momentum, in_contact, placed, frozen);
  }
};

/// All bodies are the engine's.
inline EngineBody& engine_body(Body& body) { return static_cast<EngineBody&>(body); }
inline const EngineBody& engine_body(const Body& body) {
  return static_cast<const EngineBody&>(body);
}
inline EngineBody* engine_body(Body* body) { return static_cast<EngineBody*>(body); }
inline const EngineBody* engine_body(const Body* body) {
  return static_cast<const EngineBody*>(body);
}

/// The ODE joints of a joint that is neither rigid nor a rotor's.
struct OdeJoint {
  dJointID id = nullptr;
  std::vector<dJointID> more;  ///< what a screw and a gearbox need besides
};

/// What the engine keeps of a model that moves nothing: its shapes that are part of the world.
struct StaticGeoms {
  std::vector<EngineGeom> geoms;
};

}  // namespace trident::sim
