// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trident_sim/model_spec.h"

namespace trident::sim {

// Models as plain data, without a detour over XML.

using ParamList = std::vector<std::pair<std::string, std::string>>;

/// A plugin element whose children are `params`.
PluginSpec make_plugin(const std::string& name, const std::string& filename,
                       const ParamList& params);

LinkSpec make_link(const std::string& name, double mass_kg, const Eigen::Vector3d& inertia,
                   const SE3& T_model_link = {});
CollisionSpec make_collision(const Shape& shape, const Surface& surface = {});

/// One link "link" of one shape, with the inertia of a solid 0.2 m cube.
ModelSpec make_body(const std::string& name, const Shape& shape, const SE3& T_world_model,
                    double mass_kg = 1.0, const Surface& surface = {});
/// The plane z = 0.
ModelSpec make_ground(const Surface& surface = {});
ModelSpec make_static(const std::string& name, const Shape& shape, const SE3& T_world_model);

JointSpec make_joint(const std::string& name, JointType type, const std::string& parent,
                     const std::string& child, const SE3& T_model_joint,
                     const Eigen::Vector3d& axis_model);

/// A model "m" of a link "bob" of 1 kg, its origin and centre of mass at `p`, on a joint "j" to the
/// world at the origin.
ModelSpec make_on_world(JointType type, const Eigen::Vector3d& p, const Eigen::Vector3d& axis,
                        const Eigen::Vector3d& inertia = {0.02, 0.03, 0.04});

/// A quadrotor in "+" form with RotorS' plugins, unlike any of RotorS' vehicles.
struct QuadOptions {
  std::string name = "quad";
  std::string robot_namespace = "quad";
  double body_mass_kg = 0.9, rotor_mass_kg = 0.025;
  double arm_m = 0.25;
  double motor_constant = 1.2e-5, moment_constant = 0.02;
  double time_constant_up_s = 0.02, time_constant_down_s = 0.05;
  double max_speed_rad_s = 900.0, slowdown = 10.0;
  double rotor_drag = 0.0, rolling_moment = 0.0;
  SE3 T_world_model;

  double mass_kg() const { return body_mass_kg + 4.0 * rotor_mass_kg; }
  /// Speed at which four rotors carry the quad [rad/s].
  double hover_speed_rad_s(double gravity = 9.8) const;
};
ModelSpec make_quad(const QuadOptions& options = {});
/// The parameters of one motor of that quad.
ParamList motor_params(const QuadOptions& options, int motor);

}  // namespace trident::sim
