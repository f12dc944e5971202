// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Plugins of RotorS whose work is done elsewhere.
#include "trident_sim/plugin_registry.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

std::unique_ptr<Plugin> ignore(const PluginContext& /*context*/) { return nullptr; }

std::unique_ptr<Plugin> ignore_with_warning(const PluginContext& context) {
  context.world.report(Severity::kWarning,
                       context.params.owner() +
                           ": bags are recorded by 'rosbag record' (launch argument record), not "
                           "by the simulator; enable_logging has no effect");
  return nullptr;
}

const PluginRegistrar kRosInterface("librotors_gazebo_ros_interface_plugin.so", {ignore, {}});
const PluginRegistrar kBag("librotors_gazebo_bag_plugin.so", {ignore_with_warning, {}});

}  // namespace
}  // namespace trident::sim
