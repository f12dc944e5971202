// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trident_base/config_fields.h"
#include "trident_base/config_node.h"
#include "trident_base/config_types.h"
#include "trident_nav/control/control_law.h"
#include "trident_nav/control/controller.h"
#include "trident_nav/control/moving_obstacles.h"
#include "trident_nav/navigator/navigator_params.h"
#include "trident_nav/navigator/recovery.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

/// An item of `recovery_behaviors`.
struct RecoveryChoice {
  std::string name;
  std::string type;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("name", name, "of its parameters' namespace");
    ar.required("type", type, "which one it is");
  }
};

/// Parameters of the node move_base itself, under upstream's names.
struct MoveBaseParams : NavigatorParams {
  std::string base_global_planner = "navfn/NavfnROS";
  std::string base_local_planner = "dwa_local_planner/DWAPlannerROS";
  std::vector<RecoveryChoice> recovery_behaviors;
  double conservative_reset_dist = 3.0;
  double clearing_radius = 0.0;
  bool clearing_rotation_allowed = true;
  bool shutdown_costmaps = false;
  bool make_plan_clear_costmap = true;
  bool make_plan_add_unreachable_goal = true;
  MovingObstacleParams moving_obstacles;
  bool lockstep = false;
  double localization_lead = -1.0;
  double goal_patience = 0.0;

  template <class Archive>
  void visit(Archive& ar) {
    NavigatorParams::visit(ar);
    ar.field("base_global_planner", base_global_planner, "plugin that plans");
    ar.field("base_local_planner", base_local_planner, "plugin that commands");
    ar.field("recovery_behaviors", recovery_behaviors,
             "in their order; none: reset, turn, further reset, turn");
    ar.field("conservative_reset_dist", conservative_reset_dist, Range::non_negative(),
             "of the first reset [m]");
    ar.field("clearing_radius", clearing_radius, Range::non_negative(),
             "accepted: what is under the footprint is always free [m]");
    ar.field("clearing_rotation_allowed", clearing_rotation_allowed, "the robot may turn to see");
    ar.field("shutdown_costmaps", shutdown_costmaps, "accepted: idle costmaps cost little");
    ar.field("make_plan_clear_costmap", make_plan_clear_costmap,
             "accepted: planners leave occupied starts by themselves");
    ar.field("make_plan_add_unreachable_goal", make_plan_add_unreachable_goal,
             "accepted: a plan's last pose is what can be reached");
    ar.field("moving_obstacles", moving_obstacles, "what is tracked");
    ar.field("lockstep", lockstep,
             "each message of odometry is answered by one command, for a simulator that waits for "
             "it; all is computed in between");
    ar.field("localization_lead", localization_lead, Range{-1.0, 10.0},
             "in lockstep: by which localization stamps the transform that follows from a scan "
             "ahead of it (amcl's transform_tolerance); that of each scan is waited for. Negative: "
             "none is [s]");
    ar.field("goal_patience", goal_patience, Range::non_negative(),
             "in lockstep: wall time for which the world waits for the first goal, and for the "
             "next one after each that has ended [s]");
  }
};

/// What is logged while parts are made: sentences.
using Warnings = std::vector<std::string>;

/// The part of a plugin's name that its parameters' namespace has: "NavfnROS".
std::string plugin_namespace(const std::string& plugin);

/// A planner with its parameters from `node`, the map of its namespace; nullptr: defaults. Keys
/// that it does not know are warnings. Throws Error for an unknown plugin, ConfigError for values.
std::unique_ptr<Planner> make_planner(const std::string& plugin, const ConfigNode* node,
                                      const std::string& name_space, Warnings* warnings);

/// The robot's limits, the goal's tolerances and the law's own parameters, as a local planner's
/// parameters have them; old names become new ones with a warning.
struct ControllerConfig {
  ControlSetup setup;
  ConfigNode given;  ///< All parameters, under their new names.
  ConfigNode law;
  std::string odom_topic = "odom";
};
ControllerConfig read_controller_config(const ConfigNode* node, const std::string& name_space,
                                        Warnings* warnings);

/// The parameters of a planner's plugin that have a single value. Throws Error for an unknown one.
std::vector<ConfigField> planner_fields(const std::string& plugin);
/// Those of a local planner's plugin: what all have, then what its law has.
std::vector<ConfigField> controller_fields(const std::string& plugin);

/// The controller of a plugin's name. Throws as make_planner() does.
std::unique_ptr<Controller> make_local_planner(const std::string& plugin,
                                               const ControllerConfig& config,
                                               const std::string& name_space, Warnings* warnings);

/// The recoveries that `params` ask for, or move_base's own, with their parameters from `tree`, the
/// node's map. Throws as make_planner() does.
std::vector<NamedRecovery> make_recoveries(const MoveBaseParams& params, const RecoverySetup& setup,
                                           const ConfigNode& tree, Warnings* warnings);

}  // namespace trident::nav
