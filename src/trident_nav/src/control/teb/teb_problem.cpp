// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "teb_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../limit_params.h"

namespace trident::nav {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MotionLimits merged(const TebParams& params, MotionLimits limits) {
  cap_limit(params.max_vel_x, &limits.vx_max);
  cap_limit(params.max_vel_y, &limits.vy_max);
  cap_limit(params.max_vel_theta, &limits.wz_max);
  cap_limit(params.acc_lim_x, &limits.ax_max);
  cap_limit(params.acc_lim_x, &limits.decel_max);
  cap_limit(params.acc_lim_y, &limits.ay_max);
  cap_limit(params.acc_lim_theta, &limits.alpha_max);
  limits.vx_min = -params.max_vel_x_backwards.value_or(-limits.vx_min);
  limits.min_turning_radius =
      std::max(limits.min_turning_radius, params.min_turning_radius.value_or(0.0));
  return limits;
}

// What lacks of a distance grows with a power of its share of a scale.
template <std::size_t kNodes>
TebQuantity<kNodes> bent(TebQuantity<kNodes> lacking, double scale, double exponent) {
  if (exponent == 1.0 || lacking.value <= 0.0 || scale <= 0.0) return lacking;
  const double share = lacking.value / scale;
  const double slope = exponent * std::pow(share, exponent - 1.0);
  lacking.value = scale * std::pow(share, exponent);
  for (double& s : lacking.slopes) s *= slope;
  return lacking;
}

}  // namespace

TebModel::TebModel(const TebParams& given, const ControlSetup& setup)
    : params(given), limits(merged(given, setup.limits)) {
  constexpr double kOverlap = 1.5;  // of inscribed circles of poses in a row: below 2
  constexpr double kTurn = 0.8;     // between poses, at most [rad]
  spacing.dt_ref_s = params.dt_ref;
  spacing.dt_hysteresis_s = std::min(params.dt_hysteresis, 0.9 * params.dt_ref);
  spacing.max_step_m = kOverlap * setup.footprint.inscribed_radius;
  spacing.max_turn = kTurn;
  spacing.min_nodes = static_cast<std::size_t>(params.min_samples);
  spacing.max_nodes = static_cast<std::size_t>(std::max(params.max_samples, params.min_samples));
  constexpr double kUpstreamDistance = 0.5, kInflation = 0.1;  // [m]
  near_m = params.min_obstacle_dist.value_or(
      std::min(setup.footprint.inscribed_radius, kUpstreamDistance));
  inflation_m = params.inflation_dist.value_or(near_m + kInflation);
  moving_inflation_m = params.dynamic_obstacle_inflation_dist.value_or(near_m + kInflation);
  pace = {limits.vx_max, limits.wz_max};
  is_holonomic = limits.vy_max > 0.0;
  can_turn_on_spot = limits.min_turning_radius <= 0.0;
}

void TebProblem::associate(const TebBand& band) {
  const TebParams& p = model_.params;
  // A little more than counts now: poses move until the next choice.
  const double cutoff_m = 0.1 + std::max(model_.near_m + p.penalty_epsilon, model_.inflation_m);
  neighbors_ = find_neighbors(band, footprint_, obstacles_, cutoff_m);
  via_nodes_.clear();
  std::size_t from = 1;
  for (const Point2& via : task_.via_points) {
    std::size_t best = from;
    double best_m = kInfinity;
    for (std::size_t i = from; i + 1 < band.size(); ++i) {
      const double d = distance(band[i].pose.x, band[i].pose.y, via.x, via.y);
      if (d < best_m) best = i;
      best_m = std::min(best_m, d);
    }
    via_nodes_.push_back(best);
    if (p.via_points_ordered) from = std::min(best + 1, band.size() - 1);
  }
}

/// A quantity that shall stay in an interval costs what it exceeds that by. The bounds that hold
/// after a step are not known before it; those that are expected to are taken as if they did, which
/// is what an active-set method for quadratic programs does.
template <std::size_t kNodes>
void TebProblem::bound(std::size_t node, const TebQuantity<kNodes>& quantity, double lo, double hi,
                       double weight) {
  const TebSide side = side_of(quantity, lo, hi);
  const TebSide wanted = active_.size() < expected_.size() ? expected_[active_.size()] : side;
  active_.push_back(side);
  if (side != TebSide::kWithin) {
    const TebQuantity<kNodes> over = bent(excess(quantity, side, lo, hi), std::fabs(lo),
                                          kNodes == 1 ? model_.params.obstacle_cost_exponent : 1.0);
    equations_->add(node, over, weight);
  } else if (wanted != TebSide::kWithin) {
    equations_->attract(node, excess(quantity, wanted, lo, hi), weight);
  }
}

