// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "models.h"
#include "standalone_vessel.h"
#include "test_world.h"
#include "trident_sim/commands.h"

namespace trident::sim {

constexpr double kSeaGravity = 9.81;

inline std::string vessel_file(const std::string& name) {
  return std::string(TRIDENT_REPOSITORY) + "/config/vessels/" + name + ".yaml";
}

/// libtrident_sea.so with `elements`, each a name with its own elements: {"waves", {{...}}}.
inline PluginSpec make_sea(const std::vector<std::pair<std::string, ParamList>>& elements) {
  PluginSpec plugin = make_plugin("sea", "libtrident_sea.so", {});
  for (const auto& [name, children] : elements) {
    ParamNode node{name, "", {}, {}};
    for (const auto& [key, value] : children) node.children.push_back({key, value, {}, {}});
    plugin.params.children.push_back(std::move(node));
  }
  return plugin;
}

inline WorldSpec ocean(const std::vector<PluginSpec>& plugins = {}) {
  WorldSpec spec = world_spec();
  spec.physics.gravity = {0.0, 0.0, -kSeaGravity};
  spec.plugins = plugins;
  return spec;
}

/// A model of one link, "base_link", that has the vessel's rigid body about its origin.
inline ModelSpec make_hull(const VesselParams& vessel, const std::string& model,
                           const PluginSpec& plugin) {
  const RigidBody body = vessel.rigid_body();
  ModelSpec spec;
  spec.name = model;
  spec.links.push_back(make_link("base_link", body.mass_kg, Eigen::Vector3d::Ones()));
  spec.links[0].inertial.T_link_com.p = body.center_of_gravity;
  spec.links[0].inertial.inertia_com = body.inertia_cg;
  spec.plugins = {plugin};
  return spec;
}

/// A shipped vessel under its plugin, topics below its model's name.
inline ModelSpec make_boat(const std::string& vessel, const std::string& model = "boat") {
  return make_hull(
      shipped_vessel(vessel), model,
      make_plugin(
          "vessel", "libtrident_vessel.so",
          {{"robotNamespace", model}, {"vessel", vessel_file(vessel)}, {"bodyName", "base_link"}}));
}

/// To an input of any kind of number.
inline void command(World& world, const std::string& topic, double value) {
  const auto put = [&](auto* const port) {
    if (port != nullptr) port->write({world.time(), value});
    return port != nullptr;
  };
  PortBoard& ports = world.ports();
  EXPECT_TRUE(put(ports.find_in<ScalarSample>(topic)) || put(ports.find_in<SingleNumber>(topic)) ||
              put(ports.find_in<StampedNumber>(topic)))
      << topic;
}

/// The same command for both propellers of a boat.
inline void thrust(World& world, double value, const std::string& model = "boat") {
  for (const char* side : {"left", "right"}) {
    command(world, model + "/thrusters/" + side + "_thrust_cmd", value);
  }
}

}  // namespace trident::sim
