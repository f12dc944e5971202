// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident::sim {

/// A world's sea from an environment file or inline; VRX' wave field under its own elements.
PluginFactory sea_factory();
PluginFactory vrx_wave_field_factory();
/// A vessel from its file: hull, added mass, damping, thrusters, rudders.
PluginFactory vessel_factory();
/// A line from a body to an anchor.
PluginFactory mooring_factory();
/// A thruster of a vessel as a joint that turns.
PluginFactory propeller_factory();
/// VRX' hydrodynamics, thrusters, wind and floats under their own elements.
PluginFactory usv_dynamics_factory();
PluginFactory usv_thrust_factory();
PluginFactory usv_wind_factory();
PluginFactory buoyancy_factory();
/// uuv_simulator's thrusters and hydrodynamics under their own elements.
PluginFactory uuv_thruster_factory();
PluginFactory uuv_object_factory();
/// usv_sim_lsa's (freefloating_gazebo's): thrusters and state of a boat; the surface of a world.
PluginFactory freefloating_control_factory();
PluginFactory freefloating_fluid_factory();

}  // namespace trident::sim
