// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "../mppi/mppi_model.h"
#include "../mppi/obstacle_survey.h"
#include "trajectory_critic.h"

namespace trident::nav {

/// How long trajectories are, and how finely they are looked at.
struct SearchParams {
  double sim_time_s = 1.7;
  double granularity_m = 0.025;
  double angular_granularity = 0.1;  ///< [rad]
  bool accelerates = false;  ///< Velocities are reached within the trajectory, not at its begin.
};

/// Weights of what a cell is scored by, and what of a search is shown.
struct SearchDisplay {
  bool trajectories = false;  ///< All that were scored, not the chosen one alone.
  bool cells = false;
  double path_weight = 0.0, goal_weight = 0.0, cost_weight = 0.0;  ///< Per cell, and per cost.
};

/// A velocity and what its trajectory scores.
struct RatedTwist {
  Twist2 twist;
  double score = 0.0;
};

/// Scores constant velocities by the trajectories that they lead to.
class TrajectorySearch {
 public:
  TrajectorySearch(const ControlSetup& setup, const SearchParams& params);

  /// Measures the distances that critics look up, once for all searches of a command. The situation
  /// must live until the last of them.
  DwaScene begin(const Situation& situation);
  /// The sample of the least score; nothing if each is in contact or forbidden. `horizon_s`: of the
  /// trajectories, at most their own.
  std::optional<RatedTwist> best(const std::vector<Twist2>& samples, const DwaScene& scene,
                                 const TrajectoryCritics& critics,
                                 double horizon_s = std::numeric_limits<double>::infinity());
  /// Notes the trajectory of what was chosen, at a speed that may be another sample's, and the
  /// cells of the last begin(), as far as somebody watches.
  void describe(const Twist2& chosen, const DwaScene& scene, const SearchDisplay& display);

  /// begin() and best(), and the critics are notified of what was chosen.
  std::optional<Twist2> best(const std::vector<Twist2>& samples, const Situation& situation,
                             const TrajectoryCritics& critics, const SearchDisplay& display);

  double dt_s() const { return model_.dt_s; }
  /// How far from the robot trajectories get, with `margin_m` ahead of the base [m].
  double reach_m(double margin_m) const;

 private:
  void roll(const std::vector<Twist2>& samples, std::size_t first, const Situation& situation,
            const ObstacleSurvey& survey);
  /// The step at which a candidate has driven as far as the goal is; the last of `steps` if
  /// it does not.
  int last_step(const Twist2& twist, double goal_distance_m, int steps) const;
  void note(const Situation& situation, const Candidate& candidate, double cost) const;
  void describe_cells(const Situation& situation, const SearchDisplay& display) const;
  std::optional<double> score(const DwaScene& scene, const Candidate& candidate,
                              const TrajectoryCritics& critics, double best) const;

  MppiModel model_;
  Rollouts rollouts_;
  GridWithDistances distances_;
  MapGrid path_grid_, goal_grid_;
};

}  // namespace trident::nav
