// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/toolbox_parameters.h"

#include <array>
#include <string>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_slam/graph_slam_options.h"
#include "trident_slam/pose_graph_ceres.h"
#include "trident_slam_ros/parameter_names.h"
#include "trident_slam_ros/slam_node.h"

namespace trident::slam {
namespace {

constexpr char kCeres[] = "solver_plugins::CeresSolver";
constexpr char kOwn[] = "trident";

const std::array<std::pair<const char*, std::string CeresOptions::*>, 5> kCeresParameters{
    {{"ceres_linear_solver", &CeresOptions::linear_solver},
     {"ceres_preconditioner", &CeresOptions::preconditioner},
     {"ceres_trust_strategy", &CeresOptions::trust_strategy},
     {"ceres_dogleg_type", &CeresOptions::dogleg_type},
     {"ceres_loss_function", &CeresOptions::loss_function}}};

/// What slam_toolbox' scan matcher and memory are set with (lifelong_candidates_scale has no effect
/// there, either).
const ParameterNames& upstream_parameters() {
  static const ParameterNames names = {"stack_size_to_use",
                                       "use_scan_barycenter",
                                       "link_match_minimum_response_fine",
                                       "link_scan_maximum_distance",
                                       "loop_match_maximum_variance_coarse",
                                       "loop_match_minimum_response_coarse",
                                       "correlation_search_space_dimension",
                                       "correlation_search_space_resolution",
                                       "correlation_search_space_smear_deviation",
                                       "loop_search_space_dimension",
                                       "loop_search_space_resolution",
                                       "loop_search_space_smear_deviation",
                                       "distance_variance_penalty",
                                       "angle_variance_penalty",
                                       "fine_search_angle_offset",
                                       "coarse_search_angle_offset",
                                       "coarse_angle_resolution",
                                       "minimum_angle_penalty",
                                       "minimum_distance_penalty",
                                       "use_response_expansion",
                                       "lifelong_candidates_scale",
                                       "ceres_linear_solver",
                                       "ceres_preconditioner",
                                       "ceres_trust_strategy",
                                       "ceres_dogleg_type",
                                       "ceres_loss_function"};
  return names;
}

}  // namespace

PoseGraphSolverMaker read_solver(const ros::NodeHandle& own) {
  std::string plugin = kOwn;
  own.getParam("solver_plugin", plugin);
  if (plugin == kOwn || plugin.empty()) return {};
  if (plugin != kCeres) {
    throw Error("parameter " + own.resolveName("solver_plugin") + ": unknown solver " +
                unknown_name_text(plugin, {kOwn, kCeres}));
  }
  CeresOptions options;
  for (const auto& [name, field] : kCeresParameters) own.getParam(name, options.*field);
  options.validate();
  return [options](int max_iterations) {
    CeresOptions limited = options;
    limited.max_iterations = max_iterations;
    return make_ceres_solver<SE2>(limited);
  };
}

void tell_unused_toolbox_parameters(const ros::NodeHandle& own, bool has_solver) {
  ParameterNames used = field_names<GraphSlamOptions>();
  const auto add = [&used](const ParameterNames& names) {
    used.insert(used.end(), names.begin(), names.end());
  };
  add(slam_node_parameters());
  // The last three are told by the node itself.
  add({"method", "config_file", "solver_plugin", "map_file_name", "map_start_at_dock", "map_name",
       "debug_logging", "enable_interactive_mode", "paused_new_measurements", "interactive_mode",
       "paused_processing"});
  if (has_solver) {
    for (const auto& [name, field] : kCeresParameters) used.emplace_back(name);
  }
  tell_unused(own, used, upstream_parameters());
}

}  // namespace trident::slam
