// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/move_base_params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

ConfigNode empty_map() {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kMap;
  return node;
}

std::optional<ConfigNode> take(ConfigNode* map, const std::string& key) {
  const auto at = std::find(map->keys.begin(), map->keys.end(), key);
  if (at == map->keys.end()) return std::nullopt;
  const auto i = at - map->keys.begin();
  ConfigNode value = map->items[static_cast<std::size_t>(i)];
  map->keys.erase(at);
  map->items.erase(map->items.begin() + i);
  map->key_lines.erase(map->key_lines.begin() + i);
  return value;
}

void put(ConfigNode* map, const std::string& key, ConfigNode value) {
  map->keys.push_back(key);
  map->key_lines.push_back(0);
  map->items.push_back(std::move(value));
}

/// `what`: of the error, which may know what was meant.
std::string no_effect_text(const std::string& parameter, const std::string& what) {
  const auto list = what.find(" Known keys:");
  const auto guess = what.find("id you mean");
  return "parameter " + parameter + " has no effect" +
         (guess == std::string::npos ? "." : "; d" + what.substr(guess, list - guess));
}

/// Calls make() until it finds no key that it does not know; each is left out with a warning.
template <class Make>
auto make_leniently(ConfigNode config, const std::string& name_space, Warnings* warnings,
                    const Make& make, const std::string& silent_key = "") {
  for (;;) {
    try {
      return make(config);
    } catch (const ConfigError& error) {
      const std::string what = error.what();
      const bool is_unknown = what.find("unknown key") != std::string::npos;
      if (!is_unknown || !take(&config, error.key())) throw;
      if (error.key() == silent_key) continue;
      warnings->push_back(no_effect_text(name_space + "/" + error.key(), what));
    }
  }
}

struct Renamed {
  const char* old_name;
  const char* new_name;
};
constexpr std::array kRenamed = {
    Renamed{"max_rot_vel", "max_vel_theta"},
    Renamed{"max_vel_rot", "max_vel_theta"},
    Renamed{"max_rotational_vel", "max_vel_theta"},
    Renamed{"min_rot_vel", "min_vel_theta"},
    Renamed{"min_vel_rot", "min_vel_theta"},
    Renamed{"max_trans_vel", "max_vel_trans"},
    Renamed{"min_trans_vel", "min_vel_trans"},
    Renamed{"acc_limit_trans", "acc_lim_trans"},
    Renamed{"acc_lim_th", "acc_lim_theta"},
    Renamed{"rot_stopped_vel", "theta_stopped_vel"},
    Renamed{"pdist_scale", "path_distance_bias"},
    Renamed{"gdist_scale", "goal_distance_bias"},
    Renamed{"min_in_place_rotational_vel", "min_in_place_vel_theta"},
};

void rename_old(ConfigNode* map, const std::string& name_space, Warnings* warnings) {
  for (const Renamed& renamed : kRenamed) {
    std::optional<ConfigNode> value = take(map, renamed.old_name);
    if (!value) continue;
    const bool is_given = map->find(renamed.new_name) != nullptr;
    warnings->push_back("parameter " + name_space + "/" + renamed.old_name + " is now called " +
                        renamed.new_name + (is_given ? ", which is given, too." : "."));
    if (!is_given) put(map, renamed.new_name, std::move(*value));
  }
}

/// What robots can do and what is near enough, under the names that local planners share and with
/// dwa_local_planner's defaults.
struct MotionParams {
  double max_vel_x = 0.55, min_vel_x = 0.0, max_vel_y = 0.0, max_vel_theta = 1.0;
  double acc_lim_x = 2.5, acc_lim_y = 2.5, acc_lim_theta = 3.2;
  double min_turning_radius = 0.0;
  double command_delay = 0.04;
  double xy_goal_tolerance = 0.1, yaw_goal_tolerance = 0.1;
  double trans_stopped_vel = 0.1, theta_stopped_vel = 0.1;
  std::string odom_topic = "odom";

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("max_vel_x", max_vel_x, Range::positive(), "[m/s]");
    ar.field("min_vel_x", min_vel_x, "negative: backwards [m/s]");
    ar.field("max_vel_y", max_vel_y, Range::non_negative(), "[m/s]");
    ar.field("max_vel_theta", max_vel_theta, Range::positive(), "[rad/s]");
    ar.field("acc_lim_x", acc_lim_x, Range::positive(), "[m/s^2]");
    ar.field("acc_lim_y", acc_lim_y, Range::non_negative(), "[m/s^2]");
    ar.field("acc_lim_theta", acc_lim_theta, Range::positive(), "[rad/s^2]");
    ar.field("min_turning_radius", min_turning_radius, Range::non_negative(), "[m]");
    ar.field("command_delay", command_delay, Range{0.0, 1.0},
             "from the data that a command is computed of to its effect [s]");
    ar.field("xy_goal_tolerance", xy_goal_tolerance, Range::positive(), "[m]");
    ar.field("yaw_goal_tolerance", yaw_goal_tolerance, Range::positive(), "[rad]");
    ar.field("trans_stopped_vel", trans_stopped_vel, Range::positive(), "[m/s]");
    ar.field("theta_stopped_vel", theta_stopped_vel, Range::positive(), "[rad/s]");
    ar.field("odom_topic", odom_topic, "nav_msgs/Odometry with the robot's velocity");
  }
};

