// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident::control {

/// "libtrident_vessel_controller.so": a vessel's controllers inside the simulator, on the topics of
/// vessel_controller_node, with its timing and its arithmetic. Parameters: robotNamespace; vessel
/// and controller: YAML files (config/vessels, config/controllers); odometryTopic (odometry);
/// commandTopic (command/motor_speed): the one that the vessel's plugin, before it, names.
sim::PluginFactory vessel_controller_factory();

}  // namespace trident::control
