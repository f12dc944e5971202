// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/poses/pose_route.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "planning/plan_request.h"
#include "planning/poses/slot_exit.h"
#include "trident_base/error.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav {
namespace {

/// How many headings to either side stand for one that cannot be driven to, and at how many places.
constexpr int kTurns = 8;
constexpr std::size_t kTurnedPlaces = 5;

/// A start may be so deep in an obstacle, and the turns away from it swing the footprint as deep.
constexpr double kLeaveDepthCells = 1.5;

std::string number_text(double value, const char* unit) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f %s", value, unit);
  return text;
}

void fail(PlanOutcome& outcome, Failure failure, const std::string& reason) {
  outcome.failure = failure;
  outcome.reason = reason;
  outcome.path.clear();
}

void comment(PlanOutcome& outcome, const std::string& text) {
  outcome.reason += outcome.reason.empty() ? text : " " + text;
}

Pose2 to_cells(const GridGeometry& g, const Pose2& pose) {
  return {(pose.x - g.origin_x) / g.resolution, (pose.y - g.origin_y) / g.resolution, pose.yaw};
}

std::string off_text(const Pose2& end, const Pose2& goal) {
  return "the path ends at " + place_text(end.x, end.y) + ", " +
         number_text(distance(end.x, end.y, goal.x, goal.y), "m") + " and " +
         number_text(std::abs(wrap_angle(end.yaw - goal.yaw)), "rad") + " from it.";
}

void add_if_free(const FootprintContact& contact, Pose2 pose, double turn,
                 std::vector<Pose2>& poses) {
  pose.yaw = wrap_angle(pose.yaw + turn);
  if (!contact.in_contact(pose)) poses.push_back(pose);
}

/// Backwards from the goal: to a place, at any heading.
PoseSearchOptions approach_options(PoseSearchOptions options) {
  options.curve_window = 0.0;
  options.max_expansion_length = 0.0;
  return options;
}

StepCosts open_cells(bool crosses_unknown) {
  StepCosts cells;
  for (std::size_t c = 0; c < kInscribedCost; ++c) cells.step[c] = 1.0F;
  if (crosses_unknown) cells.step[kUnknownCost] = 1.0F;
  return cells;
}

}  // namespace

PoseRoute::PoseRoute(MotionSet motions, const PoseRouteOptions& options)
    : motions_(std::move(motions)),
      reversed_(reversed(motions_)),
      options_(options),
      open_cells_(open_cells(options.heuristic.crosses_unknown)),
      heuristic_(options.heuristic),
      gate_heuristic_(options.heuristic),
      search_(motions_, options.costs, options.search),
      approach_search_(reversed_, options.costs, approach_options(options.search)),
      probe_(motions_) {}

PlanOutcome PoseRoute::plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                            const Pose2& goal, const CancelFlag& cancel) {
  if (auto refusal = refused(grid, start, goal)) return *refusal;
  Footprint robot;
  try {
    robot = checked_footprint(footprint, grid.geometry.resolution);
  } catch (const Error& error) {
    return failed(Failure::kInvalidInput, std::string("The footprint: ") + error.what());
  }
  Request request{grid, start, goal, goal, cancel, {}, {}, {}};
  FootprintContact contact(grid, robot,
                           options_.heuristic.crosses_unknown
                               ? FootprintContact::Unknown::kFree
                               : FootprintContact::Unknown::kBlocked);
  const CurveChecker checker(grid, contact, options_.costs);
  if (leave_start(request, contact, escape_reach(footprint)) &&
      find_goal(request, contact, checker)) {
    search(request, checker);
  }
  return std::move(request.outcome);
}

// Poses of a path lie up to a cell apart: straight lines between those on an arc leave it by its
// sagitta, by which the footprint is grown.
Footprint PoseRoute::checked_footprint(const Footprint& footprint, double resolution) const {
  if (footprint.points.empty()) return footprint;
  return grown_footprint(footprint, resolution / (8.0 * options_.search.radius));
}

void PoseRoute::allow_start(Request& request, FootprintContact& contact) {
  const double depth_m = kLeaveDepthCells * request.grid.geometry.resolution;
  if (contact.let_leave(request.start, depth_m)) {
    comment(request.outcome,
            "The footprint reaches into an obstacle at the start; near it, it is "
            "taken to be smaller by " +
                number_text(depth_m, "m") + ".");
    return;
  }
  contact.ignore_under(request.start);
  comment(request.outcome, "The footprint covers an obstacle at the start, which is ignored.");
}

