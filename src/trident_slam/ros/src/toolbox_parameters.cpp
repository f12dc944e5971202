// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/toolbox_parameters.h"

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

constexpr char kCeres[] = "solver_plugins::CeresSolver";
constexpr char kOwn[] = "trident";

}  // namespace

PoseGraphSolverMaker read_solver(ros_utils::NodeParams& params, const std::string& solver_plugin) {
  if (solver_plugin == kOwn || solver_plugin.empty()) return {};
  if (solver_plugin != kCeres) {
    throw Error("parameter " + params.name_space() + "/solver_plugin: unknown solver " +
                unknown_name_text(solver_plugin, {kOwn, kCeres}));
  }
  return [options = params.read<CeresParams>().options](int max_iterations) {
    CeresOptions limited = options;
    limited.max_iterations = max_iterations;
    return make_ceres_solver<SE2>(limited);
  };
}

void accept_toolbox_names(ros_utils::NodeParams& params) {
  params.accept({"paused_new_measurements", "interactive_mode", "paused_processing"});
  // lifelong_candidates_scale has no effect in slam_toolbox, either; ceres_* have one with Ceres.
  params.accept_without_effect({"stack_size_to_use",
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
                                "ceres_loss_function"});
}

}  // namespace trident::slam
