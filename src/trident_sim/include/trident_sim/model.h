// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_sim/model_spec.h"
#include "trident_sim/plugin.h"
#include "trident_sim/world/body.h"

namespace trident::sim {

struct OdeJoint;
struct StaticGeoms;

/// A link as users know it. Several links may share a body.
struct Link {
  std::string name;      ///< unique within its model
  Body* body = nullptr;  ///< nullptr: part of a static model
  SE3 T_body_link;       ///< for a static link: T_world_link
  Inertial inertial;     ///< of this link alone, not of the whole body
  bool gravity = true;   ///< whether gravity pulls it

  SE3 T_world_link() const { return body ? body->pose() * T_body_link : T_body_link; }  ///< now
  /// Of this link's own mass [m]
  Eigen::Vector3d p_world_com() const { return T_world_link() * inertial.T_link_com.p; }
  /// Velocity of the point of the link that is at `p_world` now [m/s]; zero for a static link.
  Eigen::Vector3d v_world_at(const Eigen::Vector3d& p_world) const {
    return body ? body->velocity_at(p_world) : Eigen::Vector3d::Zero();
  }
  /// Angular velocity, world frame [rad/s]; zero for a static link.
  Eigen::Vector3d w_world() const {
    return body ? body->angular_velocity() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }
};

/// One axis of a joint at run time: `to` moves against `from`, about the axis or along it. A body
/// that is nullptr stands for the world.
struct JointAxis {
  AxisSpec spec;        ///< as in the file, with what set_axis_params() changed since
  bool linear = false;  ///< a length along the axis; else an angle about it
  /// Parent's and child's bodies, but for a gearbox, whose axes run from its reference body.
  Body *from = nullptr, *to = nullptr;
  const Body* carrier = nullptr;  ///< which the axis is fixed to
  /// Of unit length, in the carrier's body frame
  Eigen::Vector3d axis_carrier = Eigen::Vector3d::UnitZ();
  /// The anchor as spawned, in the frames of both bodies [m]
  Eigen::Vector3d p_from_anchor = Eigen::Vector3d::Zero(), p_to_anchor = Eigen::Vector3d::Zero();
  /// Where the joint is at zero
  Eigen::Quaterniond R_from_to_zero = Eigen::Quaterniond::Identity();

  double inertia = 0.0;  ///< of `to` against `from` as spawned [kg m^2] or [kg]
  double damping = 0.0;  ///< [N m s/rad] or [N s/m]
  double force = 0.0;    ///< applied in the next step [N m] or [N]
  double turned = 0.0;   ///< position at the end of the last step, for counting turns [rad]

  /// Direction of the axis now, of unit length.
  Eigen::Vector3d axis_world() const;
  /// Position and rate of an angle or a length as they are measured, without turns.
  double angle() const;        ///< in (-pi, pi]
  double angle_rate() const;   ///< [rad/s]
  double length() const;       ///< between the anchors, along the axis [m]
  double length_rate() const;  ///< [m/s]
  /// Turn of `to` against `from` since zero, in the axes of `from`.
  Eigen::Quaterniond turn() const;
  /// Adds a torque or a force on `to`, and its reaction on `from`.
  void push(double effort) const;
};

/// Keeps an axis at a rate with a limited effort, within the solver of the contacts: ODE's joint
/// motor, which Gazebo knows as "vel" and "fmax".
struct JointMotor {
  double rate = 0.0;          ///< [rad/s] or [m/s]
  double effort_limit = 0.0;  ///< [N m] or [N]
};

/// Inertia of a rotor about its own centre of mass [kg m^2], across the axis as a mean.
struct RotorInertia {
  double axial = 0.0, transverse = 0.0;
};

/// A joint as users know it: rigid (no degree of freedom), held by ODE, or a rotor joint, which is
/// kept as a scalar rate on its carrier (see docs/explanation/physics.md).
struct Joint {
  JointSpec spec;          ///< as in the file; limits and friction in use are those of `axes`
  Link* parent = nullptr;  ///< nullptr: the world
  Link* child = nullptr;   ///< never nullptr once the model is built
  std::shared_ptr<OdeJoint> ode;  ///< the engine's; nullptr: rigid or rotor joint
  std::vector<Body*> held;        ///< bodies that its constraints act on, ODE joints only
  Body* reference = nullptr;      ///< of a gearbox; nullptr: the world
  Body* shaft = nullptr;          ///< of a gearbox
  std::array<JointAxis, 2> axes;  ///< the first axis_count() of them
  /// On the axis of a revolute or prismatic joint, in place of its dry friction
  std::optional<JointMotor> motor;

