// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// A global planner. Made once from its parameters; its owner calls `plan` from one thread at a
/// time, at whatever rate. Between calls a planner may keep what helps with the next one (a
/// potential, a heuristic), but equal inputs after equal histories give equal bits.
class Planner {
 public:
  Planner() = default;
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;
  virtual ~Planner() = default;

  /// A path from `start` to `goal`, poses in the frame of the grid: the first is `start`, the last
  /// is `goal`, or, where the planner has a tolerance and `reason` says so, the nearest pose that
  /// can be reached. Without a path `failure` and `reason` say why. Does not throw for bad poses.
  /// Returns Failure::kCanceled soon after `cancel` has been set.
  virtual PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                           const Pose2& goal, const MotionLimits& limits,
                           const CancelFlag& cancel) = 0;
};

/// How a planner's parameters want its potential to be shown.
struct PotentialDisplay {
  bool is_wanted = false;
  int greatest = 100;  ///< What the greatest potential becomes in an occupancy grid, 1 to 100.
};

/// A planner whose potential can be shown.
class PotentialSource {
 public:
  virtual ~PotentialSource() = default;
  virtual PotentialDisplay display() const = 0;
  /// The potential of all cells of the grid of the last plan in rows, in step costs; infinite where
  /// it is not known. Empty before the first plan.
  virtual std::vector<float> potential() const = 0;
};

}  // namespace trident::nav
