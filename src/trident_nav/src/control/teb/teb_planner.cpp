// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "teb_planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trident::nav {
namespace {

std::vector<Point2> points_of(const TebBand& band) {
  std::vector<Point2> points;
  points.reserve(band.size());
  for (const TebNode& node : band) points.push_back({node.pose.x, node.pose.y});
  return points;
}

// Poses on the arc from one pose of a band to the next, close enough that nothing is missed.
bool is_segment_free(const Situation& situation, const Pose2& from, const Pose2& to,
                     double max_turn) {
  const double turn = wrap_angle(to.yaw - from.yaw);
  const double reach = situation.checker.footprint().circumscribed_radius;
  const double moved_m = distance(from.x, from.y, to.x, to.y) + reach * std::fabs(turn);
  const int steps = 1 + static_cast<int>(std::max(moved_m / situation.grid.geometry.resolution,
                                                  std::fabs(turn) / max_turn));
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const Pose2 pose{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                     wrap_angle(from.yaw + t * turn)};
    if (!situation.checker.is_free(situation.grid, pose)) return false;
  }
  return true;
}

// How many of a band's segments, from its beginning on, must be free.
std::size_t segments_to_check(const TebParams& params, const TebBand& band) {
  std::size_t count = band.size() - 1;
  if (params.feasibility_check_no_poses >= 0) {
    count = std::min(count, static_cast<std::size_t>(params.feasibility_check_no_poses));
  }
  const double limit_m = params.feasibility_check_lookahead_distance;
  if (limit_m < 0.0) return count;
  const Pose2& start = band.front().pose;
  for (std::size_t i = 1; i < count; ++i) {
    const Pose2& next = band[i + 1].pose;
    if (distance(start.x, start.y, next.x, next.y) > limit_m) return i;
  }
  return count;
}

// Whether a band leaves its beginning and comes back to it.
bool comes_back(const TebBand& band, double near_m) {
  const Pose2& start = band.front().pose;
  bool has_left = false;
  for (const TebNode& node : band) {
    const double d = distance(start.x, start.y, node.pose.x, node.pose.y);
    if (has_left && d < near_m) return true;
    has_left = has_left || d > 1.5 * near_m;
  }
  return false;
}

// A band as a trajectory: each pose with the velocity to the next one.
ConsideredTrajectory trajectory_of(const TebBand& band) {
  ConsideredTrajectory trajectory;
  double time_s = 0.0;
  for (std::size_t i = 0; i < band.size(); ++i) {
    TrajectoryPoint point{time_s, band[i].pose, {}};
    if (i + 1 < band.size()) {
      const SegmentMotion motion = segment_motion(band[i], band[i + 1], ArcLength::kExact);
      const double dt_s = band[i].dt_s;
      point.twist = {motion.along.value / dt_s, motion.across.value / dt_s,
                     motion.turn.value / dt_s};
    }
    trajectory.points.push_back(point);
    time_s += band[i].dt_s;
  }
  return trajectory;
}

}  // namespace

bool is_band_free(const TebModel& model, const Situation& situation, const TebBand& band) {
  const double max_turn = model.params.min_resolution_collision_check_angular;
  const std::size_t count = segments_to_check(model.params, band);
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_segment_free(situation, band[i].pose, band[i + 1].pose, max_turn)) return false;
  }
  return true;
}

void TebPlanner::reset() {
  candidates_.clear();
  switched_s_ = 0.0;
}

TebRegion TebPlanner::area_about(const TebGuide& guide) const {
  const TebParams& p = model_.params;
  const Point2 middle{0.5 * (guide.start.x + guide.goal.x), 0.5 * (guide.start.y + guide.goal.y)};
  const double apart_m = distance(guide.start.x, guide.start.y, guide.goal.x, guide.goal.y);
  const double half_m =
      0.5 * std::max(p.roadmap_graph_area_width, p.roadmap_graph_area_length_scale * apart_m);
  TebRegion area{middle, middle};
  area.include(middle, half_m);
  for (const Point2& point : guide.points) area.include(point, 0.0);
  return area;
}

