// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "trident_nav/planning/planner.h"
#include "trident_nav/planning/smac_params.h"

namespace trident::nav {

class GridRoute;

/// Parameters of nav2_smac_planner::SmacPlanner2D. The bounds of time and iterations are accepted:
/// a search over cells comes to each once.
struct Smac2dParams : SmacParams {
  double cost_travel_multiplier = 1.0;

  Smac2dParams() { tolerance = 0.125; }

  template <class Archive>
  void visit(Archive& ar) {
    SmacParams::visit(ar);
    ar.field("cost_travel_multiplier", cost_travel_multiplier, Range::non_negative(),
             "weight of c / 252 along the path");
  }
};

/// The path of least length and cost over the 8-neighbor graph of cells, pulled taut: a cell of
/// cost c counts 1 + cost_travel_multiplier c / 252. Its `cost` is that of the cells.
class Smac2dPlanner : public Planner {
 public:
  explicit Smac2dPlanner(const Smac2dParams& params);
  ~Smac2dPlanner() override;

  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override;

 private:
  std::unique_ptr<GridRoute> route_;
  bool approach_orientation_;
};

}  // namespace trident::nav
