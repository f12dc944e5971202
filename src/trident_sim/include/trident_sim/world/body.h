// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "trident_base/se3.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

/// One collision shape of a model. The engine makes it; plugins may watch its contacts.
class Geom {
 public:
  /// "model::link::collision"
  const std::string& scoped_name() const { return name; }
  /// Has World::contacts() list the contacts of this shape, for as long as more watchers were added
  /// than removed.
  void add_watcher() { ++watchers; }
  /// To be called once for each add_watcher().
  void remove_watcher() { --watchers; }

 protected:
  Geom() = default;
  ~Geom() = default;
  Geom(Geom&&) = default;
  Geom& operator=(Geom&&) = default;

  std::string name;
  int watchers = 0;  ///< number of those who want its contacts
};

/// What a body weighs, with all links that it is made of.
struct CompositeMass {
  double mass_kg = 0.0;
  /// About the center of mass, body frame [kg m^2].
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d inertia_inverse = Eigen::Matrix3d::Identity();
  double weight_kg = 0.0;  ///< of the links that gravity pulls
  /// Where gravity pulls them, from the origin, body frame [m].
  Eigen::Vector3d p_weight = Eigen::Vector3d::Zero();
};

/// How a body stood and moved at one moment.
struct BodyMotion {
  SE3 T_world_body;
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();  ///< of the center of mass [m/s]
  Eigen::Vector3d w_world = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// By which a body loses velocity without contact [1/s].
struct BodyDamping {
  double linear = 0.0, angular = 0.0;
};

/// One rigid body: a link with everything rigidly fixed to it, and the rotors it carries. The body
/// frame has its origin at the composite center of mass and the axes of the first link. Plugins
/// read the state and apply forces; only the engine moves it (World::set_link_state() and its kin
/// place it).
class Body {
 public:
  virtual ~Body() = default;
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  /// "model::link" of its first link.
  const std::string& scoped_name() const { return name; }
  /// T_world_body.
  const SE3& pose() const { return T_world_body; }
  /// R_world_body, the rotation of pose() as a matrix.
  const Eigen::Matrix3d& rotation() const { return R_world_body; }
  /// Of the center of mass, world frame [m/s].
  const Eigen::Vector3d& velocity() const { return v_world; }
  /// World frame [rad/s].
  const Eigen::Vector3d& angular_velocity() const { return w_world; }
  /// Velocity of the point p (world coordinates) that moves with the body, world frame [m/s].
  Eigen::Vector3d velocity_at(const Eigen::Vector3d& p_world) const {
    return v_world + w_world.cross(p_world - T_world_body.p);
  }
  /// velocity() and angular_velocity() at the beginning of the last step: accelerations are
  /// differences over a step.
  const Eigen::Vector3d& previous_velocity() const { return before.v_world; }
  /// See previous_velocity(), world frame [rad/s].
  const Eigen::Vector3d& previous_angular_velocity() const { return before.w_world; }

  double mass() const { return composite.mass_kg; }  ///< [kg]
  /// About the center of mass, body frame [kg m^2].
  const Eigen::Matrix3d& inertia_tensor() const { return composite.inertia; }
  /// Inverse of inertia_tensor() [1/(kg m^2)].
  const Eigen::Matrix3d& inverse_inertia_tensor() const { return composite.inertia_inverse; }
  /// Mass of the links that gravity pulls [kg], and where it pulls them, body frame [m].
  double weight_mass() const { return composite.weight_kg; }
  /// See weight_mass().
  const Eigen::Vector3d& weight_point() const { return composite.p_weight; }
  /// Whether it moves with its velocity, whatever force acts on it.
  bool is_kinematic() const { return kinematic; }
  /// Whether one of its shapes touched another one in the last step.
  bool has_contact() const { return in_contact; }

  /// Adds a force [N], world frame, at the center of mass, for the next step.
  void apply_force(const Eigen::Vector3d& force_world) { force += force_world; }
  /// Adds a torque [N m], world frame, for the next step.
  void apply_torque(const Eigen::Vector3d& torque_world) { torque += torque_world; }
  /// Adds a force [N], world frame, that acts at a point in world coordinates, for the next step.
  void add_force_at(const Eigen::Vector3d& force_world, const Eigen::Vector3d& p_world) {
    force += force_world;
    torque += (p_world - T_world_body.p).cross(force_world);
  }
  /// Sums of what was applied for the next step so far, world frame, torque about the center of
  /// mass.
  const Eigen::Vector3d& applied_force() const { return force; }
  /// See applied_force() [N m].
  const Eigen::Vector3d& applied_torque() const { return torque; }

 protected:
  Body() = default;

  // The state, which EngineBody opens to the engine.
  std::string name;
  SE3 T_world_body;
  SE3 T_world_body_initial;  ///< as spawned
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_world_body = Eigen::Matrix3d::Identity();  ///< T_world_body.R as a matrix

  CompositeMass composite;
  BodyDamping damping;

  // Accumulated over a step, world frame, torque about the center of mass.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  /// Angular momentum of the rotors about their own axes [kg m^2/s], body frame.
  Eigen::Vector3d rotor_momentum = Eigen::Vector3d::Zero();
  /// At the beginning of the last step; accelerations are differences over a step.
  BodyMotion before;
  bool in_contact = false;  ///< this step
  bool kinematic = false;   ///< moves with its velocity, whatever pushes
};

}  // namespace trident::sim
