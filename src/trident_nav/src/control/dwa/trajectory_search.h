// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// Scores constant velocities by the trajectories that they lead to.
class TrajectorySearch {
 public:
  TrajectorySearch(const ControlSetup& setup, const SearchParams& params);

  /// The sample of the least score; nothing if each is in contact or forbidden.
  std::optional<Twist2> best(const std::vector<Twist2>& samples, const Situation& situation,
                             const TrajectoryCritics& critics);
  double dt_s() const { return model_.dt_s; }
  /// How far from the robot trajectories get, with `margin_m` ahead of the base [m].
  double reach_m(double margin_m) const;

 private:
  DwaScene make_scene(const Situation& situation) const;
  void roll(const std::vector<Twist2>& samples, std::size_t first, const Situation& situation,
            const ObstacleSurvey& survey);
  /// The step at which a candidate has driven as far as the goal is; its last one if it does not.
  int last_step(const Twist2& twist, double goal_distance_m) const;
  std::optional<double> score(const DwaScene& scene, const Candidate& candidate,
                              const TrajectoryCritics& critics, double best) const;

  MppiModel model_;
  Rollouts rollouts_;
  GridWithDistances distances_;
};

}  // namespace trident::nav
