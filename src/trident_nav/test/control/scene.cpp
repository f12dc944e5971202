// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "control/scene.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav::testing {
namespace {

GridWorld walled(double width_m, double height_m) {
  GridWorld world(width_m, height_m);
  constexpr double kWall = 0.1;
  world.fill({0.0, 0.0, width_m, kWall});
  world.fill({0.0, height_m - kWall, width_m, height_m});
  world.fill({0.0, 0.0, kWall, height_m});
  world.fill({width_m - kWall, 0.0, width_m, height_m});
  return world;
}

Scene finished(std::string name, GridWorld world, const Footprint& footprint, const Pose2& start,
               const Pose2& goal) {
  world.inflate(footprint.inscribed_radius, footprint.inscribed_radius + 0.5, 5.0);
  return {std::move(name), std::move(world), start, goal};
}

void judge_acceleration(const MotionLimits& limits, const Twist2& from, const Twist2& to,
                        double period_s, Drive* result) {
  const auto ratio = [&](double change, double rate) {
    return std::fabs(change) / (rate * period_s);
  };
  double worst = ratio(to.vx - from.vx, std::max(limits.ax_max, limits.decel_max));
  if (limits.vy_max > 0.0) worst = std::max(worst, ratio(to.vy - from.vy, limits.ay_max));
  if (limits.min_turning_radius <= 0.0) {
    worst = std::max(worst, ratio(to.wz - from.wz, limits.alpha_max));
  }
  result->max_acceleration_ratio = std::max(result->max_acceleration_ratio, worst);
}

}  // namespace

bool follow_command(const ControlSetup& setup, const FootprintChecker& body, const CostGrid& grid,
                    const Twist2& command, RobotState* state) {
  constexpr int kSubsteps = 50;
  const double dt = setup.period_s / kSubsteps;
  bool is_free = true;
  for (int i = 0; i < kSubsteps; ++i) {
    state->twist = reachable_window(setup.limits, state->twist, dt).clamp(command);
    state->pose = integrate(state->pose, state->twist, dt);
    is_free = is_free && body.is_free(grid, state->pose);
  }
  state->time_s += setup.period_s;
  return is_free;
}

Scene straight_scene(const Footprint& footprint) {
  const double r = footprint.circumscribed_radius;
  const double wide = std::max(4.0 * r, 1.0);
  GridWorld world = walled(20.0 * r + 1.0, wide + 0.2);
  const double y = 0.5 * wide + 0.1;
  return finished("straight", std::move(world), footprint, {2.0 * r, y, 0.0},
                  {15.0 * r + 0.8, y, 0.0});
}

Scene corner_scene(const Footprint& footprint) {
  const double r = footprint.circumscribed_radius;
  const double wide = std::max(3.5 * r, 0.6);
  const double size = wide + 10.0 * r + 0.4;
  GridWorld world = walled(size, size);
  world.fill({0.1, wide + 0.1, size - wide - 0.1, size});
  const double middle = 0.5 * wide + 0.1;
  return finished("corner", std::move(world), footprint, {2.0 * r, middle, 0.0},
                  {size - middle, size - 4.0 * r - 0.2, 0.5 * kPi});
}

Scene doorway_scene(const Footprint& footprint) {
  const double r = footprint.circumscribed_radius;
  const double size = std::max(12.0 * r, 2.0);
  GridWorld world = walled(2.0 * size, size);
  const double door = 2.0 * footprint.inscribed_radius + 0.25;
  world.fill({size - 0.05, 0.0, size + 0.05, 0.6 * size - 0.5 * door});
  world.fill({size - 0.05, 0.6 * size + 0.5 * door, size + 0.05, size});
  return finished("doorway", std::move(world), footprint, {3.0 * r, 0.25 * size, 0.0},
                  {2.0 * size - 4.0 * r - 0.1, 0.25 * size, 0.0});
}

