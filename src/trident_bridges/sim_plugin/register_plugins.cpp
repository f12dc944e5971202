// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_sim/register_plugins.h"

#include "ardupilot_plugin.h"
#include "mavlink_interface.h"

namespace trident::bridges {

void register_sitl_plugins(sim::PluginRegistry& registry) {
  registry.add("libgazebo_mavlink_interface.so", sim::factory_of<MavlinkInterface>());
  registry.add("libArduPilotPlugin.so", sim::factory_of<ArduPilotPlugin>());
}

}  // namespace trident::bridges

extern "C" void trident_register_plugins(trident::sim::PluginRegistry& registry) {
  trident::bridges::register_sitl_plugins(registry);
}
