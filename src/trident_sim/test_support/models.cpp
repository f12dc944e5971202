// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "models.h"

#include <cmath>
#include <sstream>

namespace trident::sim {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

}  // namespace

PluginSpec make_plugin(const std::string& name, const std::string& filename,
                       const ParamList& params) {
  PluginSpec plugin{name, filename, {}};
  plugin.params.name = "plugin";
  for (const auto& [key, value] : params) plugin.params.children.push_back({key, value, {}, {}});
  return plugin;
}

LinkSpec make_link(const std::string& name, double mass_kg, const Eigen::Vector3d& inertia,
                   const SE3& T_model_link) {
  LinkSpec link;
  link.name = name;
  link.T_model_link = T_model_link;
  link.inertial.mass_kg = mass_kg;
  link.inertial.inertia_com = inertia.asDiagonal();
  return link;
}

CollisionSpec make_collision(const Shape& shape, const Surface& surface) {
  return {"collision", {}, shape, surface};
}

ModelSpec make_body(const std::string& name, const Shape& shape, const SE3& T_world_model,
                    double mass_kg, const Surface& surface) {
  ModelSpec model;
  model.name = name;
  model.T_world_model = T_world_model;
  model.links.push_back(
      make_link("link", mass_kg, Eigen::Vector3d::Constant(mass_kg * 0.04 / 6.0)));
  model.links[0].collisions.push_back(make_collision(shape, surface));
  return model;
}

ModelSpec make_ground(const Surface& surface) {
  ModelSpec model =
      make_body("ground", PlaneShape{Eigen::Vector3d::UnitZ()}, SE3::identity(), 1.0, surface);
  model.is_static = true;
  return model;
}

ModelSpec make_static(const std::string& name, const Shape& shape, const SE3& T_world_model) {
  ModelSpec model = make_body(name, shape, T_world_model);
  model.is_static = true;
  return model;
}

JointSpec make_joint(const std::string& name, JointType type, const std::string& parent,
                     const std::string& child, const SE3& T_model_joint,
                     const Eigen::Vector3d& axis_model) {
  JointSpec joint;
  joint.name = name;
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  joint.T_model_joint = T_model_joint;
  joint.axis_model = axis_model;
  return joint;
}

ModelSpec make_on_world(JointType type, const Eigen::Vector3d& p, const Eigen::Vector3d& axis,
                        const Eigen::Vector3d& inertia) {
  ModelSpec model;
  model.name = "m";
  model.links.push_back(make_link("bob", 1.0, inertia, SE3{Eigen::Quaterniond::Identity(), p}));
  model.joints.push_back(make_joint("j", type, "world", "bob", {}, axis));
  return model;
}

double QuadOptions::hover_speed_rad_s(double gravity) const {
  return std::sqrt(mass_kg() * gravity / (4.0 * motor_constant));
}

ParamList motor_params(const QuadOptions& options, int motor) {
  const std::string number = std::to_string(motor);
  return {{"robotNamespace", options.robot_namespace},
          {"jointName", "rotor_" + number + "_joint"},
          {"linkName", "rotor_" + number},
          {"turningDirection", motor % 2 == 0 ? "cw" : "ccw"},
          {"motorNumber", number},
          {"commandSubTopic", "gazebo/command/motor_speed"},
          {"motorSpeedPubTopic", "motor_speed/" + number},
          {"timeConstantUp", text(options.time_constant_up_s)},
          {"timeConstantDown", text(options.time_constant_down_s)},
          {"maxRotVelocity", text(options.max_speed_rad_s)},
          {"motorConstant", text(options.motor_constant)},
          {"momentConstant", text(options.moment_constant)},
          {"rotorDragCoefficient", text(options.rotor_drag)},
          {"rollingMomentCoefficient", text(options.rolling_moment)},
          {"rotorVelocitySlowdownSim", text(options.slowdown)}};
}

ModelSpec make_quad(const QuadOptions& options) {
  ModelSpec model;
  model.name = options.name;
  model.T_world_model = options.T_world_model;
  model.links.push_back(make_link("base_link", options.body_mass_kg, {0.007, 0.008, 0.012}));
  const ParamList common{{"robotNamespace", options.robot_namespace}, {"linkName", "base_link"}};
  ParamList base = common;
  base.emplace_back("rotorVelocitySlowdownSim", text(options.slowdown));
  model.plugins.push_back(make_plugin("base", "librotors_gazebo_multirotor_base_plugin.so", base));
  for (int i = 0; i < 4; ++i) {
    const std::string rotor = "rotor_" + std::to_string(i);
    const double angle = i * std::acos(0.0);
    const SE3 T_model_rotor =
        SE3{Eigen::Quaterniond::Identity(),
            {options.arm_m * std::cos(angle), options.arm_m * std::sin(angle), 0.0}};
    model.links.push_back(
        make_link(rotor, options.rotor_mass_kg, {1e-5, 1e-5, 2e-5}, T_model_rotor));
    model.joints.push_back(make_joint(rotor + "_joint", JointType::kRevolute, "base_link", rotor,
                                      T_model_rotor, Eigen::Vector3d::UnitZ()));
    model.plugins.push_back(make_plugin(
        "motor_" + std::to_string(i), "librotors_gazebo_motor_model.so", motor_params(options, i)));
  }
  model.plugins.push_back(
      make_plugin("control", "librotors_gazebo_controller_interface.so", common));
  ParamList odometry = common;
  odometry.emplace_back("odometryTopic", "odometry");
  odometry.emplace_back("childFrameId", options.robot_namespace + "/base_link");
  model.plugins.push_back(make_plugin("odometry", "librotors_gazebo_odometry_plugin.so", odometry));
  return model;
}

}  // namespace trident::sim