Scene dead_end_scene(const Footprint& footprint) {
  const double r = footprint.circumscribed_radius;
  const double wide = 3.0 * r + 0.2;
  const double deep = 8.0 * r + 0.2;
  const double size = deep + 10.0 * r;
  GridWorld world = walled(size, std::max(10.0 * r, 2.0));
  const double y = 0.5 * std::max(10.0 * r, 2.0);
  world.fill({0.0, 0.0, deep, y - 0.5 * wide});
  world.fill({0.0, y + 0.5 * wide, deep, 100.0});
  return finished("dead end", std::move(world), footprint, {0.1 + 1.6 * r, y, kPi},
                  {size - 4.0 * r - 0.1, y, 0.0});
}

Scene goal_behind_scene(const Footprint& footprint) {
  const double r = footprint.circumscribed_radius;
  const double wide = std::max(1.0, 3.0 * r);
  GridWorld world = walled(16.0 * r + 2.0, wide + 0.2);
  const double y = 0.5 * wide + 0.1;
  return finished("goal behind", std::move(world), footprint, {12.0 * r + 1.0, y, 0.0},
                  {4.0 * r, y, kPi});
}

Drive drive(Controller& controller, const ControlSetup& setup, const Scene& scene, double limit_s,
            const Path& path, std::size_t late_periods) {
  Drive result;
  const CostGrid grid = scene.world.grid();
  const FootprintChecker body(setup.footprint);
  const Path plan = path.empty()
                        ? plan_on(grid, scene.start, scene.goal, setup.footprint.inscribed_radius)
                        : path;
  RobotState state{scene.start, {}, 0.0};
  Twist2 last;
  std::vector<Twist2> twists;
  while (state.time_s < limit_s && !result.is_reached && !result.has_contact) {
    twists.push_back(state.twist);
    RobotState measured = state;
    measured.twist = twists[twists.size() - 1 - std::min(late_periods, twists.size() - 1)];
    const CommandOutcome outcome = controller.command(measured, plan, grid, {});
    judge_acceleration(setup.limits, last, outcome.twist, setup.period_s, &result);
    last = outcome.twist;
    result.is_reached = outcome.goal_reached;
    if (outcome.failure != Failure::kNone) {
      ++result.failures;
      result.last_reason = outcome.reason;
    }
    result.commands.push_back(outcome.twist);
    result.track.push_back(state.pose);
    result.has_contact = !follow_command(setup, body, grid, outcome.twist, &state);
  }
  result.time_s = state.time_s;
  result.position_error_m = distance(state.pose.x, state.pose.y, plan.back().x, plan.back().y);
  result.heading_error_rad = std::fabs(wrap_angle(state.pose.yaw - plan.back().yaw));
  return result;
}

ControlSetup burger() {
  ControlSetup setup;
  setup.limits = {0.22, -0.22, 0.0, 2.75, 2.5, 2.5, 0.0, 3.2, 0.0};
  setup.footprint = circle_footprint(0.105);
  setup.tolerance.xy_goal_tolerance = 0.05;
  setup.tolerance.yaw_goal_tolerance = 0.17;
  return setup;
}

ControlSetup jackal() {
  ControlSetup setup;
  setup.limits = {2.0, -0.5, 0.0, 4.0, 4.0, 4.0, 0.0, 8.0, 0.0};
  setup.footprint =
      polygon_footprint({{-0.21, -0.165}, {0.21, -0.165}, {0.21, 0.165}, {-0.21, 0.165}});
  return setup;
}

ControlSetup car() {
  ControlSetup setup;
  setup.limits = {1.0, -0.5, 0.0, 2.0, 1.5, 2.0, 0.0, 4.0, 0.5};
  setup.footprint = polygon_footprint({{-0.1, -0.15}, {0.4, -0.15}, {0.4, 0.15}, {-0.1, 0.15}});
  return setup;
}

ControlSetup omni_robot() {
  ControlSetup setup;
  setup.limits = {0.6, -0.6, 0.6, 1.5, 1.5, 1.5, 1.5, 3.0, 0.0};
  setup.footprint = polygon_footprint({{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}});
  return setup;
}

bool are_equal(const Twist2& a, const Twist2& b) {
  return a.vx == b.vx && a.vy == b.vy && a.wz == b.wz;
}

bool are_equal(const Drive& a, const Drive& b) {
  return std::equal(a.commands.begin(), a.commands.end(), b.commands.begin(), b.commands.end(),
                    [](const Twist2& x, const Twist2& y) { return are_equal(x, y); });
}

}  // namespace trident::nav::testing