void PoseRoute::place_start(PoseSearch::Query& query, const Pose2& start) const {
  query.start = start;
  query.start_heading = static_cast<unsigned>(motions_.nearest_heading(start.yaw));
  query.offset = start.yaw - motions_.heading(query.start_heading);
}

bool PoseRoute::leave_start(Request& request, FootprintContact& contact, double reach_m) const {
  const GridGeometry& g = request.grid.geometry;
  PoseSearch::Query& query = request.query;
  place_start(query, to_cells(g, request.start));
  if (contact.in_contact(request.start)) allow_start(request, contact);
  const Cell cell = g.cell(request.start.x, request.start.y);
  const std::vector<Cell> escape = escape_cells(request.grid, open_cells_, cell, reach_m);
  if (escape.empty()) {
    fail(request.outcome, Failure::kStartOccupied,
         "The start " + place_text(request.start.x, request.start.y) +
             " lies in blocked space, and no free place is within " + number_text(reach_m, "m") +
             " of it.");
    return false;
  }
  request.exit = escape.back();
  query.exit = {escape.back().x + 0.5, escape.back().y + 0.5, 0.0};
  query.exit_reach = escape.size() > 1 ? reach_m / g.resolution : 0.0;
  return true;
}

// What one goal cannot be reached from cannot be reached from its surroundings.
bool PoseRoute::is_cut_off(Cell cell, const std::optional<Cell>& cut_off) {
  return cut_off && (cell == *cut_off || std::isfinite(heuristic_.at(cell.x, cell.y)));
}

bool PoseRoute::can_enter(const CurveChecker& checker, const Pose2& goal) {
  return probe_.can_enter(checker, goal) || out_of_slot(checker, goal);
}

// The first of the poses within the tolerance that the start is connected with and that can be
// entered.
bool PoseRoute::find_goal(Request& request, const FootprintContact& contact,
                          const CurveChecker& checker) {
  const std::vector<Pose2> goals = free_goals(request, contact);
  const GridGeometry& g = request.grid.geometry;
  bool is_any_open = false;
  std::optional<Cell> cut_off;
  for (const Pose2& goal : goals) {
    const Cell cell = g.cell(goal.x, goal.y);
    if (is_cut_off(cell, cut_off)) continue;
    request.end = goal;
    request.query.goal = to_cells(g, goal);
    if (!can_enter(checker, request.query.goal)) continue;
    is_any_open = true;
    if (aim(request, goal)) return true;
    if (request.outcome.failure == Failure::kCanceled) return false;
    cut_off = cell;
  }
  explain_goal(request, goals.empty(), is_any_open);
  return false;
}

std::optional<TravelPath> PoseRoute::out_of_slot(const CurveChecker& checker,
                                                 const Pose2& goal) const {
  if (options_.search.model != MotionModel::kReedsShepp) return std::nullopt;
  return path_out_of_slot(checker, goal, options_.search.radius);
}

void PoseRoute::explain_goal(Request& request, bool is_occupied, bool can_enter) const {
  const std::string place = place_text(request.goal.x, request.goal.y);
  const std::string within = " within the tolerance of " + number_text(options_.tolerance_m, "m");
  if (is_occupied) {
    fail(request.outcome, Failure::kGoalOccupied,
         "The footprint is in contact at the goal " + place + ", and no free place is" + within +
             ".");
  } else if (!can_enter) {
    fail(request.outcome, Failure::kNoPath,
         "No path leads to the goal " + place + " with its heading, nor to a pose" + within +
             ": obstacles leave no room to come to it.");
  } else {
    fail(request.outcome, Failure::kNoPath,
         "No path leads to the goal " + place + ": obstacles cut it off from the start.");
  }
}

// The goal's heading cannot be driven to: any pose within the tolerance will do.
void PoseRoute::accept_near(Request& request) const {
  const double cells = options_.tolerance_m / request.grid.geometry.resolution;
  request.query.stop_within = std::max(cells, 1e-9);
}

// The goal and the middles of cells within the tolerance, by distance, with the goal's heading.
std::vector<Pose2> PoseRoute::goal_places(const Request& request) const {
  std::vector<Pose2> places{request.goal};
  for (const Cell c : cells_near(request.grid, open_cells_, request.goal, options_.tolerance_m)) {
    const Point2 center = request.grid.geometry.center(c);
    const double off = distance(center.x, center.y, request.goal.x, request.goal.y);
    if (off <= options_.tolerance_m && off > 0.0) {
      places.push_back({center.x, center.y, request.goal.yaw});
    }
  }
  return places;
}

