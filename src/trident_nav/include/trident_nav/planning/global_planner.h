// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

class GridRoute;

/// How global_planner sets the headings of a path. Numbers of its `orientation_mode`.
enum class OrientationMode {
  kNone = 0,                ///< Headings are 0, but for the goal's.
  kForward = 1,             ///< Along the path.
  kInterpolate,             ///< From the start's heading to the goal's, evenly.
  kForwardThenInterpolate,  ///< Along the path; from where it is straight to the end, evenly.
  kBackward,
  kLeftward,
  kRightward,
};

/// Sets the headings of all poses but the first and the last.
/// `window`: a heading is that from the pose this many before to the one this many after.
void set_orientations(Path& path, OrientationMode mode, int window);

/// Parameters of global_planner/GlobalPlanner.
struct GlobalPlannerParams {
  bool old_navfn_behavior = false;
  bool use_quadratic = true;
  bool use_dijkstra = true;
  bool use_grid_path = false;
  bool allow_unknown = true;
  double planner_window_x = 0.0;
  double planner_window_y = 0.0;
  double default_tolerance = 0.0;
  int publish_scale = 100;
  bool outline_map = true;
  int lethal_cost = 253;
  int neutral_cost = 50;
  double cost_factor = 3.0;
  bool publish_potential = true;
  int orientation_mode = 1;
  int orientation_window_size = 1;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("old_navfn_behavior", old_navfn_behavior,
             "costs are not cut below lethal_cost, as in navfn");
    ar.field("use_quadratic", use_quadratic,
             "straight lines between cells where they cost no more; false: steps of the grid");
    ar.field("use_dijkstra", use_dijkstra,
             "accepted: both settings search with A*, whose path costs as little as Dijkstra's");
    ar.field("use_grid_path", use_grid_path, "the path follows the cells of the grid");
    ar.field("allow_unknown", allow_unknown, "whether paths may cross unknown cells");
    ar.field("planner_window_x", planner_window_x, Range::non_negative(),
             "accepted as upstream accepts it: of no influence [m]");
    ar.field("planner_window_y", planner_window_y, Range::non_negative(),
             "accepted as upstream accepts it: of no influence [m]");
    ar.field("default_tolerance", default_tolerance, Range::non_negative(),
             "how far from an unreachable goal the path may end [m]");
    ar.field("publish_scale", publish_scale, Range{1, 100}, "highest value of the shown potential");
    ar.field("outline_map", outline_map, "the cells along the map's border are blocked");
    ar.field("lethal_cost", lethal_cost, Range{1, 255}, "cells of this cost and more are blocked");
    ar.field("neutral_cost", neutral_cost, Range{1, 255}, "cost of a free cell");
    ar.field("cost_factor", cost_factor, Range{0.01, 5.0}, "factor of the costmap's costs");
    ar.field("publish_potential", publish_potential, "whether the node publishes `potential`");
    ar.field("orientation_mode", orientation_mode, Range{0, 6},
             "0 none, 1 forward, 2 interpolate, 3 forward then interpolate, 4 backward, "
             "5 leftward, 6 rightward");
    ar.field("orientation_window_size", orientation_window_size, Range{1, 255},
             "poses to both sides that a heading is taken from");
  }
};

/// The path of least cost over the 8-neighbor graph of cells; a cell of cost c counts
/// neutral_cost + cost_factor c, at most lethal_cost - 1, as unknown cells do.
class GlobalPlanner : public Planner, public PotentialSource {
 public:
  explicit GlobalPlanner(const GlobalPlannerParams& params);
  ~GlobalPlanner() override;

  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override;
  std::vector<float> potential() const override;
  PotentialDisplay display() const override {
    return {params_.publish_potential, params_.publish_scale};
  }

 private:
  GlobalPlannerParams params_;
  std::unique_ptr<GridRoute> route_;
  GridGeometry geometry_;
};

}  // namespace trident::nav