  bool is_rotor = false;  ///< a motor plugin named it as its rotor
  Eigen::Vector3d axis_body =
      Eigen::Vector3d::UnitZ();  ///< of the carrier's body, rotor joint only
  /// Where the rotor's own axis points, which lags behind axis_body as in Gazebo; rotor joint only
  Eigen::Vector3d rotor_axis_body = Eigen::Vector3d::UnitZ();
  RotorInertia rotor_inertia;   ///< rotor joint only
  double rotor_position = 0.0;  ///< [rad]
  double rotor_velocity = 0.0;  ///< [rad/s]

  /// Axes that can be read and driven; none of a rigid joint, a ball and a rotor joint's
  /// neighbours.
  std::size_t axis_count() const;
  /// [rad] or [m]. An angle counts turns. 0 for an axis that the joint does not have.
  double position(std::size_t axis = 0) const;
  double velocity(std::size_t axis = 0) const;  ///< [rad/s] or [m/s]
  /// Sets the rate; on a rotor joint this is how a motor drives its rotor.
  void set_velocity(double rate);
  /// Adds to what drives the axis in the next step [N m] or [N].
  void add_effort(double effort, std::size_t axis = 0) { axes[axis].force += effort; }
  /// Keeps the positions, so that the next ones count turns. Called after each step.
  void count_turns();
  /// As spawned: nothing turned, nothing driven.
  void reset();
  /// Saves or restores what moves; what set_axis_params() set is not state.
  void state(StateArchive& archive);
};

/// One spawned model: its links, joints, bodies and plugins.
class Model {
 public:
  std::string name;             ///< unique in its world
  std::string robot_namespace;  ///< as given by the spawn request; "": none
  ModelSpec spec;  ///< without the plugins' parameters, which nothing needs after construction
  SE3 T_world_model_initial;       ///< where it was spawned, and where a reset puts it
  bool is_static = false;          ///< its links have no bodies, and it cannot be moved
  std::uint64_t spawn_number = 0;  ///< distinguishes successive models of one name

  std::vector<std::unique_ptr<Body>> bodies;     ///< links that are fixed to each other share one
  std::vector<std::unique_ptr<Link>> links;      ///< in file order
  std::vector<std::unique_ptr<Joint>> joints;    ///< in file order
  std::shared_ptr<StaticGeoms> static_geoms;     ///< the engine's; nullptr: none
  std::vector<std::unique_ptr<Plugin>> plugins;  ///< its own, then those of its sensors

  /// nullptr when it has no such link; `link_name` is without the model's name.
  Link* find_link(const std::string& link_name) const;
  /// nullptr when it has no such joint; `joint_name` is without the model's name.
  Joint* find_joint(const std::string& joint_name) const;
  /// The collision shapes of the body that `link` is part of, or of all static links if it is part
  /// of none. Valid as long as the model.
  std::vector<Geom*> collision_shapes(const Link& link) const;
  /// Whether it has collision shapes that are part of the world.
  bool has_static_shapes() const;
  /// Pose of the model frame, carried by the first link.
  SE3 T_world_model() const;
  /// The first link in the file, which carries the model frame; nullptr for a model without links.
  Link* canonical_link() const { return links.empty() ? nullptr : links.front().get(); }
};

}  // namespace trident::sim
