// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "trident_nav/planning/planner.h"
#include "trident_nav/planning/smac_params.h"

namespace trident::nav {

class PoseRoute;

enum class SmacMotionModel { kDubin, kReedsShepp };

constexpr auto enum_names(SmacMotionModel) {
  return std::array{EnumName{SmacMotionModel::kDubin, "DUBIN"},
                    EnumName{SmacMotionModel::kReedsShepp, "REEDS_SHEPP"}};
}

/// Parameters of nav2_smac_planner::SmacPlannerHybrid.
struct SmacHybridParams : SmacPoseParams {
  SmacMotionModel motion_model_for_search = SmacMotionModel::kDubin;
  double minimum_turning_radius = 0.4;
  int angle_quantization_bins = 72;
  bool allow_primitive_interpolation = false;
  bool use_quadratic_cost_penalty = false;
  bool downsample_obstacle_heuristic = true;

  template <class Archive>
  void visit(Archive& ar) {
    SmacPoseParams::visit(ar);
    ar.field("motion_model_for_search", motion_model_for_search,
             "DUBIN: forwards only, REEDS_SHEPP: backwards, too");
    ar.field("minimum_turning_radius", minimum_turning_radius, Range::positive(),
             "of the tightest turn; not below the robot's own nor a cell's side [m]");
    ar.field("angle_quantization_bins", angle_quantization_bins, Range{8, 720},
             "headings of the search");
    ar.field("allow_primitive_interpolation", allow_primitive_interpolation,
             "also wider turns, to each heading up to that of the tightest");
    ar.field("use_quadratic_cost_penalty", use_quadratic_cost_penalty,
             "the square of c / 252 counts instead");
    ar.field("downsample_obstacle_heuristic", downsample_obstacle_heuristic,
             "the heuristic looks at blocks of 2 x 2 cells");
  }
};

/// Paths for vehicles of bounded curvature by Hybrid-A* (Dolgov et al., IJRR 29, 2010): free of
/// contact for the exact footprint, no curvature above 1 / minimum_turning_radius, and from the
/// start's exact pose to the goal's.
class SmacHybridPlanner : public Planner {
 public:
  explicit SmacHybridPlanner(const SmacHybridParams& params);
  ~SmacHybridPlanner() override;

  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override;

 private:
  SmacHybridParams params_;
  std::unique_ptr<PoseRoute> route_;  ///< For the resolution and the radius of the last plan.
  double resolution_ = 0.0, radius_m_ = 0.0;
};

}  // namespace trident::nav
