// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "trident_base/config_types.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

class GridRoute;
class ThetaSearch;

/// Parameters of nav2_theta_star_planner::ThetaStarPlanner.
struct ThetaStarParams {
  int how_many_corners = 8;
  double w_euc_cost = 1.0;
  double w_traversal_cost = 2.0;
  bool allow_unknown = true;
  int terminal_checking_interval = 5000;
  bool use_final_approach_orientation = false;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("how_many_corners", how_many_corners, Range{4, 8},
             "neighbors that a cell is expanded to: 4 or 8");
    ar.field("w_euc_cost", w_euc_cost, Range::positive(), "weight of a path's length");
    ar.field("w_traversal_cost", w_traversal_cost, Range::non_negative(),
             "weight of (c / 252)^2 along the path");
    ar.field("allow_unknown", allow_unknown, "whether paths may cross unknown cells");
    ar.field("terminal_checking_interval", terminal_checking_interval, Range{1, 1e9},
             "expansions between two looks at the cancel flag, at most 4096");
    ar.field("use_final_approach_orientation", use_final_approach_orientation,
             "the last pose has the heading of arrival instead of the goal's");
  }
  /// Throws Error when how_many_corners is neither 4 nor 8.
  void validate() const;
};

/// Any-angle paths by Lazy Theta* (Nash, Koenig, Tovey, AAAI 2010) with costs integrated along
/// lines: a cell's line from its parent's parent is looked at only when the cell is expanded.
/// Never costs more than the taut path of least cost over the 8-neighbor graph, which is the
/// search's upper bound.
class ThetaStarPlanner : public Planner {
 public:
  explicit ThetaStarPlanner(const ThetaStarParams& params);
  ~ThetaStarPlanner() override;

  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override;

 private:
  ThetaStarParams params_;
  std::unique_ptr<GridRoute> route_;
  std::unique_ptr<ThetaSearch> search_;
};

}  // namespace trident::nav
