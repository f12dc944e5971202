// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mppi_model.h"
#include "rollout.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/footprint_checker.h"

namespace trident::nav {

/// How trajectories are compared with the grid.
struct SurveyOptions {
  bool considers_footprint = true;  ///< Else the inscribed circle.
  int step_stride = 2;              ///< Each so many-th step, and the last one.
};

/// Finds how near trajectories come to obstacles, and when they are first in contact. The cover's
/// circles decide by the distance field; where those are not clear, the exact footprint does.
class ObstacleSurvey {
 public:
  /// All must outlive the survey; `origin` is where the rollouts begin. `distance_m`: of the grid's
  /// cells, in the same order.
  ObstacleSurvey(const MppiModel& model, const FootprintChecker& checker, const CostGrid& grid,
                 const Pose2& origin, SurveyOptions options);

  /// Fills `clearance` (between surveyed steps it is that of the next one) and `contact_step`.
  void survey(Rollouts* rollouts) const;

 private:
  void clear_by_cover(const Rollouts& rollouts, int step, float* clearance) const;
  void check_exactly(int step, const float* clearance, Rollouts* rollouts) const;
  bool is_free(const Rollouts& rollouts, int step, int lane) const;

  const MppiModel& model_;
  const FootprintChecker& checker_;
  const CostGrid& grid_;
  Pose2 origin_;
  SurveyOptions options_;
  std::vector<CoverCircle> cover_;
};

/// A costmap's grid that has distances: its own ones, or else those that are computed here and kept
/// until the grid changes.
class GridWithDistances {
 public:
  CostGrid of(const CostGrid& grid);

 private:
  static constexpr double kMaxDistance_m = 2.0;

  void measure(const CostGrid& grid);

  CostGrid source_;
  std::vector<float> distance_m_;
};

}  // namespace trident::nav
