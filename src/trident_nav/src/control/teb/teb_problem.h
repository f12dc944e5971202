// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "footprint_distance.h"
#include "normal_equations.h"
#include "teb_band.h"
#include "teb_obstacles.h"
#include "teb_params.h"
#include "teb_terms.h"
#include "trident_nav/control/control_law.h"

namespace trident::nav {

/// What a band must keep, of robot and parameters.
struct TebModel {
  TebParams params;
  MotionLimits limits;
  TebSpacing spacing;
  TebPace pace;
  // Of obstacles, and of moving ones [m].
  double near_m = 0.0, inflation_m = 0.0, moving_inflation_m = 0.0;
  bool is_holonomic = false;
  bool can_turn_on_spot = false;

  TebModel(const TebParams& params, const ControlSetup& setup);
};

/// What a band is between, and what draws it.
struct TebTask {
  Twist2 start_twist;
  bool stops_at_end = true;
  bool is_reverse = false;  ///< To drive backwards is what the path wants.
  std::vector<Point2> via_points;
};

/// The cost of a band by what causes it, and its duration.
struct TebCost {
  double time = 0.0, obstacles = 0.0, via_points = 0.0, motion = 0.0;
  double sum() const { return time + obstacles + via_points + motion; }
};

/// On which side of its interval each bounded quantity of a problem is, in a fixed order.
using TebActiveSet = std::vector<TebSide>;

/// The least-squares problem whose solution is a good band: Rösmann et al. 2012, equation (4), with
/// the kinematics of Rösmann, Hoffmann, Bertram, "Kinodynamic trajectory optimization and control
/// for car-like robots", IROS 2017. All that is given must outlive it.
class TebProblem {
 public:
  TebProblem(const TebModel& model, const FootprintDistance& footprint,
             const TebObstacles& obstacles, const Tracks& tracks, const TebTask& task)
      : model_(model), footprint_(footprint), obstacles_(obstacles), tracks_(tracks), task_(task) {}

  /// Chooses the obstacles and the points of the path that each pose of a band is weighed with.
  void associate(const TebBand& band);

  /// The normal equations about a band that has as many poses as the one last associated.
  /// `obstacle_factor`: on the weight of obstacles.
  /// `expected`: what bounds will hold after the step that is to be found; those of them that do
  /// not hold the band now draw the step to themselves. Empty: those that hold it now.
  TebCost linearize(const TebBand& band, double obstacle_factor, const TebActiveSet& expected,
                    NormalEquations* equations);
  /// The bounds that held the band last linearized.
  const TebActiveSet& active() const { return active_; }

 private:
  template <std::size_t kNodes>
  void bound(std::size_t node, const TebQuantity<kNodes>& quantity, double lo, double hi,
             double weight);
  template <std::size_t kNodes>
  void limit(std::size_t node, const TebQuantity<kNodes>& quantity, double lo, double hi,
             double weight);
  void add_segments(const TebBand& band);
  void add_speeds(std::size_t node, const SegmentMotion& motion, double dt_s);
  void add_shape(std::size_t node, const SegmentMotion& motion);
  void add_accelerations(const TebBand& band);
  void add_ends(const TebBand& band);
  void add_obstacles(const TebBand& band, double factor);
  void add_tracks(const TebBand& band, double factor);
  void add_via_points(const TebBand& band);
  double speed_limit(std::size_t node) const;

  const TebModel& model_;
  const FootprintDistance& footprint_;
  const TebObstacles& obstacles_;
  const Tracks& tracks_;
  const TebTask& task_;
  std::vector<TebNeighbors> neighbors_;
  std::vector<std::size_t> via_nodes_;  ///< The pose that each via point draws.
  // Of the last linearization.
  std::vector<SegmentMotion> motions_;
  TebActiveSet active_, expected_;
  NormalEquations* equations_ = nullptr;
};

/// Improves a band by Gauss-Newton steps that Levenberg's and Marquardt's damping keeps from making
/// it worse. The ends stay. Returns the cost with the weights as they are given.
TebCost optimize_band(TebProblem& problem, const TebModel& model, TebBand* band);

}  // namespace trident::nav
