// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trajectory_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../steering.h"

namespace trident::nav {
namespace {

MppiModel search_model(const ControlSetup& setup, const SearchParams& params) {
  MppiModel model;
  model.motion = setup.limits.vy_max > 0.0               ? MppiMotion::kOmni
                 : setup.limits.min_turning_radius > 0.0 ? MppiMotion::kAckermann
                                                         : MppiMotion::kDiffDrive;
  model.limits = setup.limits;
  if (!params.accelerates) {
    constexpr double kAtOnce = 1e6;
    model.limits.ax_max = model.limits.decel_max = kAtOnce;
    model.limits.ay_max = model.limits.alpha_max = kAtOnce;
  }
  const double along = setup.limits.vx_max * params.sim_time_s / params.granularity_m;
  const double turned = setup.limits.wz_max * params.sim_time_s / params.angular_granularity;
  model.steps = std::clamp(static_cast<int>(std::ceil(std::max(along, turned))), 2, 200);
  model.dt_s = params.sim_time_s / model.steps;
  model.inscribed_radius = setup.footprint.inscribed_radius;
  model.circumscribed_radius = setup.footprint.circumscribed_radius;
  model.cover = cover_footprint(setup.footprint);
  return model;
}

bool is_same(const Twist2& a, const Twist2& b) {
  return a.vx == b.vx && a.vy == b.vy && a.wz == b.wz;
}

}  // namespace

TrajectorySearch::TrajectorySearch(const ControlSetup& setup, const SearchParams& params)
    : model_(search_model(setup, params)),
      rollouts_(model_.steps),
      path_grid_(setup.unknown),
      goal_grid_(setup.unknown) {}

double TrajectorySearch::reach_m(double margin_m) const {
  return model_.limits.vx_max * model_.horizon_s() + margin_m;
}

DwaScene TrajectorySearch::begin(const Situation& situation) {
  const Point2 center{situation.state.pose.x, situation.state.pose.y};
  // Beyond what trajectories reach distances go around obstacles.
  const double radius_m = reach_m(4.0 * model_.circumscribed_radius);
  path_grid_.resize(situation.grid, center, radius_m);
  goal_grid_.resize(situation.grid, center, radius_m);
  path_grid_.measure_from_path(situation.grid, situation.path.poses);
  goal_grid_.measure_from_end(situation.grid, situation.path.poses);
  return {situation, situation.grid.geometry.resolution, path_grid_, goal_grid_,
          distance_left(situation)};
}

void TrajectorySearch::roll(const std::vector<Twist2>& samples, std::size_t first,
                            const Situation& situation, const ObstacleSurvey& survey) {
  for (int lane = 0; lane < kLanes; ++lane) {
    const std::size_t i = std::min(first + static_cast<std::size_t>(lane), samples.size() - 1);
    for (int step = 0; step < model_.steps; ++step) {
      rollouts_.at(rollouts_.vx, step)[lane] = static_cast<float>(samples[i].vx);
      rollouts_.at(rollouts_.vy, step)[lane] = static_cast<float>(samples[i].vy);
      rollouts_.at(rollouts_.wz, step)[lane] = static_cast<float>(samples[i].wz);
    }
  }
  roll_out(model_, {situation.state.pose.yaw, situation.state.twist}, &rollouts_);
  survey.survey(&rollouts_);
}

int TrajectorySearch::last_step(const Twist2& twist, double goal_distance_m, int steps) const {
  const double step_m = std::hypot(twist.vx, twist.vy) * model_.dt_s;
  const double to_goal = step_m > 0.0 ? std::ceil(goal_distance_m / step_m) : steps;
  return std::clamp(static_cast<int>(std::min(to_goal, 1e6)) - 1, 0, steps - 1);
}

std::optional<double> TrajectorySearch::score(const DwaScene& scene, const Candidate& candidate,
                                              const TrajectoryCritics& critics, double best) const {
  // Of equals, the one that turns less.
  constexpr double kTieBreak = 1e-4;
  double total = kTieBreak * std::fabs(candidate.twist.wz);
  for (const auto& critic : critics) {
    if (critic->scale() == 0.0) continue;
    const double value = critic->score(scene, candidate);
    if (value < 0.0) return std::nullopt;
    total += critic->scale() * value;
    if (total >= best) return std::nullopt;  // it cannot become the best one
  }
  return total;
}

std::optional<RatedTwist> TrajectorySearch::best(const std::vector<Twist2>& samples,
                                                 const DwaScene& scene,
                                                 const TrajectoryCritics& critics,
                                                 double horizon_s) {
  if (samples.empty()) return std::nullopt;
  const double wanted = std::ceil(horizon_s / model_.dt_s - 1e-6);
  const int steps = static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(model_.steps)));
  const Situation& situation = scene.situation;
  const CostGrid grid = distances_.of(situation.grid);
  for (const auto& critic : critics) critic->prepare(scene);
  const ObstacleSurvey survey(model_, situation.checker, grid, situation.state.pose, {true, 1});
  std::optional<RatedTwist> chosen;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < samples.size(); first += kLanes) {
    roll(samples, first, situation, survey);
    const auto count = std::min<std::size_t>(kLanes, samples.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      const Candidate candidate{samples[first + k], &rollouts_, static_cast<int>(k),
                                last_step(samples[first + k], scene.goal_distance_m, steps)};
      const bool is_free = rollouts_.contact_step[k] >= steps;
      constexpr double kNone = -1.0;
      const double total =
          is_free ? score(scene, candidate, critics, least).value_or(kNone) : kNone;
      if (situation.watched.trajectories) note(situation, candidate, total);
      if (total < 0.0) continue;
      least = total;
      chosen = RatedTwist{candidate.twist, least};
    }
  }
  return chosen;
}

