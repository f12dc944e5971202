// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "../mppi/rollout.h"
#include "map_grid.h"
#include "trident_nav/control/control_law.h"

namespace trident::nav {

/// How the scores of a trajectory's poses become one.
enum class Aggregation { kLast, kSum, kProduct };

/// One trajectory that could be driven.
struct Candidate {
  Twist2 twist;
  const Rollouts* rollouts = nullptr;
  int lane = 0;
  int last = 0;  ///< Its last step.

  Pose2 pose(const Pose2& origin, int step) const;
};

/// What critics compare candidates with.
struct DwaScene {
  const Situation& situation;
  double resolution = 0.0;
  const MapGrid& path_grid;  ///< Distances from the path ahead.
  const MapGrid& goal_grid;  ///< Distances from the end of the path ahead, where it is in reach.
  double goal_distance_m = 0.0;
};

/// Scores candidates one by one; a negative score forbids one.
class TrajectoryCritic {
 public:
  explicit TrajectoryCritic(double scale) : scale_(scale) {}
  TrajectoryCritic(const TrajectoryCritic&) = delete;
  TrajectoryCritic& operator=(const TrajectoryCritic&) = delete;
  virtual ~TrajectoryCritic() = default;

  virtual double score(const DwaScene& scene, const Candidate& candidate) const = 0;
  /// Called before the candidates of a command are scored.
  virtual void prepare(const DwaScene& /*scene*/) {}
  /// Called with what was chosen.
  virtual void on_chosen(const DwaScene& /*scene*/, const Twist2& /*twist*/) {}
  virtual void reset() {}

  double scale() const { return scale_; }

 private:
  double scale_;
};

using TrajectoryCritics = std::vector<std::unique_ptr<TrajectoryCritic>>;

/// Which of the two grids a critic reads.
enum class GridKind { kPath, kGoal };

/// In what distances of the grids are scored.
enum class GridUnit { kCells, kMeters };

/// The distance of a point ahead of the base (0: the base itself) in one of the grids. Silent where
/// the goal is nearer than `silent_within_m`.
std::unique_ptr<TrajectoryCritic> make_grid_critic(GridKind kind, double scale,
                                                   double forward_point_m, double silent_within_m,
                                                   Aggregation aggregation,
                                                   GridUnit unit = GridUnit::kCells);
/// The greatest cost at the base's center along the trajectory; contacts are forbidden before
/// critics are asked.
std::unique_ptr<TrajectoryCritic> make_obstacle_critic(double scale, Aggregation aggregation);
/// The same for the greatest cost under the footprint.
std::unique_ptr<TrajectoryCritic> make_footprint_critic(double scale, Aggregation aggregation);
/// The turn rate.
/// By how much the trajectory's end is closer to obstacles than the robot can turn [m], squared and
/// divided by the most that it may be.
std::unique_ptr<TrajectoryCritic> make_turning_room_critic(double scale);
std::unique_ptr<TrajectoryCritic> make_twirling_critic(double scale);
/// Driving backwards, sideways or nearly on the spot.
struct PreferForwardWeights {
  double penalty = 1.0, strafe_x = 0.1, strafe_theta = 0.2, theta_scale = 10.0;
};
std::unique_ptr<TrajectoryCritic> make_prefer_forward_critic(double scale,
                                                             const PreferForwardWeights& weights);
/// Forbids a change of sign of a velocity until the robot has moved.
struct OscillationLimits {
  double reset_distance_m = 0.05, reset_angle = 0.2, reset_time_s = -1.0;
  double x_only_threshold = 1e-6;  ///< A faster robot may turn as it likes [m/s].
};
std::unique_ptr<TrajectoryCritic> make_oscillation_critic(double scale,
                                                          const OscillationLimits& limits);
/// Moving obstacles where they will be.
std::unique_ptr<TrajectoryCritic> make_moving_obstacle_critic(double scale, double dt_s);
/// The error of heading from the direction of the path that is nearest, after so many steps (or at
/// the end, if that comes earlier) [rad].
std::unique_ptr<TrajectoryCritic> make_heading_critic(double scale, int step);
/// The squared straight distance from the end to the path's end [m^2].
std::unique_ptr<TrajectoryCritic> make_attractor_critic(double scale);

}  // namespace trident::nav
