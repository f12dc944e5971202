// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "core/mavros_params.h"
#include "core/ros_side.h"
#include "core/vehicle_side.h"

namespace trident::mavros {

/// What several plugins need to know of the vehicle. World frame ENU, body frame FLU.
struct Known {
  Eigen::Quaterniond R_world_body = Eigen::Quaterniond::Identity();  ///< attitude
  Eigen::Vector3d w_body_rad_s = Eigen::Vector3d::Zero();            ///< angular velocity
  bool has_attitude = false;        ///< the vehicle has sent its attitude
  bool has_quaternion = false;      ///< ATTITUDE_QUATERNION comes: ATTITUDE is not needed
  double geoid_separation_m = 0.0;  ///< ellipsoid to mean sea level, up; 0 where nobody says
};

/// What a plugin works with. All of it outlives the plugins.
struct Hub {
  RosSide& ros;                ///< topics and services
  VehicleSide& vehicle;        ///< messages and commands
  const MavrosParams& params;  ///< of all plugins
  Known known;                 ///< what plugins share
};

/// Keeps hub.known.R_world_body and w_body_rad_s: to be called before the plugins are made.
void follow_attitude(Hub& hub);

/// Translates between topics or services and messages of MAVLink.
class Plugin {
 public:
  virtual ~Plugin() = default;
};

/// A plugin as lists name it.
struct PluginEntry {
  const char* name;                       ///< in plugin_blacklist and plugin_whitelist
  std::unique_ptr<Plugin> (*make)(Hub&);  ///< makes it
};

/// All plugins, in the order in which they are loaded.
const std::vector<PluginEntry>& all_plugins();

/// Whether a name fits a glob: * and ? as in a shell.
bool fits_glob(const std::string& name, const std::string& glob);
/// Whether a plugin is loaded: it is not in the blacklist, or it is in the whitelist.
bool is_wanted(const std::string& name, const MavrosParams& params);
/// Makes all that are wanted.
std::vector<std::unique_ptr<Plugin>> make_plugins(Hub& hub);

}  // namespace trident::mavros