TebObstacles TebPlanner::obstacles_about(const Situation& situation, const TebGuide& guide) const {
  const TebParams& p = model_.params;
  if (!p.include_costmap_obstacles) return {};
  const double margin_m = situation.checker.footprint().circumscribed_radius +
                          std::max(model_.near_m, model_.inflation_m) + 0.1;
  TebRegion region{guide.points.front(), guide.points.front()};
  for (const Point2& point : guide.points) region.include(point, margin_m);
  for (const Candidate& candidate : candidates_) {
    for (const TebNode& node : candidate.band) {
      region.include({node.pose.x, node.pose.y}, margin_m);
    }
  }
  TebObstacles obstacles = collect_obstacles(situation.grid, region, unknown_);
  const Pose2& pose = situation.state.pose;
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const auto is_far_behind = [&](const Point2& center) {
    const double ahead_m = c * (center.x - pose.x) + s * (center.y - pose.y);
    return ahead_m < 0.0 && distance(center.x, center.y, pose.x, pose.y) >
                                p.costmap_obstacles_behind_robot_dist + margin_m;
  };
  auto& centers = obstacles.centers;
  centers.erase(std::remove_if(centers.begin(), centers.end(), is_far_behind), centers.end());
  return obstacles;
}

void TebPlanner::keep_bands(const TebGuide& guide) {
  const TebParams& p = model_.params;
  const bool is_other_goal =
      distance(goal_.x, goal_.y, guide.goal.x, guide.goal.y) > p.force_reinit_new_goal_dist ||
      std::fabs(wrap_angle(goal_.yaw - guide.goal.yaw)) > p.force_reinit_new_goal_angular;
  if (is_other_goal) candidates_.clear();
  goal_ = guide.goal;
  // A robot that must change gear to turn may need all of its poses.
  const double reach_m = model_.can_turn_on_spot ? 0.7 * model_.spacing.max_step_m : 0.0;
  for (Candidate& candidate : candidates_) {
    move_ends(guide.start, guide.goal, reach_m, &candidate.band);
    slow_down(model_.pace, &candidate.band);
    candidate.is_initial = false;
  }
}

bool TebPlanner::is_known(HSignature signature) const {
  return std::any_of(candidates_.begin(), candidates_.end(),
                     [&](const Candidate& c) { return c.signature == signature; });
}

void TebPlanner::add_band(const TebGuide& guide, const std::vector<Point2>& points,
                          HSignature signature) {
  if (is_known(signature)) return;
  Candidate candidate;
  candidate.band = guess_band(model_, guide, points);
  candidate.signature = signature;
  candidates_.push_back(std::move(candidate));
}

/// A band that has passed obstacles as the path does and yet loops began with a detour that its
/// start has grown around; an optimization does not leave it. Robots that must change gear to turn
/// need loops.
void TebPlanner::untangle(const TebGuide& guide, TebBand* band) const {
  if (!model_.can_turn_on_spot || !comes_back(*band, model_.spacing.max_step_m)) return;
  *band = guess_band(model_, guide, guide.points);
}

void TebPlanner::explore(const TebGuide& guide, const HomotopyMap& map, HSignature initial) {
  add_band(guide, guide.points, initial);
  for (Candidate& candidate : candidates_) {
    candidate.is_initial = candidate.signature == initial;
    if (candidate.is_initial) untangle(guide, &candidate.band);
  }
  if (model_.params.enable_homotopy_class_planning) add_other_classes(guide, map);
}

/// Bands that pass obstacles otherwise than those that are known.
void TebPlanner::add_other_classes(const TebGuide& guide, const HomotopyMap& map) {
  const TebParams& p = model_.params;
  const auto most = static_cast<std::size_t>(p.max_number_classes);
  if (map.obstacles() == 0 || candidates_.size() >= most) return;
  const std::vector<HomotopyPath> paths = map.paths(guide.points.front(), guide.points.back(), most,
                                                    p.max_ratio_detours_duration_best_duration);
  for (const HomotopyPath& path : paths) {
    if (candidates_.size() < most) add_band(guide, path.points, path.signature);
  }
}

void TebPlanner::optimize(const Situation& situation, const TebGuide& guide,
                          const FootprintDistance& shape, const TebObstacles& obstacles) {
  TebTask undrawn = guide.task;
  undrawn.via_points.clear();
  for (Candidate& candidate : candidates_) {
    const bool is_drawn = model_.params.viapoints_all_candidates || candidate.is_initial;
    TebProblem problem(model_, shape, obstacles, situation.tracks, is_drawn ? guide.task : undrawn);
    candidate.cost = optimize_band(problem, model_, &candidate.band);
    candidate.is_free = is_band_free(model_, situation, candidate.band);
  }
}

/// Bands that have come to the same side of everything are one: the present one stays, or the
/// cheapest.
void TebPlanner::drop_doubles(const HomotopyMap& map) {
  std::vector<Candidate> kept;
  for (Candidate& candidate : candidates_) {
    candidate.signature = map.signature(points_of(candidate.band));
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Candidate& other) {
      return other.signature == candidate.signature;
    });
    if (same == kept.end()) {
      kept.push_back(std::move(candidate));
    } else if (candidate.is_present ||
               (!same->is_present && candidate.cost.sum() < same->cost.sum())) {
      *same = std::move(candidate);
    }
  }
  candidates_ = std::move(kept);
}

