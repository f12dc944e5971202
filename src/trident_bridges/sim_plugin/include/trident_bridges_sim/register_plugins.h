// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident::bridges {

/// Adds libgazebo_mavlink_interface.so and libArduPilotPlugin.so. Throws Error when one is there.
void register_sitl_plugins(sim::PluginRegistry& registry);

}  // namespace trident::bridges
