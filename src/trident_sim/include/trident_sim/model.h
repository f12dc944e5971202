// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trident_sim/body.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/plugin.h"

namespace trident {

/// A link as users know it. Several links may share a body.
struct Link {
  std::string name;
  Body* body = nullptr;  ///< nullptr: part of a static model
  SE3 T_body_link;       ///< for a static link: T_world_link
  Inertial inertial;

  SE3 T_world_link() const { return body ? body->T_world_body * T_body_link : T_body_link; }
  Eigen::Vector3d p_world_com() const { return T_world_link() * inertial.T_link_com.p; }
  Eigen::Vector3d v_world_at(const Eigen::Vector3d& p_world) const {
    return body ? body->velocity_at(p_world) : Eigen::Vector3d::Zero();
  }
  Eigen::Vector3d w_world() const {
    return body ? body->w_world : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }
};

/// A joint as users know it: rigid (no degree of freedom), an ODE joint, or a spun rotor, which is
/// kept as a scalar rate on its carrier (see docs/architecture.md, "Rotors").
struct Joint {
  JointSpec spec;
  Link* parent = nullptr;  ///< nullptr: the world
  Link* child = nullptr;
  dJointID ode = nullptr;

  bool spun = false;
  Eigen::Vector3d axis_body = Eigen::Vector3d::UnitZ();  ///< of the carrier's body, spun only
  /// Where the rotor's own axis points, which lags behind axis_body as in Gazebo; spun only
  Eigen::Vector3d rotor_axis_body = Eigen::Vector3d::UnitZ();
  double transverse_inertia = 0.0;  ///< [kg m^2], mean, spun only
  double axial_inertia = 0.0;       ///< [kg m^2], spun only
  double spun_position = 0.0;       ///< [rad]
  double spun_velocity = 0.0;       ///< [rad/s]

  double inertia = 0.0;  ///< of the two bodies against each other [kg m^2] or [kg], ODE joints only
  double force = 0.0;    ///< applied in the next step [N m] or [N]
  double damping = 0.0;  ///< [N m s/rad] or [N s/m]

  double position() const;  ///< [rad] or [m]
  double velocity() const;  ///< [rad/s] or [m/s]
  /// Sets the rate; on a spun joint this is how a motor drives its rotor.
  void set_velocity(double rate);
};

/// One spawned model: its links, joints, bodies and plugins.
class Model {
 public:
  std::string name;
  std::string robot_namespace;
  ModelSpec spec;  ///< without the plugins' parameters, which nothing needs after construction
  SE3 T_world_model_initial;
  bool is_static = false;
  std::size_t index = 0;

  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<std::unique_ptr<Link>> links;
  std::vector<std::unique_ptr<Joint>> joints;
  std::vector<Geom> static_geoms;
  std::vector<std::unique_ptr<Plugin>> plugins;

  Link* find_link(const std::string& link_name) const;
  Joint* find_joint(const std::string& joint_name) const;
  /// Pose of the model frame, carried by the first link.
  SE3 T_world_model() const;
  Link* canonical_link() const { return links.empty() ? nullptr : links.front().get(); }
};

}  // namespace trident
