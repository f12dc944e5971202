// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident::sim {

// RotorS' plugins, with RotorS' parameters, defaults and formulas.
PluginFactory motor_model_factory();
PluginFactory multirotor_base_factory();
PluginFactory controller_interface_factory();
PluginFactory odometry_factory();
PluginFactory imu_factory();
PluginFactory wind_factory();

}  // namespace trident::sim
