// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories/certificate.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "hull_check.h"
#include "search.h"

namespace trident::trajectories {
namespace {

/// A limit's bound, in its own unit; the greatest or least legal value.
double bound_of(const Problem& problem, const Constraint& constraint) {
  const Limits& limits = problem.robots[constraint.first()].limits;
  switch (constraint.limit()) {
    case LimitKind::kVelocity:
      return limits.max_velocity;
    case LimitKind::kAcceleration:
      return limits.max_acceleration;
    case LimitKind::kJerk:
      return limits.max_jerk;
    case LimitKind::kTurnRate:
      return limits.max_turn_rate;
    case LimitKind::kTurningRadius:
      return limits.min_turning_radius;
    case LimitKind::kThrust:
      return limits.max_thrust;
    case LimitKind::kReverseThrust:
      return limits.max_reverse_thrust;
    case LimitKind::kHeight:
      return problem.min_height;
    case LimitKind::kSeparation:
      return separation_of(problem, constraint.first(), constraint.second());
    case LimitKind::kObstacle:
      return limits.collision_radius;
    case LimitKind::kMovingObstacle:
      return limits.collision_radius + problem.moving[constraint.item()].radius;
    case LimitKind::kRendezvous:
      return problem.rendezvous[constraint.item()].tolerance;
    case LimitKind::kOrder:
      return problem.order[constraint.item()].gap;
  }
  return 0.0;
}

bool is_least(LimitKind kind) {
  return kind == LimitKind::kSeparation || kind == LimitKind::kObstacle ||
         kind == LimitKind::kMovingObstacle || kind == LimitKind::kTurningRadius ||
         kind == LimitKind::kOrder || kind == LimitKind::kHeight;
}

/// What is reached, by how far it is beyond the bound.
double value_of(const Problem& problem, const Constraint& constraint, double bound, double relative,
                double g) {
  switch (constraint.limit()) {
    case LimitKind::kTurningRadius:
      return bound / (1.0 + relative);
    case LimitKind::kHeight:
      return bound - g;
    case LimitKind::kRendezvous:
      return bound + g;
    case LimitKind::kOrder:
      return bound - g * problem.durations[problem.robots[constraint.second()].duration].value;
    default:
      return is_least(constraint.limit()) ? bound * (1.0 - relative) : bound * (1.0 + relative);
  }
}

Violation violation_of(const Problem& problem, const Constraint& constraint, const Peak& peak) {
  Violation out;
  out.limit = constraint.limit();
  out.robots = {constraint.first()};
  if (constraint.second() != constraint.first()) out.robots.push_back(constraint.second());
  out.t = peak.t;
  out.bound = bound_of(problem, constraint);
  out.relative = relative_excess(constraint.limit(), peak.value);
  out.value = value_of(problem, constraint, out.bound, out.relative, peak.value);
  return out;
}

}  // namespace

const char* name_of(LimitKind kind) {
  switch (kind) {
    case LimitKind::kVelocity:
      return "max_velocity";
    case LimitKind::kAcceleration:
      return "max_acceleration";
    case LimitKind::kJerk:
      return "max_jerk";
    case LimitKind::kTurnRate:
      return "max_turn_rate";
    case LimitKind::kTurningRadius:
      return "min_turning_radius";
    case LimitKind::kThrust:
      return "max_thrust";
    case LimitKind::kReverseThrust:
      return "max_reverse_thrust";
    case LimitKind::kHeight:
      return "min_height";
    case LimitKind::kSeparation:
      return "separation";
    case LimitKind::kObstacle:
      return "obstacle";
    case LimitKind::kMovingObstacle:
      return "moving_obstacle";
    case LimitKind::kRendezvous:
      return "rendezvous";
    case LimitKind::kOrder:
      return "order";
  }
  return "";
}

std::string describe(const Violation& violation, const Problem& problem) {
  std::ostringstream text;
  text.precision(4);
  for (std::size_t i = 0; i < violation.robots.size(); ++i)
    text << (i > 0 ? " and '" : "'") << problem.robots[violation.robots[i]].name << "'";
  text << " at " << violation.t << " s: " << name_of(violation.limit) << " " << violation.value
       << ", legal is " << (is_least(violation.limit) ? ">= " : "<= ") << violation.bound << " ("
       << 100.0 * violation.relative << " % beyond)";
  return text.str();
}

std::vector<Violation> violations(const Problem& problem,
                                  const std::vector<Trajectory>& trajectories, double within) {
  const HullCheck check(problem, trajectories);
  std::vector<Violation> out;
  for (const auto& constraint : constraints_of(problem, trajectories.front().basis())) {
    const Violation violation = violation_of(problem, *constraint, check.peak(*constraint));
    if (violation.relative > -within) out.push_back(violation);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Violation& a, const Violation& b) { return a.relative > b.relative; });
  return out;
}

}  // namespace trident::trajectories