std::optional<Twist2> TrajectorySearch::best(const std::vector<Twist2>& samples,
                                             const Situation& situation,
                                             const TrajectoryCritics& critics,
                                             const SearchDisplay& display) {
  const DwaScene scene = begin(situation);
  const auto chosen = best(samples, scene, critics);
  if (!chosen) return std::nullopt;
  for (const auto& critic : critics) critic->on_chosen(scene, chosen->twist);
  describe(chosen->twist, scene, display);
  return chosen->twist;
}

/// `cost`: negative where the candidate is in contact, forbidden, or worse than another one.
void TrajectorySearch::note(const Situation& situation, const Candidate& candidate,
                            double cost) const {
  ConsideredTrajectory trajectory;
  trajectory.cost = cost;
  trajectory.points.push_back({0.0, situation.state.pose, candidate.twist});
  for (int step = 0; step <= candidate.last; ++step) {
    trajectory.points.push_back(
        {model_.dt_s * (step + 1), candidate.pose(situation.state.pose, step), candidate.twist});
  }
  situation.details->trajectories.push_back(std::move(trajectory));
}

void TrajectorySearch::describe(const Twist2& chosen, const DwaScene& scene,
                                const SearchDisplay& display) {
  const Situation& situation = scene.situation;
  if (situation.watched.cells && display.cells) describe_cells(situation, display);
  if (!situation.watched.trajectories) return;
  std::vector<ConsideredTrajectory>& noted = situation.details->trajectories;
  auto at = std::find_if(noted.begin(), noted.end(), [&](const ConsideredTrajectory& one) {
    return is_same(one.points.front().twist, chosen);
  });
  if (at == noted.end()) return;
  if (!display.trajectories) {
    noted = {std::move(*at)};
    at = noted.begin();
  }
  situation.details->selected = static_cast<std::size_t>(at - noted.begin());
}

void TrajectorySearch::describe_cells(const Situation& situation,
                                      const SearchDisplay& display) const {
  const GridGeometry& geometry = situation.grid.geometry;
  for (Cell cell{0, 0}; cell.y < geometry.height; ++cell.y) {
    for (cell.x = 0; cell.x < geometry.width; ++cell.x) {
      CellScore score;
      score.center = geometry.center(cell);
      score.path = static_cast<double>(path_grid_.at(score.center.x, score.center.y));
      score.goal = static_cast<double>(goal_grid_.at(score.center.x, score.center.y));
      score.occupied = situation.grid.at(cell);
      const bool is_reached = score.path < static_cast<double>(path_grid_.unreachable()) &&
                              score.goal < static_cast<double>(goal_grid_.unreachable());
      if (!is_reached || score.occupied >= kInscribedCost) continue;
      score.total = display.path_weight * score.path + display.goal_weight * score.goal +
                    display.cost_weight * score.occupied;
      situation.details->cells.push_back(score);
    }
  }
}

}  // namespace trident::nav