/// A speed or an acceleration: the margin must leave something of low limits.
template <std::size_t kNodes>
void TebProblem::limit(std::size_t node, const TebQuantity<kNodes>& quantity, double lo, double hi,
                       double weight) {
  constexpr double kMaxShare = 0.1;
  const double epsilon = model_.params.penalty_epsilon;
  bound(node, quantity, lo + std::min(epsilon, kMaxShare * std::fabs(lo)),
        hi - std::min(epsilon, kMaxShare * std::fabs(hi)), weight);
}

double TebProblem::speed_limit(std::size_t node) const {
  const TebParams& p = model_.params;
  const double lower = p.obstacle_proximity_lower_bound;
  const double upper = p.obstacle_proximity_upper_bound;
  if (p.weights.velocity_obstacle_ratio <= 0.0 || upper <= lower) return model_.limits.vx_max;
  const double share =
      std::clamp((neighbors_[node].clearance_m - lower) / (upper - lower), 0.0, 1.0);
  const double least = p.obstacle_proximity_ratio_max_vel;
  return model_.limits.vx_max * (least + (1.0 - least) * share);
}

void TebProblem::add_speeds(std::size_t node, const SegmentMotion& motion, double dt_s) {
  const TebWeights& weights = model_.params.weights;
  const MotionLimits& limits = model_.limits;
  const TebQuantity<2> vx = rate(motion.along, dt_s);
  limit(node, vx, limits.vx_min, limits.vx_max, weights.max_vel_x);
  limit(node, rate(motion.turn, dt_s), -limits.wz_max, limits.wz_max, weights.max_vel_theta);
  if (weights.velocity_obstacle_ratio > 0.0) {
    const double near_limit = speed_limit(node);
    bound(node, vx, -near_limit, near_limit, weights.velocity_obstacle_ratio);
  }
  if (!model_.is_holonomic) return;
  limit(node, rate(motion.across, dt_s), -limits.vy_max, limits.vy_max, weights.max_vel_y);
  const double v_max = model_.params.max_vel_trans.value_or(0.0);
  if (v_max > 0.0) {
    bound(node, rate(length(motion), dt_s), -kInfinity, v_max, weights.max_vel_x);
  }
}

void TebProblem::add_shape(std::size_t node, const SegmentMotion& motion) {
  const TebWeights& weights = model_.params.weights;
  if (!model_.is_holonomic) {
    // Upstream's measure of sideways motion is twice this.
    equations_->add(node, motion.across, 4.0 * weights.kinematics_nh);
    if (!task_.is_reverse) {
      bound(node, motion.along, 0.0, kInfinity, weights.kinematics_forward_drive);
    }
  }
  if (!model_.can_turn_on_spot) {
    const double weight = weights.kinematics_nh * weights.kinematics_turning_radius;
    bound(node, turning_excess(motion, model_.limits.min_turning_radius), -kInfinity, 0.0, weight);
  }
  if (weights.shortest_path > 0.0) {
    equations_->add(node, length(motion), weights.shortest_path);
  }
}

void TebProblem::add_segments(const TebBand& band) {
  motions_.clear();
  const ArcLength kind = model_.params.exact_arc_length ? ArcLength::kExact : ArcLength::kChord;
  for (std::size_t i = 0; i + 1 < band.size(); ++i) {
    motions_.push_back(segment_motion(band[i], band[i + 1], kind));
    add_speeds(i, motions_.back(), band[i].dt_s);
    add_shape(i, motions_.back());
  }
}

void TebProblem::add_accelerations(const TebBand& band) {
  const TebWeights& weights = model_.params.weights;
  const MotionLimits& limits = model_.limits;
  const double decel = std::min(limits.ax_max, limits.decel_max);
  for (std::size_t i = 0; i + 1 < motions_.size(); ++i) {
    const double dt0 = band[i].dt_s;
    const double dt1 = band[i + 1].dt_s;
    const auto add = [&](const TebQuantity<2>& a, const TebQuantity<2>& b, double most,
                         double weight) {
      limit(i, acceleration(rate(a, dt0), rate(b, dt1), dt0, dt1), -most, most, weight);
    };
    const SegmentMotion& from = motions_[i];
    const SegmentMotion& to = motions_[i + 1];
    add(from.along, to.along, decel, weights.acc_lim_x);
    add(from.turn, to.turn, limits.alpha_max, weights.acc_lim_theta);
    if (model_.is_holonomic) add(from.across, to.across, limits.ay_max, weights.acc_lim_y);
  }
}

