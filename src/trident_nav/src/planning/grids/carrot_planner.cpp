// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/carrot_planner.h"

#include <cmath>
#include <optional>
#include <string>

#include "planning/curves/footprint_contact.h"
#include "planning/plan_request.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

Pose2 between(const Pose2& from, const Pose2& to, double fraction) {
  return {from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y), to.yaw};
}

/// Steps along a straight line.
struct Line {
  Pose2 start, goal;
  double length = 0.0;
  double step = 0.0;
  int count() const { return static_cast<int>(std::ceil(length / step)); }
  Pose2 at(double from_start_m) const {
    return length > 0.0 ? between(start, goal, from_start_m / length) : goal;
  }
};

/// The free place nearest to the goal, at least `min_m` from the start.
std::optional<Pose2> carrot(const Line& line, const FootprintContact& contact, double min_m) {
  if (!contact.in_contact(line.goal)) return line.goal;
  for (int i = 1; i <= line.count(); ++i) {
    const double at = line.length - i * line.step;
    if (at < min_m) break;
    if (!contact.in_contact(line.at(at))) return line.at(at);
  }
  return std::nullopt;
}

/// The first place on the line to the carrot at which the footprint is in contact.
std::optional<Pose2> obstacle(const Line& line, const FootprintContact& contact, const Pose2& end) {
  const double length = distance(line.start.x, line.start.y, end.x, end.y);
  for (double at = line.step; at < length; at += line.step) {
    if (contact.in_contact(line.at(at))) return line.at(at);
  }
  return std::nullopt;
}

/// What is to be known of a line that is driven to a carrot; empty: it is free up to the goal.
std::string reservation(const Line& line, const FootprintContact& contact, const Pose2& end) {
  if (end.x != line.goal.x || end.y != line.goal.y) {
    return "The goal cannot be reached; the path ends at " + place_text(end.x, end.y) + ".";
  }
  const auto hit = obstacle(line, contact, end);
  if (!hit) return "";
  return "The straight line to the goal is blocked at " + place_text(hit->x, hit->y) + ".";
}

}  // namespace

PlanOutcome CarrotPlanner::plan(const CostGrid& grid, const Footprint& footprint,
                                const Pose2& start, const Pose2& goal,
                                const MotionLimits& /*limits*/, const CancelFlag& cancel) {
  if (auto refusal = refused(grid, start, goal)) return *refusal;
  if (cancel.load()) return failed(Failure::kCanceled, "Planning was canceled.");
  const FootprintContact contact(grid, footprint, FootprintContact::Unknown::kBlocked);
  const double step = params_.step_size > 0.0 ? params_.step_size : grid.geometry.resolution;
  const Line line{start, goal, distance(start.x, start.y, goal.x, goal.y), step};
  const std::optional<Pose2> end = carrot(line, contact, params_.min_dist_from_robot);
  if (!end) {
    return failed(Failure::kGoalOccupied,
                  "The footprint is in contact at the goal " + place_text(goal.x, goal.y) +
                      " and everywhere on the straight line back to the robot.");
  }
  PlanOutcome outcome;
  outcome.path = {start, *end};
  outcome.cost = distance(start.x, start.y, end->x, end->y);
  outcome.reason = reservation(line, contact, *end);
  return outcome;
}

TRIDENT_NAV_PLANNER(carrot_planner, "carrot_planner/CarrotPlanner", CarrotPlanner,
                    CarrotPlannerParams)

}  // namespace trident::nav
