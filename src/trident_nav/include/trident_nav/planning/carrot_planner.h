// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/config_types.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

/// Parameters of carrot_planner/CarrotPlanner.
struct CarrotPlannerParams {
  double step_size = 0.0;
  double min_dist_from_robot = 0.10;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("step_size", step_size, Range::non_negative(),
             "steps back from an occupied goal; 0: the map's resolution [m]");
    ar.field("min_dist_from_robot", min_dist_from_robot, Range::non_negative(),
             "a place that is nearer to the robot is not tried [m]");
  }
};

/// Two poses: the start, and the goal or, where the footprint is in contact there, the first place
/// on the straight line back to the start at which it is free. The line between them is not
/// checked, as upstream does not: a local planner follows it as far as it can. `reason` says where
/// it is blocked.
class CarrotPlanner : public Planner {
 public:
  explicit CarrotPlanner(const CarrotPlannerParams& params) : params_(params) {}

  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override;

 private:
  CarrotPlannerParams params_;
};

}  // namespace trident::nav
