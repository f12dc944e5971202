// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "../dwa/trajectory_critic.h"
#include "trident_base/config_node.h"
#include "trident_base/registry.h"

namespace trident::nav {

/// What a critic is made for.
struct DwbCriticSetup {
  GoalTolerance tolerance;
  double dt_s = 0.0;      ///< Between the points of trajectories.
  double sim_time = 0.0;  ///< Of trajectories [s].
  double radius_m = 0.0;  ///< Of the circle that encloses the footprint [m].
};

/// Makes a critic from the map of its keys. `name` is what it is called in the list of critics; it
/// begins the paths of keys in errors. Throws ConfigError.
using DwbCriticFactory = std::function<std::unique_ptr<TrajectoryCritic>(
    const DwbCriticSetup& setup, const ConfigNode& params, const std::string& label,
    const std::string& name)>;

/// Nav2's critics by their names without a namespace and without `Critic` at the end.
Registry<DwbCriticFactory> dwb_critics();

/// "dwb_critics::BaseObstacleCritic", "dwb_critics/BaseObstacle" and the like as "BaseObstacle".
std::string dwb_critic_type(const std::string& name);

}  // namespace trident::nav
