// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

class GridRoute;

/// Parameters of navfn/NavfnROS (ROS 1).
struct NavfnParams {
  bool allow_unknown = true;
  double planner_window_x = 0.0;
  double planner_window_y = 0.0;
  double default_tolerance = 0.0;
  bool visualize_potential = false;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("allow_unknown", allow_unknown, "whether paths may cross unknown cells");
    ar.field("planner_window_x", planner_window_x, Range::non_negative(),
             "accepted as upstream accepts it: of no influence [m]");
    ar.field("planner_window_y", planner_window_y, Range::non_negative(),
             "accepted as upstream accepts it: of no influence [m]");
    ar.field("default_tolerance", default_tolerance, Range::non_negative(),
             "how far from an unreachable goal the path may end [m]");
    ar.field("visualize_potential", visualize_potential, "whether the node publishes `potential`");
  }
};

/// Parameters of nav2_navfn_planner::NavfnPlanner.
struct Nav2NavfnParams {
  double tolerance = 0.5;
  bool use_astar = false;
  bool allow_unknown = true;
  bool use_final_approach_orientation = false;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("tolerance", tolerance, Range::non_negative(),
             "how far from an unreachable goal the path may end [m]");
    ar.field("use_astar", use_astar,
             "accepted: both settings search with A*, whose path costs as little as Dijkstra's");
    ar.field("allow_unknown", allow_unknown, "whether paths may cross unknown cells");
    ar.field("use_final_approach_orientation", use_final_approach_orientation,
             "the last pose has the heading of arrival instead of the goal's");
  }
};

/// The path of least cost over the 8-neighbor graph of cells, each cell at 50 + 0.8 c for a cost of
/// c (navfn's constants; unknown cells 253), pulled taut. Its `cost` is that of the cells; where
/// the path of the plan before is kept but for detours around new obstacles, it is that of the taut
/// path, which is not above the least cost over cells.
class NavfnPlanner : public Planner, public PotentialSource {
 public:
  explicit NavfnPlanner(const NavfnParams& params);
  explicit NavfnPlanner(const Nav2NavfnParams& params);
  ~NavfnPlanner() override;

  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override;
  std::vector<float> potential() const override;
  PotentialDisplay display() const override { return display_; }

 private:
  std::unique_ptr<GridRoute> route_;
  GridGeometry geometry_;
  bool approach_orientation_ = false;
  PotentialDisplay display_;
};

}  // namespace trident::nav