const std::vector<std::string>& motion_names() {
  static const std::vector<std::string> names = {
      "max_vel_x",         "min_vel_x",          "max_vel_y",         "max_vel_theta",
      "acc_lim_x",         "acc_lim_y",          "acc_lim_theta",     "min_turning_radius",
      "xy_goal_tolerance", "yaw_goal_tolerance", "trans_stopped_vel", "theta_stopped_vel",
      "odom_topic",        "command_delay"};
  return names;
}

/// Least values, for those laws that have them, and what they must not exceed.
struct LeastVelocities {
  std::optional<double> min_vel_x, min_vel_theta, max_vel_theta, min_vel_trans, max_vel_trans;
  double max_vel_x = MotionParams{}.max_vel_x;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("max_vel_x", max_vel_x);
    ar.field("min_vel_x", min_vel_x);
    ar.field("min_vel_theta", min_vel_theta);
    ar.field("max_vel_theta", max_vel_theta);
    ar.field("min_vel_trans", min_vel_trans);
    ar.field("max_vel_trans", max_vel_trans);
  }
  void validate() const {
    check("min_vel_x", min_vel_x, "max_vel_x", max_vel_x);
    check("min_vel_theta", min_vel_theta, "max_vel_theta", max_vel_theta);
    check("min_vel_trans", min_vel_trans, "max_vel_trans", max_vel_trans);
  }

 private:
  static void check(const std::string& low, const std::optional<double>& least,
                    const std::string& high, const std::optional<double>& most) {
    if (!least || !most || *least <= *most) return;
    throw Error(low + " is " + number_text(*least) + ", legal is at most " + high + ", which is " +
                number_text(*most));
  }
};

/// Throws ConfigError where a least velocity of a local planner exceeds the greatest one.
void check_least_velocities(const ConfigNode& given, const std::string& name_space) {
  ConfigNode part = empty_map();
  for (const ConfigField& field : config_fields<LeastVelocities>()) {
    if (const ConfigNode* value = given.find(field.name)) put(&part, field.name, *value);
  }
  load_config_node<LeastVelocities>(part, name_space);
}

MotionLimits limits_of(const MotionParams& p) {
  return {p.max_vel_x,         std::min(p.min_vel_x, 0.0),
          p.max_vel_y,         p.max_vel_theta,
          p.acc_lim_x,         p.acc_lim_x,
          p.acc_lim_y,         p.acc_lim_theta,
          p.min_turning_radius};
}

NamedRecovery make_recovery(const RecoveryChoice& choice, const RecoverySetup& setup,
                            ConfigNode config, const std::string& name_space, Warnings* warnings) {
  const RecoveryRegistry registry = builtin_recoveries();
  const RecoveryFactory& factory = registry.get(choice.type);
  return {choice.name,
          make_leniently(std::move(config), name_space, warnings,
                         [&](const ConfigNode& node) { return factory(setup, node, name_space); })};
}

}  // namespace

std::string plugin_namespace(const std::string& plugin) {
  const auto cut = plugin.find_last_of("/:");
  return cut == std::string::npos ? plugin : plugin.substr(cut + 1);
}

std::unique_ptr<Planner> make_planner(const std::string& plugin, const ConfigNode* node,
                                      const std::string& name_space, Warnings* warnings) {
  const Registry<PlannerFactory> registry = builtin_planners();
  const PlannerFactory& factory = registry.get(planner_name(plugin));
  return make_leniently(node != nullptr ? *node : empty_map(), name_space, warnings,
                        [&](const ConfigNode& config) { return factory(config, name_space); });
}

std::vector<ConfigField> planner_fields(const std::string& plugin) {
  return builtin_planners().get(planner_name(plugin)).fields;
}

