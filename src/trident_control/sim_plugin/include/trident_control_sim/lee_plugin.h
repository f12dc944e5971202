// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_control/lee_position_controller.h"
#include "trident_control/setpoint_queue.h"
#include "trident_sim/plugin_registry.h"

namespace trident::control {

/// What command/trajectory carries. Stamp zero: takes effect at once.
struct TrajectorySample {
  SimTime stamp;                      ///< start of the trajectory, see SetpointQueue
  std::vector<TimedSetpoint> points;  ///< in rising order of their times
};

/// Adds "libtrident_vessel_controller.so" (vessel_controller_plugin.h) and
/// "libtrident_lee_position_controller.so": the Lee controller inside the simulator, on the
/// same ports, with the same timing and the same arithmetic as the node. Parameters:
/// robotNamespace; odometryTopic (odometry_sensor1/odometry); commandTopic (command/motor_speed);
/// trajectoryTopic (command/trajectory); parameterFiles: space separated YAML files as the node's
/// rosparam loads (lee_controller_<mav>.yaml, <mav>.yaml), as absolute paths without spaces.
void register_control_plugins(sim::PluginRegistry& registry);

/// Controller parameters from the YAML files of rotors_gazebo/resource. Throws Error.
LeeParams load_lee_params(const std::vector<std::string>& files);

}  // namespace trident::control
