// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/config_types.h"

namespace trident::nav {

/// Parameters that all Smac planners have. Times and iterations bound a search; where a planner
/// does not use one it accepts it as upstream's files have it.
struct SmacParams {
  double tolerance = 0.25;
  bool downsample_costmap = false;
  int downsampling_factor = 1;
  bool allow_unknown = true;
  int max_iterations = 1000000;
  int max_on_approach_iterations = 1000;
  int terminal_checking_interval = 5000;
  double max_planning_time = 2.0;
  bool use_final_approach_orientation = false;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("tolerance", tolerance, Range::non_negative(),
             "how far from an unreachable goal the path may end [m]");
    ar.field("downsample_costmap", downsample_costmap,
             "accepted: plans are made at the costmap's own resolution");
    ar.field("downsampling_factor", downsampling_factor, Range{1, 100},
             "accepted: plans are made at the costmap's own resolution");
    ar.field("allow_unknown", allow_unknown, "whether paths may cross unknown cells");
    ar.field("max_iterations", max_iterations, Range{-1, 2e9},
             "poses that a search comes to at most; -1: no limit");
    ar.field("max_on_approach_iterations", max_on_approach_iterations, Range{1, 2e9},
             "poses that a search looks at for a better path after it has found one");
    ar.field("terminal_checking_interval", terminal_checking_interval, Range{1, 1e9},
             "poses between two looks at the cancel flag, at most 256");
    ar.field("max_planning_time", max_planning_time, Range::positive(),
             "after this a search without a path ends [s]");
    ar.field("use_final_approach_orientation", use_final_approach_orientation,
             "the last pose has the heading of arrival instead of the goal's");
  }
};

/// Smoothing of Smac's paths. Parts of a path are replaced by shortest curves of the motion model,
/// so that the turning radius is kept, where upstream pulls at the poses and checks afterwards.
struct SmacSmootherParams {
  int max_iterations = 1000;
  double w_smooth = 0.3;
  double w_data = 0.2;
  double tolerance = 1e-10;
  bool do_refinement = true;
  int refinement_num = 2;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("max_iterations", max_iterations, Range{0, 1e9}, "curves that are tried at most");
    ar.field("w_smooth", w_smooth, Range::non_negative(),
             "accepted: curves replace what costs more, without a weight");
    ar.field("w_data", w_data, Range::non_negative(),
             "accepted: curves replace what costs more, without a weight");
    ar.field("tolerance", tolerance, Range::non_negative(),
             "cost that a curve must save, in cells");
    ar.field("do_refinement", do_refinement, "whether there is more than one pass over a path");
    ar.field("refinement_num", refinement_num, Range{0, 100}, "passes after the first");
  }
  int passes() const { return do_refinement ? 1 + refinement_num : 1; }
};

/// Parameters of the planners over poses.
struct SmacPoseParams : SmacParams {
  bool smooth_path = true;
  SmacSmootherParams smoother;
  double reverse_penalty = 2.0;
  double change_penalty = 0.0;
  double non_straight_penalty = 1.2;
  double cost_penalty = 2.0;
  double retrospective_penalty = 0.015;
  double analytic_expansion_ratio = 3.5;
  double analytic_expansion_max_length = 3.0;
  int analytic_expansion_max_cost = 200;
  bool analytic_expansion_max_cost_override = false;
  bool cache_obstacle_heuristic = false;
  double lookup_table_size = 20.0;
  bool debug_visualizations = false;

  template <class Archive>
  void visit(Archive& ar) {
    SmacParams::visit(ar);
    visit_costs(ar);
    ar.field("smooth_path", smooth_path, "whether paths are smoothed");
    ar.field("smoother", smoother, "how paths are smoothed");
    ar.field(
        "analytic_expansion_ratio", analytic_expansion_ratio, Range::positive(),
        "curves to the goal are tried at every n-th pose, n the distance left in cells by this");
    ar.field("analytic_expansion_max_length", analytic_expansion_max_length, Range::positive(),
             "no curve to the goal is longer [m]");
    ar.field("analytic_expansion_max_cost", analytic_expansion_max_cost, Range{0, 255},
             "no curve to the goal crosses a cell of a higher cost");
    ar.field("analytic_expansion_max_cost_override", analytic_expansion_max_cost_override,
             "within a full circle's length of the goal any cost will do");
    ar.field("cache_obstacle_heuristic", cache_obstacle_heuristic,
             "the heuristic of a goal is kept even when the costs change");
    ar.field("lookup_table_size", lookup_table_size, Range::positive(),
             "side of the square about the goal in which the length of the curve to it guides the "
             "search; it is computed, no table is kept [m]");
    ar.field("debug_visualizations", debug_visualizations, "accepted: of no influence");
  }

  template <class Archive>
  void visit_costs(Archive& ar) {
    ar.field("reverse_penalty", reverse_penalty, Range::at_least(1.0),
             "factor of the cost of driving backwards");
    ar.field("change_penalty", change_penalty, Range::non_negative(),
             "added to a turn's factor after one to the other side");
    ar.field("non_straight_penalty", non_straight_penalty, Range::at_least(1.0),
             "factor of the cost of turning");
    ar.field("cost_penalty", cost_penalty, Range::non_negative(),
             "weight of c / 252 along the path");
    ar.field("retrospective_penalty", retrospective_penalty, Range{0.0, 0.9},
             "share by which travel counts less than what is left to the goal");
  }
};

}  // namespace trident::nav
