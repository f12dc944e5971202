// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "trident_base/config_types.h"
#include "trident_nav/planning/navfn_planner.h"
#include "trident_nav/planning/planner.h"
#include "trident_nav/planning/smac_hybrid_planner.h"

namespace trident::nav {

/// Parameters of trident_nav/RobotPlanner. The motion model and the turning radius in `hybrid` are
/// the robot's, whatever they say.
struct RobotPlannerParams {
  NavfnParams navfn;        ///< For robots that turn on the spot.
  SmacHybridParams hybrid;  ///< For robots with a turning radius.

  /// Names each field with its meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("navfn", navfn, "for robots that turn on the spot");
    ar.field("hybrid", hybrid, "for robots with a turning radius");
  }
};

/// Paths that the robot can follow, by its limits: over cells where it turns on the spot, else
/// curves of its turning radius, with turns of direction where it can drive backwards.
class RobotPlanner : public Planner {
 public:
  explicit RobotPlanner(const RobotPlannerParams& params);

  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override;

 private:
  Planner& planner_for(const MotionLimits& limits);

  RobotPlannerParams params_;
  NavfnPlanner navfn_;
  std::unique_ptr<SmacHybridPlanner> hybrid_;  ///< Made when it is first needed.
  SmacMotionModel hybrid_model_ = SmacMotionModel::kDubin;
};

}  // namespace trident::nav
