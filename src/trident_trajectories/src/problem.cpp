// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories/problem.h"

#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "trident_base/error.h"

namespace trident::trajectories {
namespace {

constexpr double kSamePlane_m = 1e-6;
constexpr double kMinNumber = 1e-3, kMaxNumber = 1e6;  // of limits, sizes and times, in their units

struct KindName {
  const char* name;
  Kind kind;
};
constexpr std::array kKinds = {
    KindName{"uav", Kind::kUav},
    KindName{"unicycle", Kind::kUnicycle},
    KindName{"ackermann", Kind::kAckermann},
    KindName{"vessel", Kind::kVessel},
    KindName{"ugv", Kind::kUnicycle},
    KindName{"usv", Kind::kVessel},
};

struct CostName {
  const char* name;
  CostWeights weights;
};
constexpr std::array kCosts = {
    CostName{"jerk", {1.0, 0.0, 0.0, 0.0}},      CostName{"length", {0.0, 1.0, 0.0, 0.0}},
    CostName{"time", {0.01, 0.0, 1.0, 0.0}},     CostName{"energy", {0.0, 0.0, 0.0, 1.0}},
    CostName{"mixed", {0.25, 0.25, 0.25, 0.25}},
};

[[noreturn]] void refuse(const std::string& where, const std::string& field, double value,
                         const std::string& legal) {
  std::ostringstream text;
  text << where << ": " << field << " is " << value << "; legal is " << legal;
  throw Error(text.str());
}

void check(bool is_legal, const std::string& where, const std::string& field, double value,
           const std::string& legal) {
  if (!is_legal) refuse(where, field, value, legal);
}

/// A limit that may be left out: numbers that make sense for a robot, so that no square of them
/// is lost.
void check_limit(const std::string& where, const std::string& field, double value) {
  check((value >= kMinNumber && value <= kMaxNumber) || value == kUnlimited, where, field, value,
        "0.001 ... 1e6, or infinite");
}

void check_size(const std::string& where, const std::string& field, double value) {
  check(value >= kMinNumber && value <= kMaxNumber, where, field, value, "0.001 ... 1e6");
}

void check_index(std::size_t index, std::size_t size, const std::string& where,
                 const std::string& field) {
  check(index < size, where, field, static_cast<double>(index),
        "0 ... " + std::to_string(static_cast<long>(size) - 1));
}

void check_finite(const MotionState& state, const std::string& where) {
  const auto check_vector = [&](const char* field, const Eigen::Vector3d& value) {
    for (int axis = 0; axis < 3; ++axis)
      check(std::abs(value[axis]) <= kMaxNumber, where, std::string(field) + "." + "xyz"[axis],
            value[axis], "-1e6 ... 1e6");
  };
  check_vector("position", state.p);
  check_vector("velocity", state.v);
  check_vector("acceleration", state.a);
}

void check_limits(const Robot& robot, const std::string& where) {
  const Limits& limits = robot.limits;
  check_size(where, "max_velocity", limits.max_velocity);
  check_limit(where, "max_acceleration", limits.max_acceleration);
  check_limit(where, "max_jerk", limits.max_jerk);
  check_limit(where, "max_turn_rate", limits.max_turn_rate);
  check_limit(where, "max_thrust", limits.max_thrust);
  check_limit(where, "max_reverse_thrust", limits.max_reverse_thrust);
  check_size(where, "collision_radius", limits.collision_radius);
  check(limits.min_turning_radius >= 0.0 && limits.min_turning_radius <= kMaxNumber, where,
        "min_turning_radius", limits.min_turning_radius, "0 ... 1e6");
  check(robot.drag >= 0.0 && robot.drag <= kMaxNumber, where, "drag", robot.drag, "0 ... 1e6");
}

void check_surge(const SurgeModel& surge, const std::string& where) {
  check(surge.mass >= 0.0 && std::isfinite(surge.mass), where, "surge.mass", surge.mass, ">= 0");
  check(surge.linear_damping >= 0.0 && std::isfinite(surge.linear_damping), where,
        "surge.linear_damping", surge.linear_damping, ">= 0");
  check(surge.quadratic_damping >= 0.0 && std::isfinite(surge.quadratic_damping), where,
        "surge.quadratic_damping", surge.quadratic_damping, ">= 0");
  check(surge.current.allFinite(), where, "surge.current", surge.current.x(), "finite");
}

/// A robot in the plane must begin and end in it.
void check_plane(const Robot& robot, const std::string& where) {
  if (robot.kind == Kind::kUav) return;
  check(robot.start.v.z() == 0.0, where, "start velocity.z", robot.start.v.z(),
        std::string("0 for a robot of kind ") + name_of(robot.kind));
  if (robot.goal.place >= 0 || robot.goal.deck) return;
  check(std::abs(robot.goal.state.p.z() - robot.start.p.z()) <= kSamePlane_m, where,
        "goal position.z", robot.goal.state.p.z(),
        "the start's " + std::to_string(robot.start.p.z()) + " for a robot of kind " +
            name_of(robot.kind));
}

void check_robot(const Problem& problem, const Robot& robot) {
  const std::string where = "robot '" + robot.name + "'";
  check_finite(robot.start, where + " start");
  check_finite(robot.goal.state, where + " goal");
  check_limits(robot, where);
  check_surge(robot.surge, where);
  check_plane(robot, where);
  check_index(robot.duration, problem.durations.size(), where, "duration");
  if (robot.goal.place >= 0)
    check_index(static_cast<std::size_t>(robot.goal.place), problem.places.size(), where,
                "goal place");
  if (!problem.obstacles) return;
  Eigen::Vector3d slope;
  const double distance = problem.obstacles->distance(robot.start.p, slope);
  check(distance >= robot.limits.collision_radius, where, "distance of the start to an obstacle",
        distance, ">= its collision_radius " + std::to_string(robot.limits.collision_radius));
}

void check_duration(const Duration& duration, std::size_t i) {
  const std::string where = "duration " + std::to_string(i);
  check_size(where, "value", duration.value);
  if (!duration.is_free) return;
  check(duration.min >= 0.0 && duration.min <= duration.value, where, "min", duration.min,
        "0 ... value");
  check(duration.max == 0.0 || (duration.max >= duration.value && std::isfinite(duration.max)),
        where, "max", duration.max, "0 or >= value");
}

void check_rendezvous(const Problem& problem, std::size_t i) {
  const Rendezvous& pair = problem.rendezvous[i];
  const std::string where = "rendezvous " + std::to_string(i);
  check_index(pair.first, problem.robots.size(), where, "first");
  check_index(pair.second, problem.robots.size(), where, "second");
  check(pair.first != pair.second, where, "second", static_cast<double>(pair.second),
        "another robot than the first");
  check(problem.robots[pair.first].duration == problem.robots[pair.second].duration, where,
        "duration of the second", static_cast<double>(problem.robots[pair.second].duration),
        "that of the first");
  check(pair.tolerance > 0.0 && std::isfinite(pair.tolerance), where, "tolerance", pair.tolerance,
        "> 0");
  check(pair.fraction >= 0.0 && pair.fraction <= 1.0, where, "fraction", pair.fraction, "0 ... 1");
  check(pair.offset.allFinite(), where, "offset", pair.offset.x(), "finite");
}

void check_order(const Problem& problem, std::size_t i) {
  const ArrivalOrder& order = problem.order[i];
  const std::string where = "order " + std::to_string(i);
  check_index(order.earlier, problem.robots.size(), where, "earlier");
  check_index(order.later, problem.robots.size(), where, "later");
  check(problem.robots[order.earlier].duration != problem.robots[order.later].duration, where,
        "duration of the later", static_cast<double>(problem.robots[order.later].duration),
        "another than that of the earlier");
  check(order.gap >= 0.0 && std::isfinite(order.gap), where, "gap", order.gap, ">= 0");
}

void check_moving(const MovingObstacle& obstacle) {
  const std::string where = "moving obstacle '" + obstacle.name + "'";
  check(obstacle.radius > 0.0 && std::isfinite(obstacle.radius), where, "radius", obstacle.radius,
        "> 0");
  check(obstacle.height_factor >= 1.0, where, "height_factor", obstacle.height_factor, ">= 1");
}

void check_cost(const Problem& problem) {
  const CostWeights& cost = problem.cost;
  const std::array weights = {cost.jerk, cost.length, cost.time, cost.energy};
  double sum = 0.0;
  for (const double weight : weights) {
    check(weight >= 0.0 && std::isfinite(weight), "cost", "a weight", weight, ">= 0");
    sum += weight;
  }
  check(sum > 0.0, "cost", "the sum of weights", sum, "> 0");
  check(problem.downwash >= 1.0 && std::isfinite(problem.downwash), "problem", "downwash",
        problem.downwash, ">= 1");
  check(problem.min_height < kUnlimited, "problem", "min_height", problem.min_height,
        "finite, or -inf");
}

void check_names(const Problem& problem) {
  if (problem.robots.empty()) throw Error("robots: none; legal are 1 or more");
  if (problem.durations.empty()) throw Error("durations: none; legal are 1 or more");
  std::set<std::string> names;
  for (const Robot& robot : problem.robots) {
    if (robot.name.empty()) throw Error("robots: a name is empty; legal are unique names");
    if (!names.insert(robot.name).second)
      throw Error("robots: '" + robot.name + "' is there twice; legal are unique names");
  }
}

void check_places(const Problem& problem) {
  for (std::size_t i = 0; i < problem.places.size(); ++i)
    check(problem.places[i].allFinite(), "place " + std::to_string(i), "position",
          problem.places[i].x(), "finite");
}

void check_contacts(const Problem& problem) {
  for (const AllowedContact& contact : problem.contacts) {
    check_index(contact.first, problem.robots.size(), "contact", "first");
    check_index(contact.second, problem.robots.size(), "contact", "second");
  }
}

}  // namespace

Kind kind_of_name(const std::string& name) {
  std::string legal;
  for (const KindName& kind : kKinds) {
    if (name == kind.name) return kind.kind;
    legal += (legal.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw Error("kind is '" + name + "'; legal are " + legal);
}

const char* name_of(Kind kind) {
  for (const KindName& known : kKinds)
    if (known.kind == kind) return known.name;
  return "";
}

CostWeights cost_of_name(const std::string& name) {
  std::string legal;
  for (const CostName& cost : kCosts) {
    if (name == cost.name) return cost.weights;
    legal += (legal.empty() ? "" : ", ") + std::string(cost.name);
  }
  throw Error("cost is '" + name + "'; legal are " + legal);
}

void validate(const Problem& problem) {
  check_names(problem);
  check_cost(problem);
  for (std::size_t i = 0; i < problem.durations.size(); ++i)
    check_duration(problem.durations[i], i);
  check_places(problem);
  for (const Robot& robot : problem.robots) check_robot(problem, robot);
  for (const MovingObstacle& obstacle : problem.moving) check_moving(obstacle);
  for (std::size_t i = 0; i < problem.rendezvous.size(); ++i) check_rendezvous(problem, i);
  for (std::size_t i = 0; i < problem.order.size(); ++i) check_order(problem, i);
  check_contacts(problem);
}

}  // namespace trident::trajectories