std::vector<ConfigField> controller_fields(const std::string& plugin) {
  std::vector<ConfigField> fields = config_fields<MotionParams>();
  const std::vector<std::string>& shared = motion_names();
  const ControlLawRegistry laws = builtin_control_laws();
  for (const ConfigField& field : laws.get(controller_name(plugin)).fields) {
    const bool is_shared = std::find(shared.begin(), shared.end(), field.name) != shared.end();
    if (!is_shared) fields.push_back(field);
  }
  // What odometry comes on is subscribed at the start.
  fields.erase(std::remove_if(fields.begin(), fields.end(),
                              [](const ConfigField& one) { return one.name == "odom_topic"; }),
               fields.end());
  return fields;
}

ControllerConfig read_controller_config(const ConfigNode* node, const std::string& name_space,
                                        Warnings* warnings) {
  ControllerConfig result;
  result.law = node != nullptr ? *node : empty_map();
  rename_old(&result.law, name_space, warnings);
  result.given = result.law;
  ConfigNode motion = empty_map();
  for (const std::string& name : motion_names()) {
    if (auto value = take(&result.law, name)) put(&motion, name, std::move(*value));
  }
  const auto params = load_config_node<MotionParams>(motion, name_space);
  check_least_velocities(result.given, name_space);
  result.setup.limits = limits_of(params);
  result.setup.command_delay_s = params.command_delay;
  result.setup.tolerance.xy_goal_tolerance = params.xy_goal_tolerance;
  result.setup.tolerance.yaw_goal_tolerance = params.yaw_goal_tolerance;
  result.setup.tolerance.trans_stopped_velocity = params.trans_stopped_vel;
  result.setup.tolerance.rot_stopped_velocity = params.theta_stopped_vel;
  result.odom_topic = params.odom_topic;
  // A law may have a least speed forward of its own.
  if (motion.find("min_vel_x") != nullptr) put(&result.law, "min_vel_x", *motion.find("min_vel_x"));
  return result;
}

std::unique_ptr<Controller> make_local_planner(const std::string& plugin,
                                               const ControllerConfig& config,
                                               const std::string& name_space, Warnings* warnings) {
  const auto make = [&](const ConfigNode& law) {
    return make_controller(plugin, config.setup, law, name_space);
  };
  return make_leniently(config.law, name_space, warnings, make, "min_vel_x");
}

namespace {

const char* const kClearCostmaps = "clear_costmap_recovery/ClearCostmapRecovery";
const char* const kConservative = "conservative_reset";
const char* const kAggressive = "aggressive_reset";

/// What move_base tries by default.
std::vector<RecoveryChoice> default_recoveries(bool may_rotate) {
  const RecoveryChoice rotation{"rotate_recovery", "rotate_recovery/RotateRecovery"};
  std::vector<RecoveryChoice> choices{RecoveryChoice{kConservative, kClearCostmaps}};
  if (may_rotate) choices.push_back(rotation);
  choices.push_back({kAggressive, kClearCostmaps});
  choices.push_back({"retreat", "trident_nav/Retreat"});
  if (may_rotate) choices.push_back(rotation);
  return choices;
}

/// How far from the robot costmaps are kept by the recoveries of move_base's own names [m].
std::optional<double> reset_distance(const RecoveryChoice& choice, const MoveBaseParams& params,
                                     const RecoverySetup& setup) {
  constexpr double kAggressiveRadii = 4.0;
  if (choice.type != kClearCostmaps) return std::nullopt;
  if (choice.name == kAggressive) return kAggressiveRadii * setup.footprint.circumscribed_radius;
  if (choice.name == kConservative) return params.conservative_reset_dist;
  return std::nullopt;
}

}  // namespace

std::vector<NamedRecovery> make_recoveries(const MoveBaseParams& params, const RecoverySetup& setup,
                                           const ConfigNode& tree, Warnings* warnings) {
  const std::vector<RecoveryChoice> choices =
      params.recovery_behaviors.empty() ? default_recoveries(params.clearing_rotation_allowed)
                                        : params.recovery_behaviors;
  std::vector<NamedRecovery> result;
  for (const RecoveryChoice& choice : choices) {
    const ConfigNode* const given = tree.find(choice.name);
    ConfigNode config = given != nullptr ? *given : empty_map();
    const std::optional<double> distance_m = reset_distance(choice, params, setup);
    if (distance_m && config.find("reset_distance") == nullptr) {
      ConfigNode side;
      side.kind = ConfigNode::Kind::kScalar;
      side.scalar = number_text(*distance_m);
      put(&config, "reset_distance", std::move(side));
    }
    result.push_back(make_recovery(choice, setup, std::move(config), choice.name, warnings));
  }
  return result;
}

}  // namespace trident::nav
