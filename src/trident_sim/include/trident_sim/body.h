// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "trident_base/se3.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

/// One collision shape with its ODE geometry.
struct Geom {
  dGeomID id = nullptr;
  dTriMeshDataID mesh = nullptr;
  dHeightfieldDataID heightfield = nullptr;
  Surface surface;   ///< fdir1 in the frame of the body, of the world for a static geometry
  std::string name;  ///< "model::link::collision"
  /// By which ODE's shape is larger all round [m], so that a contact is found before it is there
  double margin_m = 0.0;
  int watchers = 0;  ///< who wants its contacts in World::contacts()
};

/// One rigid body: a link with everything rigidly fixed to it, and the rotors it carries. The body
/// frame has its origin at the composite centre of mass and the axes of the first link.
/// State in the world frame; `inertia` in the body frame, about the origin.
struct Body {
  std::string name;
  SE3 T_world_body;
  SE3 T_world_body_initial;  ///< as spawned
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_world_body = Eigen::Matrix3d::Identity();  ///< T_world_body.R as a matrix

  double mass_kg = 0.0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d inertia_inverse = Eigen::Matrix3d::Identity();
  double linear_damping = 0.0, angular_damping = 0.0;
  double weight_kg = 0.0;                              ///< of the links that gravity pulls
  Eigen::Vector3d p_weight = Eigen::Vector3d::Zero();  ///< where, from the origin, body frame

  // Accumulated over a step, world frame, torque about the centre of mass.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  /// Angular momentum of the spun rotors about their own axes [kg m^2/s], body frame.
  Eigen::Vector3d rotor_momentum = Eigen::Vector3d::Zero();
  // State at the beginning of the last step; accelerations are differences over a step.
  SE3 T_before;
  Eigen::Vector3d v_before = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_before = Eigen::Vector3d::Zero();

  dBodyID ode = nullptr;
  std::vector<Geom> geoms;
  Eigen::Vector3d bound_centre = Eigen::Vector3d::Zero();  ///< body frame
  double bound_radius_m = 0.0;                             ///< 0: nothing to collide with
  int joint_count = 0;      ///< ODE joints that last longer than a step
  std::size_t number = 0;   ///< in the order of the engine
  bool in_contact = false;  ///< this step
  /// Put somewhere by hand, and not free of what it was put into since: it is pushed out slowly
  bool placed = true;
  bool emerging = false;   ///< this step
  bool frozen = false;     ///< its state grew without bound: it stands until a reset
  bool kinematic = false;  ///< moves with its velocity, whatever pushes
  bool self_collide = false;
  const void* owner = nullptr;  ///< bodies of one model do not collide unless self_collide

  void set_orientation(const Eigen::Quaterniond& R_world_body_new) {
    T_world_body.R = R_world_body_new;
    R_world_body = R_world_body_new.toRotationMatrix();
  }
  void state(StateArchive& archive) {
    archive(T_world_body, R_world_body, v_world, w_world, T_before, v_before, w_before, force,
            torque, rotor_momentum, in_contact, placed, frozen);
  }
  /// World velocity of the point p (world coordinates) that moves with the body.
  Eigen::Vector3d velocity_at(const Eigen::Vector3d& p_world) const {
    return v_world + w_world.cross(p_world - T_world_body.p);
  }
  void add_force_at(const Eigen::Vector3d& force_world, const Eigen::Vector3d& p_world) {
    force += force_world;
    torque += (p_world - T_world_body.p).cross(force_world);
  }
};

}  // namespace trident::sim
