// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "trident_nav/planning/planner.h"
#include "trident_nav/planning/smac_params.h"

namespace trident::nav {

class PoseRoute;
struct LatticeSet;

/// Parameters of nav2_smac_planner::SmacPlannerLattice.
struct SmacLatticeParams : SmacPoseParams {
  std::string lattice_filepath;
  double rotation_penalty = 5.0;
  bool allow_reverse_expansion = false;

  SmacLatticeParams() { non_straight_penalty = 1.05; }

  template <class Archive>
  void visit(Archive& ar) {
    SmacPoseParams::visit(ar);
    ar.field("lattice_filepath", lattice_filepath,
             "control set in Nav2's JSON form; empty: one that is made for a car of 0.5 m turning "
             "radius");
    ar.field("rotation_penalty", rotation_penalty, Range::non_negative(),
             "cost of a turn on the spot, in cells");
    ar.field("allow_reverse_expansion", allow_reverse_expansion,
             "motions are also driven backwards");
  }
};

/// Paths of a control set's motions, from the start's exact pose to the goal's: the set is turned
/// so that one of its headings is the start's, and the path ends with a shortest curve of the set's
/// turning radius.
class SmacLatticePlanner : public Planner {
 public:
  /// Throws Error when the control set cannot be read.
  explicit SmacLatticePlanner(const SmacLatticeParams& params);
  ~SmacLatticePlanner() override;

  /// Failure::kInvalidInput on a grid of another resolution than the control set's.
  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override;

 private:
  void make_set(double resolution, double min_turning_radius);
  PlanOutcome prepare(const CostGrid& grid, const MotionLimits& limits);

  SmacLatticeParams params_;
  std::unique_ptr<LatticeSet> set_;
  std::unique_ptr<PoseRoute> route_;  ///< Of the set.
};

}  // namespace trident::nav