void TebProblem::add_ends(const TebBand& band) {
  const TebWeights& weights = model_.params.weights;
  const MotionLimits& limits = model_.limits;
  const auto add = [&](std::size_t i, const TebQuantity<2>& path, double known, double sign,
                       double most, double weight) {
    const double dt = band[i].dt_s;
    limit(i, end_acceleration(rate(path, dt), known, dt, sign), -most, most, weight);
  };
  const SegmentMotion& first = motions_.front();
  const Twist2& from = task_.start_twist;
  add(0, first.along, from.vx, 1.0, std::max(limits.ax_max, limits.decel_max), weights.acc_lim_x);
  add(0, first.turn, from.wz, 1.0, limits.alpha_max, weights.acc_lim_theta);
  if (model_.is_holonomic) add(0, first.across, from.vy, 1.0, limits.ay_max, weights.acc_lim_y);
  if (!task_.stops_at_end) return;
  const std::size_t last = motions_.size() - 1;
  add(last, motions_[last].along, 0.0, -1.0, limits.decel_max, weights.acc_lim_x);
  add(last, motions_[last].turn, 0.0, -1.0, limits.alpha_max, weights.acc_lim_theta);
  if (model_.is_holonomic) {
    add(last, motions_[last].across, 0.0, -1.0, limits.ay_max, weights.acc_lim_y);
  }
}

void TebProblem::add_obstacles(const TebBand& band, double factor) {
  const TebParams& p = model_.params;
  const double near_m = model_.near_m + p.penalty_epsilon;
  for (std::size_t i = 1; i + 1 < band.size(); ++i) {
    const Pose2& pose = band[i].pose;
    const double c = std::cos(pose.yaw);
    const double s = std::sin(pose.yaw);
    // Two planes, one of each corner, stand for one obstacle.
    for (std::size_t k = 0; k < neighbors_[i].count; ++k) {
      const TebQuantity<1> d = clearance(pose, c, s, neighbors_[i].planes[k]);
      bound(i, d, near_m, kInfinity, 0.5 * factor * p.weights.obstacle);
      bound(i, d, model_.inflation_m, kInfinity, 0.5 * p.weights.inflation);
    }
  }
}

// A moving obstacle is where it will be at the time of a pose. That the time depends on all earlier
// durations is left out of the slopes, which would otherwise tie all of a band together.
void TebProblem::add_tracks(const TebBand& band, double factor) {
  const TebParams& p = model_.params;
  if (!p.include_dynamic_obstacles) return;
  const double near_m = model_.near_m + p.penalty_epsilon;
  double after_s = band[0].dt_s;
  for (std::size_t i = 1; i + 1 < band.size(); after_s += band[i].dt_s, ++i) {
    const Pose2& pose = band[i].pose;
    const double c = std::cos(pose.yaw);
    const double s = std::sin(pose.yaw);
    for (const Track& track : tracks_) {
      const TebQuantity<1> d =
          clearance(footprint_, pose, c, s, track.position_at(after_s), track.radius_m);
      bound(i, d, near_m, kInfinity, factor * p.weights.dynamic_obstacle);
      bound(i, d, model_.moving_inflation_m, kInfinity, p.weights.dynamic_obstacle_inflation);
    }
  }
}

void TebProblem::add_via_points(const TebBand& band) {
  for (std::size_t k = 0; k < via_nodes_.size(); ++k) {
    const std::size_t node = via_nodes_[k];
    if (node == 0 || node + 1 >= band.size()) continue;
    equations_->add(node, separation(band[node].pose, task_.via_points[k]),
                    model_.params.weights.viapoint);
  }
}

TebCost TebProblem::linearize(const TebBand& band, double obstacle_factor,
                              const TebActiveSet& expected, NormalEquations* equations) {
  equations_ = equations;
  expected_ = expected;
  active_.clear();
  equations->reset(band.size());
  TebCost cost;
  TebQuantity<1> duration;
  duration.slopes[3] = 1.0;
  for (std::size_t i = 0; i + 1 < band.size(); ++i) {
    duration.value = band[i].dt_s;
    equations->add(i, duration, model_.params.weights.optimaltime);
  }
  cost.time = equations->cost();
  add_segments(band);
  add_accelerations(band);
  add_ends(band);
  cost.motion = equations->cost() - cost.time;
  add_obstacles(band, obstacle_factor);
  add_tracks(band, obstacle_factor);
  cost.obstacles = equations->cost() - cost.time - cost.motion;
  add_via_points(band);
  cost.via_points = equations->cost() - cost.time - cost.motion - cost.obstacles;
  return cost;
}

}  // namespace trident::nav
