// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "trident_ros/node_params.h"
#include "trident_slam/pose_graph_ceres.h"
#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

/// Private parameters of slam_toolbox' nodes beyond SlamNodeOptions and those of the method.
struct ToolboxParams {
  std::string solver_plugin = "trident";                ///< trident, or solver_plugins::CeresSolver
  std::string map_file_name;                            ///< session to continue, without its ending
  std::optional<std::array<double, 3>> map_start_pose;  ///< x [m], y [m], yaw [rad]
  std::optional<bool> map_start_at_dock;                ///< default: where there is no start pose
  std::string map_name = "map";                         ///< topic of the map
  bool debug_logging = false;                           ///< log debug messages, too
  bool enable_interactive_mode = true;                  ///< nodes may be moved in RViz

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("solver_plugin", solver_plugin, "trident, or solver_plugins::CeresSolver");
    ar.field("map_file_name", map_file_name, "session to continue, without its ending");
    ar.field("map_start_pose", map_start_pose, Range::any(),
             "where it is continued: x [m], y [m], yaw [rad]");
    ar.field("map_start_at_dock", map_start_at_dock,
             "it is continued at its first node; by default where map_start_pose is not set");
    ar.field("map_name", map_name, "topic of the map");
    ar.field("debug_logging", debug_logging, "log debug messages, too");
    ar.field("enable_interactive_mode", enable_interactive_mode, "nodes may be moved in RViz");
  }
};

/// Choices of Ceres, read where it is the solver.
struct CeresParams {
  CeresOptions options;  ///< as given to make_ceres_solver()

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("ceres_linear_solver", options.linear_solver,
             "SPARSE_NORMAL_CHOLESKY, SPARSE_SCHUR, ITERATIVE_SCHUR, CGNR");
    ar.field("ceres_preconditioner", options.preconditioner,
             "of the iterative solvers: SCHUR_JACOBI, JACOBI, IDENTITY");
    ar.field("ceres_trust_strategy", options.trust_strategy, "LEVENBERG_MARQUARDT, DOGLEG");
    ar.field("ceres_dogleg_type", options.dogleg_type, "TRADITIONAL_DOGLEG, SUBSPACE_DOGLEG");
    ar.field("ceres_loss_function", options.loss_function, "None, HuberLoss, CauchyLoss");
  }
  /// Throws Error naming field, value and what is legal.
  void validate() const { options.validate(); }
};

/// The solver that `solver_plugin` and the `ceres_*` parameters ask for; empty: our own. Throws
/// Error naming parameter, value and what is legal.
PoseGraphSolverMaker read_solver(ros_utils::NodeParams& params, const std::string& solver_plugin);

/// Marks the parameters that slam_toolbox' nodes set themselves as known, and those of its scan
/// matcher and memory as without effect.
void accept_toolbox_names(ros_utils::NodeParams& params);

}  // namespace trident::slam