// The goal and poses within the tolerance that are free: first with its heading, by distance, then
// with others at the nearest places.
std::vector<Pose2> PoseRoute::free_goals(const Request& request,
                                         const FootprintContact& contact) const {
  std::vector<Pose2> goals, places = goal_places(request);
  for (const Pose2& place : places) add_if_free(contact, place, 0.0, goals);
  if (options_.tolerance_m <= 0.0) return goals;
  places.resize(std::min(places.size(), kTurnedPlaces));
  for (int k = 1; k <= kTurns; ++k) {
    for (const Pose2& place : places) {
      add_if_free(contact, place, kPi * k / kTurns, goals);
      if (k < kTurns) add_if_free(contact, place, -kPi * k / kTurns, goals);
    }
  }
  return goals;
}

// Whether the start lies where the goal can be reached from.
bool PoseRoute::aim(Request& request, const Pose2& goal) {
  const GridGeometry& g = request.grid.geometry;
  PoseSearch::Query& query = request.query;
  query.goal = to_cells(g, goal);
  heuristic_.aim(request.grid, g.cell(goal.x, goal.y));
  const Cell exit = request.exit;
  if (!heuristic_.reach(exit, request.cancel)) {
    fail(request.outcome, Failure::kCanceled, "Planning was canceled.");
    return false;
  }
  query.exit_cost = std::max(1e-6, static_cast<double>(heuristic_.at(exit.x, exit.y)));
  return std::isfinite(query.exit_cost);
}

void PoseRoute::search(Request& request, const CurveChecker& checker) {
  request.query.checker = &checker;
  request.query.heuristic = &heuristic_;
  TravelPath path;
  const PoseSearch::Result result = run(request, path);
  if (result == PoseSearch::Result::kCanceled) {
    fail(request.outcome, Failure::kCanceled, "Planning was canceled.");
  } else if (result == PoseSearch::Result::kFound) {
    use(request, std::move(path), checker);
    Pose2& last = request.outcome.path.back();
    last = request.end;
    if (last.x != request.goal.x || last.y != request.goal.y ||
        std::abs(wrap_angle(last.yaw - request.goal.yaw)) > 1e-9) {
      comment(request.outcome, "The goal cannot be reached; " + off_text(last, request.goal));
    }
  } else {
    use_nearest(request, result, checker);
  }
}

void PoseRoute::use(Request& request, TravelPath path, const CurveChecker& checker) const {
  if (options_.shortcuts) {
    path = with_shortcuts(path, checker, *options_.shortcuts, request.cancel);
  }
  for (const TravelPath::Point& point : path.points) {
    Pose2 pose = checker.to_metric(point.pose);
    pose.yaw = wrap_angle(pose.yaw);
    request.outcome.path.push_back(pose);
  }
  request.outcome.path.front() = request.start;
}

// Ends near the goal when that is near enough.
void PoseRoute::use_nearest(Request& request, PoseSearch::Result result,
                            const CurveChecker& checker) const {
  const double off_m = search_.nearest_distance() * request.grid.geometry.resolution;
  const std::string place = place_text(request.goal.x, request.goal.y);
  if (off_m <= options_.tolerance_m) {
    use(request, search_.nearest_path(), checker);
    comment(request.outcome, "The goal's pose cannot be reached; " +
                                 off_text(request.outcome.path.back(), request.goal));
    return;
  }
  if (result == PoseSearch::Result::kTimeout) {
    fail(request.outcome, Failure::kTimeout,
         "No path to the goal " + place + " was found within max_planning_time of " +
             number_text(options_.max_time_s, "s") + ".");
  } else if (result == PoseSearch::Result::kTooManyIterations) {
    fail(request.outcome, Failure::kTimeout,
         "No path to the goal " + place + " was found within max_iterations of " +
             std::to_string(options_.max_iterations) + ".");
  } else {
    fail(request.outcome, Failure::kNoPath,
         "No path leads from the start " + place_text(request.start.x, request.start.y) +
             " and its heading to the goal " + place +
             ": the robot's turns do not fit between the obstacles.");
  }
}

}  // namespace trident::nav
