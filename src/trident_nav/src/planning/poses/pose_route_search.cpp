// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The searches of a plan over poses, one after the other.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "planning/poses/pose_route.h"
#include "planning/poses/slot_exit.h"

namespace trident::nav {
namespace {

/// Poses that the first search comes to, that from the goal, and that between both.
constexpr std::int64_t kFirstIterations = 3000;
constexpr std::int64_t kApproachIterations = 50000;
constexpr std::int64_t kJoinIterations = 30000;
/// An approach begins where so much is left to the goal [lengths of cells]: not so near that it
/// has no room to turn, not so far that its search is long. From nearer starts, at half of it.
constexpr double kApproachCost = 80.0;
constexpr double kMinApproachCost = 30.0;
/// How near to that place it has to come [cells].
constexpr double kGateRadius = 2.5;
/// A path from its end to its start; its motions are those of that direction already.
TravelPath turned_round(const TravelPath& path) {
  TravelPath result;
  for (std::size_t i = path.points.size(); i-- > 0;) {
    TravelPath::Point point = path.points[i];
    const TravelPath::Point& motion = path.points[std::min(i + 1, path.points.size() - 1)];
    point.turns = motion.turns;
    point.reverses = motion.reverses;
    result.points.push_back(point);
  }
  return result;
}

/// Makes a query begin at a cell: false where the heuristic does not come to it.
bool begin_at(Cell exit, ObstacleHeuristic& heuristic, const CancelFlag& cancel,
              PoseSearch::Query* query) {
  if (!heuristic.reach(exit, cancel)) return false;
  query->exit_cost = std::max(1e-6, static_cast<double>(heuristic.at(exit.x, exit.y)));
  return true;
}

/// A path as it is driven backwards, from its end to its start.
TravelPath retraced(TravelPath path) {
  for (TravelPath::Point& point : path.points) point.reverses = !point.reverses;
  return turned_round(path);
}

}  // namespace

PoseSearch::Result PoseRoute::first_search(Request& request) {
  PoseSearch::Query& query = request.query;
  query.deadline = std::chrono::steady_clock::now() +
                   std::chrono::microseconds(static_cast<std::int64_t>(options_.max_time_s * 1e6));
  query.max_iterations = kFirstIterations;
  if (options_.max_iterations >= 0) {
    query.max_iterations = std::min(query.max_iterations, options_.max_iterations);
  }
  const PoseSearch::Result result = search_.search(request.grid, query, request.cancel);
  iterations_ = search_.iterations();
  return result;
}

// To where an approach begins that has been found from the goal.
bool PoseRoute::search_by_approach(Request& request, TravelPath& path) {
  if (!(request.query.stop_within <= 0.0)) return false;
  const std::optional<TravelPath> approach = find_approach(request);
  if (!approach || !join_approach(request, *approach, path)) return false;
  request.outcome.cost += approach_search_.nearest_cost();
  return true;
}

PoseSearch::Result PoseRoute::last_search(Request& request) {
  PoseSearch::Query& query = request.query;
  query.max_iterations = options_.max_iterations;
  if (query.stop_within > 0.0) query.max_iterations = kJoinIterations;
  const PoseSearch::Result result = search_.search(request.grid, query, request.cancel);
  iterations_ += search_.iterations();
  return result;
}

// After a short search that has not come to the goal.
PoseSearch::Result PoseRoute::search_further(Request& request, PoseSearch::Result first,
                                             TravelPath& path) {
  if (enter_slot(request, path) || leave_slot(request, path)) return PoseSearch::Result::kFound;
  if (first != PoseSearch::Result::kTooManyIterations) return first;
  if (search_by_approach(request, path)) return PoseSearch::Result::kFound;
  const PoseSearch::Result last = last_search(request);
  if (last == PoseSearch::Result::kFound) take_found(request, path);
  return last;
}

void PoseRoute::take_found(Request& request, TravelPath& path) const {
  path = search_.path();
  request.outcome.cost = search_.cost();
}

// A short search; when that does not come to the goal, one to where an approach begins that has
// been found from the goal; then one without limits.
PoseSearch::Result PoseRoute::run(Request& request, TravelPath& path) {
  const PoseSearch::Result first = first_search(request);
  if (first == PoseSearch::Result::kCanceled) return first;
  if (first != PoseSearch::Result::kFound) return search_further(request, first, path);
  take_found(request, path);
  return first;
}

// Into a slot as a car leaves it, in the other direction.
bool PoseRoute::enter_slot(Request& request, TravelPath& path) {
  const auto out = out_of_slot(*request.query.checker, request.query.goal);
  if (!out) return false;
  const TravelPath in = retraced(*out);
  const Pose2& begin = in.points.front().pose;
  gate_heuristic_.aim(request.grid, {static_cast<int>(begin.x), static_cast<int>(begin.y)});
  if (!join_approach(request, in, path)) return false;
  request.outcome.cost += static_cast<double>(in.points.size());
  return true;
}

// Out of the slot that the start is in, and on from there; perhaps into the same slot again.
bool PoseRoute::leave_slot(Request& request, TravelPath& path) {
  const auto out = out_of_slot(*request.query.checker, request.query.start);
  if (!out) return false;
  Request outside = request;
  place_start(outside.query, out->points.back().pose);
  const Pose2& start = outside.query.start;
  outside.exit = {static_cast<int>(start.x), static_cast<int>(start.y)};
  outside.query.exit = start;
  outside.query.exit_reach = 0.0;
  if (!begin_at(outside.exit, heuristic_, request.cancel, &outside.query)) return false;
  TravelPath rest;
  const PoseSearch::Result result = search_.search(request.grid, outside.query, request.cancel);
  iterations_ += search_.iterations();
  if (result == PoseSearch::Result::kFound) {
    rest = search_.path();
    outside.outcome.cost = search_.cost();
  } else if (!enter_slot(outside, rest)) {
    return false;
  }
  path = *out;
  path.points.insert(path.points.end(), rest.points.begin() + 1, rest.points.end());
  request.outcome.cost = outside.outcome.cost + static_cast<double>(out->points.size());
  return true;
}

// A path to the goal from a place some distance before it, seen from the start.
std::optional<TravelPath> PoseRoute::find_approach(Request& request) {
  const double begin = std::min(kApproachCost, 0.5 * request.query.exit_cost);
  if (begin < kMinApproachCost) return std::nullopt;
  const Cell gate = heuristic_.descend(request.exit, static_cast<float>(begin));
  gate_heuristic_.aim(request.grid, gate);
  PoseSearch::Query query;
  query.checker = request.query.checker;
  query.heuristic = &gate_heuristic_;
  query.start = request.query.goal;
  query.start_heading = static_cast<unsigned>(reversed_.nearest_heading(query.start.yaw));
  query.offset = query.start.yaw - reversed_.heading(query.start_heading);
  query.goal = {gate.x + 0.5, gate.y + 0.5, 0.0};
  query.stop_within = kGateRadius;
  query.max_iterations = kApproachIterations;
  query.deadline = request.query.deadline;
  const PoseSearch::Result result = approach_search_.search(request.grid, query, request.cancel);
  iterations_ += approach_search_.iterations();
  if (approach_search_.nearest_distance() >= kGateRadius) {
    if (result == PoseSearch::Result::kNoPath) accept_near(request);
    return std::nullopt;
  }
  return turned_round(approach_search_.nearest_path());
}

bool PoseRoute::join_approach(Request& request, const TravelPath& approach, TravelPath& path) {
  PoseSearch::Query query = request.query;
  query.heuristic = &gate_heuristic_;
  query.goal = approach.points.front().pose;
  query.max_iterations = kJoinIterations;
  if (!begin_at(request.exit, gate_heuristic_, request.cancel, &query)) return false;
  const PoseSearch::Result result = search_.search(request.grid, query, request.cancel);
  iterations_ += search_.iterations();
  if (result != PoseSearch::Result::kFound) return false;
  path = search_.path();
  path.points.insert(path.points.end(), approach.points.begin() + 1, approach.points.end());
  request.outcome.cost = search_.cost();
  return true;
}

}  // namespace trident::nav
