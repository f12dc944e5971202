// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident::sim {

// Plugins under the names of gazebo_plugins, for ground robots.

PluginFactory diff_drive_factory();
PluginFactory skid_steer_drive_factory();
PluginFactory tricycle_drive_factory();
PluginFactory kobuki_factory();
PluginFactory ackermann_drive_factory();
PluginFactory planar_move_factory();
PluginFactory joint_state_publisher_factory();
PluginFactory p3d_factory();

}  // namespace trident::sim
