// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "plugin_reference_cases.h"

#include <utility>

#include "plugin_cases.h"

namespace trident::sim {
namespace {

const std::string kRepository = TRIDENT_REPOSITORY;
const std::string kQuadBoat = kRepository + "/src/trident_sim/test/marine/quad_boat.yaml";

ParamNode element(const std::string& name, const ParamList& children) {
  ParamNode node{name, "", {}, {}};
  for (const auto& [key, value] : children) node.children.push_back({key, value, {}, {}});
  return node;
}

ReferenceCase of_model(const std::string& filename, const ParamList& params,
                       const std::vector<ParamNode>& elements = {}) {
  ReferenceCase result{make_plugin("case", filename, params)};
  for (const ParamNode& node : elements) result.plugin.params.children.push_back(node);
  return result;
}

ReferenceCase of_world(const std::string& filename, const ParamList& params,
                       const std::vector<ParamNode>& elements = {}) {
  ReferenceCase result = of_model(filename, params, elements);
  result.is_of_world = true;
  return result;
}

/// The case of a plugin in the conformance suite, with other elements first.
ReferenceCase variant(const std::string& filename, ParamList first) {
  for (const PluginCase& plugin : builtin_plugin_cases()) {
    if (plugin.filename != filename) continue;
    first.insert(first.end(), plugin.params.begin(), plugin.params.end());
    return {make_plugin("case", filename, first), plugin.sensor};
  }
  return of_model(filename, first);
}

ParamNode hull_link(const ParamList& model) {
  ParamNode link = element("link", {{"volume", "0.13"},
                                    {"metacentric_width", "0.1"},
                                    {"metacentric_length", "0.1"},
                                    {"submerged_height", "0.02"}});
  link.attributes.emplace_back("name", "base_link");
  link.children.push_back(element("box", {{"width", "1"}, {"length", "1.4"}, {"height", "0.3"}}));
  link.children.push_back(element("hydrodynamic_model", model));
  return link;
}

void add_thrusters_of_uuv_simulator(std::vector<ReferenceCase>& cases) {
  const ParamList own{{"linkName", "rotor_1"}, {"jointName", "rotor_1_joint"}, {"thrusterID", "0"}};
  const std::vector<ParamNode> dynamics{
      element("dynamics", {{"type", "ZeroOrder"}}),
      element("dynamics", {{"type", "FirstOrder"}, {"timeConstant", "0.05"}}),
      element("dynamics", {{"type", "Yoerger"}, {"alpha", "1"}, {"beta", "1"}}),
      element("dynamics", {{"type", "Bessa"},
                           {"Jmsp", "1"},
                           {"Kv1", "1"},
                           {"Kv2", "1"},
                           {"Kt", "1"},
                           {"Rm", "1"}})};
  const std::vector<ParamNode> conversions{
      element("conversion", {{"type", "Basic"}, {"rotorConstant", "0.01"}}),
      element("conversion", {{"type", "Bessa"},
                             {"rotorConstantL", "0.01"},
                             {"rotorConstantR", "0.01"},
                             {"deltaL", "-1"},
                             {"deltaR", "1"}}),
      element("conversion",
              {{"type", "LinearInterp"}, {"inputValues", "-1 1"}, {"outputValues", "-1 1"}})};
  for (const ParamNode& node : dynamics) {
    cases.push_back(of_model("libuuv_thruster_ros_plugin.so", own, {node, conversions[0]}));
  }
  for (const ParamNode& node : conversions) {
    cases.push_back(of_model("libuuv_thruster_ros_plugin.so", own, {dynamics[0], node}));
  }
}

void add_hulls_of_uuv_simulator(std::vector<ReferenceCase>& cases) {
  for (const char* type : {"fossen", "sphere", "cylinder", "box"}) {
    cases.push_back(
        of_model("libuuv_underwater_object_ros_plugin.so", {}, {hull_link({{"type", type}})}));
  }
}

void add_vessels(std::vector<ReferenceCase>& cases) {
  cases.push_back(of_model("libusv_gazebo_dynamics_plugin.so", {{"bodyName", "base_link"}}));
  cases.push_back(of_model("libusv_gazebo_thrust_plugin.so", {},
                           {element("thruster", {{"linkName", "rotor_1"},
                                                 {"propJointName", "rotor_1_joint"},
                                                 {"engineJointName", "rotor_2_joint"},
                                                 {"cmdTopic", "thrust_cmd"},
                                                 {"angleTopic", "thrust_angle"},
                                                 {"enableAngle", "true"}})}));
  cases.push_back(of_model(
      "libfreefloating_gazebo_control.so", {},
      {element("thruster", {{"map", "1 0 0 0 0 0"}}), element("thruster", {{"name", "rotor_1"}})}));
  ParamNode buoyancy = element("buoyancy", {{"link_name", "base_link"}});
  buoyancy.children.push_back(element("geometry", {}));
  buoyancy.children.back().children.push_back(element("sphere", {{"radius", "0.2"}}));
  cases.push_back(of_model("libbuoyancy_gazebo_plugin.so", {}, {buoyancy}));
  cases.push_back(of_model("libtrident_mooring.so",
                           {{"bodyName", "base_link"}, {"anchor", "0 0 -5"}, {"length", "6"}}));
  for (const char* input : {"commandTopic", "driveTopic"}) {
    cases.push_back(
        of_model("libtrident_vessel.so",
                 {{"bodyName", "base_link"}, {"vessel", kQuadBoat}, {input, "command"}}));
  }
}

void add_world_plugins(std::vector<ReferenceCase>& cases) {
  const ParamNode wind_object = element(
      "wind_obj", {{"name", "boat"}, {"link_name", "base_link"}, {"coeff_vector", "0.5 0.5 0.33"}});
  cases.push_back(of_model("libtrident_radio.so", {{"linkName", "base_link"}}));
  cases.push_back(of_world("libtrident_radio_medium.so", {}));
  for (const char* name : {"libtrident_sea.so", "libtrident_environment.so"}) {
    cases.push_back(of_world(name, {}));
    cases.push_back(
        of_world(name, {{"environment", kRepository + "/config/environments/calm.yaml"}}));
  }
  for (const char* name : {"libWavefieldModelPlugin.so", "libwavefield_model_plugin.so"}) {
    cases.push_back(of_world(name, {}, {element("wave", {{"model", "PMS"}})}));
    cases.push_back(of_world(name, {}, {element("wave", {{"model", "CWR"}})}));
  }
  cases.push_back(of_world("libfreefloating_gazebo_fluid.so", {}));
  cases.push_back(of_world("libusv_gazebo_wind_plugin.so", {}, {wind_object}));
}

void add_controllers(std::vector<ReferenceCase>& cases) {
  const std::string gains = kRepository + "/src/compat/rotors_gazebo/resource/";
  cases.push_back(of_model(
      "libtrident_lee_position_controller.so",
      {{"robotNamespace", "quad"},
       {"odometryTopic", "odometry"},
       {"parameterFiles", gains + "lee_controller_firefly.yaml " + gains + "firefly.yaml"}}));
  cases.push_back(of_model("libtrident_vessel_controller.so",
                           {{"robotNamespace", "quad"},
                            {"odometryTopic", "odometry"},
                            {"vessel", kRepository + "/config/vessels/otter.yaml"},
                            {"controller", kRepository + "/config/controllers/otter.yaml"}}));
  for (std::size_t i = cases.size() - 2; i < cases.size(); ++i) cases[i].needs_vehicle = true;
}

/// On a model without the controller whose place they take.
void add_outside_autopilots(std::vector<ReferenceCase>& cases) {
  cases.push_back(of_model("libgazebo_mavlink_interface.so", {},
                           {element("control_channels", {{"channel", ""}})}));
  cases.push_back(of_model("libArduPilotPlugin.so", {},
                           {element("control", {{"jointName", "rotor_0_joint"}})}));
}

void add_variants(std::vector<ReferenceCase>& cases) {
  cases.push_back(of_model("libtrident_follow.so", {{"followed", "case"}}));
  cases.push_back(variant("librotors_gazebo_wind_plugin.so",
                          {{"useCustomStaticWindField", "true"}, {"customWindFieldPath", "none"}}));
  cases.push_back(variant("libtrident_lidar3d.so", {{"pattern", "rosette"}}));
  cases.push_back(variant("libgazebo_ros_range.so", {{"radiation", "infrared"}}));
  cases.push_back(variant("libgazebo_ros_imu.so", {{"serviceName", "calibrate"}}));
  cases.push_back(variant("libgazebo_ros_ackermann_drive.so", {{"max_steer", "0.5"}}));
  cases.push_back(
      variant("libgazebo_ros_ackermann_drive.so",
              {{"left_steering_pid_gain", "1e-3 0 0"}, {"right_steering_pid_gain", "1e-3 0 0"}}));
  for (const char* model : {"Kinect", "D435"}) {
    cases.push_back(
        variant("librotors_gazebo_noisydepth_plugin.so", {{"depthNoiseModelName", model}}));
  }
  for (const char* name : {"rotors_gazebo_ros_interface_plugin", "rotors_gazebo_bag_plugin",
                           "gazebo_groundtruth_plugin"}) {
    cases.push_back(of_model(name, {}));
  }
}

}  // namespace

std::vector<ReferenceCase> reference_cases() {
  std::vector<ReferenceCase> cases;
  for (const PluginCase& plugin : builtin_plugin_cases()) {
    cases.push_back({make_plugin("case", plugin.filename, plugin.params), plugin.sensor});
  }
  add_vessels(cases);
  add_thrusters_of_uuv_simulator(cases);
  add_hulls_of_uuv_simulator(cases);
  add_world_plugins(cases);
  add_controllers(cases);
  add_outside_autopilots(cases);
  add_variants(cases);
  return cases;
}

ModelSpec reference_model(const ReferenceCase& plugin) {
  ModelSpec spec = make_quad();
  if (!plugin.needs_vehicle) spec.plugins.clear();
  if (!plugin.sensor) {
    spec.plugins.push_back(plugin.plugin);
    return spec;
  }
  LinkSpec& base = spec.links.front();
  base.collisions.push_back(make_collision(SphereShape{0.05}));  // for a bumper
  base.sensors.push_back(*plugin.sensor);
  base.sensors.back().name = "case";
  base.sensors.back().plugins = {plugin.plugin};
  return spec;
}

}  // namespace trident::sim