double TebPlanner::weighed_cost(const Candidate& candidate, double now_s) const {
  const TebParams& p = model_.params;
  const TebCost& cost = candidate.cost;
  const double time = p.selection_alternative_time_cost ? duration_s(candidate.band) : cost.time;
  double sum = time + cost.motion + p.selection_obst_cost_scale * cost.obstacles +
               p.selection_viapoint_cost_scale * cost.via_points;
  if (candidate.is_initial) sum *= p.selection_prefer_initial_plan;
  if (candidate.is_present) sum *= p.selection_cost_hysteresis;
  // Within the period another band is chosen only where the present one is not free.
  const bool is_held = now_s - switched_s_ < p.switching_blocking_period;
  return is_held && candidate.is_present ? 0.0 : sum;
}

TebPlanner::Candidate* TebPlanner::cheapest_free(double now_s) {
  Candidate* found = nullptr;
  for (Candidate& candidate : candidates_) {
    if (!candidate.is_free) continue;
    if (found == nullptr || weighed_cost(candidate, now_s) < weighed_cost(*found, now_s)) {
      found = &candidate;
    }
  }
  return found;
}

TebPlanner::Candidate* TebPlanner::best(double now_s) {
  Candidate* const found = cheapest_free(now_s);
  if (found != nullptr && !found->is_present) switched_s_ = now_s;
  for (Candidate& candidate : candidates_) candidate.is_present = &candidate == found;
  return found;
}

/// Leaves out what is not free, what takes far longer than the present band, and what begins in
/// quite another direction.
void TebPlanner::drop_detours() {
  const TebParams& p = model_.params;
  const auto present = std::find_if(candidates_.begin(), candidates_.end(),
                                    [](const Candidate& c) { return c.is_present; });
  if (present == candidates_.end()) return;
  const double longest_s = p.max_ratio_detours_duration_best_duration * duration_s(present->band);
  const double length_m = p.length_start_orientation_vector;
  const double direction = first_direction(points_of(present->band), length_m);
  const auto is_bad = [&](const Candidate& c) {
    if (c.is_present) return false;
    if (!c.is_free || duration_s(c.band) > longest_s) return true;
    const double turn = wrap_angle(first_direction(points_of(c.band), length_m) - direction);
    return p.delete_detours_backwards && std::fabs(turn) > p.detours_orientation_tolerance;
  };
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), is_bad),
                    candidates_.end());
}

void TebPlanner::describe(ControlDetails* details) const {
  details->obstacles = around_.obstacles;
  details->via_points = around_.via_points;
  for (const Candidate& candidate : candidates_) {
    if (candidate.is_present) details->selected = details->trajectories.size();
    details->trajectories.push_back(trajectory_of(candidate.band));
    details->trajectories.back().cost = candidate.is_free ? candidate.cost.sum() : -1.0;
  }
}

void TebPlanner::sign_bands(const HomotopyMap& map) {
  for (Candidate& candidate : candidates_) {
    candidate.signature = map.signature(points_of(candidate.band));
  }
}

const TebBand* TebPlanner::plan(const Situation& situation, const CostGrid& grid) {
  const TebGuide guide = make_guide(model_, situation);
  const double now_s = situation.state.time_s;
  keep_bands(guide);
  const Footprint& footprint = situation.checker.footprint();
  const HomotopyMap map(grid, area_about(guide), footprint.inscribed_radius, unknown_);
  const FootprintDistance shape(footprint);
  // A second time from the path alone, where no band that was kept is of use.
  const bool is_fresh = candidates_.empty();
  for (int round = 0; round < (is_fresh ? 1 : 2); ++round) {
    if (round > 0) candidates_.clear();
    sign_bands(map);
    explore(guide, map, map.signature(guide.points));
    const TebObstacles obstacles = obstacles_about(situation, guide);
    optimize(situation, guide, shape, obstacles);
    if (situation.details != nullptr) around_ = {obstacles.centers, guide.task.via_points};
    drop_doubles(map);
    if (best(now_s) == nullptr) continue;
    drop_detours();
    const auto present = std::find_if(candidates_.begin(), candidates_.end(),
                                      [](const Candidate& c) { return c.is_present; });
    return &present->band;
  }
  candidates_.clear();
  return nullptr;
}

}  // namespace trident::nav
