// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident {

/// Waypoints to follow (nav_msgs/Path). `stamp`: from when on; 0: at once.
struct PathCommand {
  SimTime stamp;
  std::vector<Eigen::Vector3d> p_world;  ///< [m]
};

/// Something that is to be done once, a picture to be taken say (std_msgs/Empty on a topic).
struct TriggerCommand {
  SimTime stamp;  ///< not looked at: it acts in the next step
};

/// The same, asked for by a service without arguments (std_srvs/Empty).
struct ServiceCommand {
  SimTime stamp;  ///< not looked at: it acts in the next step
};

}  // namespace trident
