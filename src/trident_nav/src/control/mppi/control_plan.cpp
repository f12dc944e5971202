// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "control_plan.h"

#include <algorithm>
#include <cmath>

#include "trident_nav/control/motion.h"

namespace trident::nav {
namespace {

Twist2 mixed(const Twist2& a, const Twist2& b, double t) {
  return {a.vx + t * (b.vx - a.vx), a.vy + t * (b.vy - a.vy), a.wz + t * (b.wz - a.wz)};
}

}  // namespace

Twist2 plan_at(const ControlPlan& plan, const Twist2& start, double dt_s, double after_s) {
  const double place = std::max(after_s / dt_s, 0.0);
  const auto before = static_cast<std::size_t>(place);
  if (before >= plan.size()) return plan.back();
  const Twist2& from = before == 0 ? start : plan[before - 1];
  return mixed(from, plan[before], place - static_cast<double>(before));
}

ControlPlan shifted(const ControlPlan& plan, double dt_s, double elapsed_s) {
  ControlPlan next;
  next.reserve(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    next.push_back(
        plan_at(plan, plan.front(), dt_s, elapsed_s + dt_s * static_cast<double>(i + 1)));
  }
  return next;
}

ConsideredTrajectory trajectory_of(const ControlPlan& plan, const Pose2& start, double dt_s,
                                   std::size_t every) {
  ConsideredTrajectory trajectory;
  Pose2 pose = start;
  trajectory.points.push_back({0.0, pose, plan.empty() ? Twist2{} : plan.front()});
  for (std::size_t i = 0; i < plan.size(); ++i) {
    pose = integrate(pose, plan[i], dt_s);
    const bool is_last = i + 1 == plan.size();
    if ((i + 1) % every != 0 && !is_last) continue;
    const Twist2& next = is_last ? plan[i] : plan[i + 1];
    trajectory.points.push_back({dt_s * static_cast<double>(i + 1), pose, next});
  }
  return trajectory;
}

void write_lane(const ControlPlan& plan, int lane, Rollouts* rollouts) {
  for (int step = 0; step < rollouts->steps; ++step) {
    const Twist2& twist = plan[static_cast<std::size_t>(step)];
    rollouts->at(rollouts->vx, step)[lane] = static_cast<float>(twist.vx);
    rollouts->at(rollouts->vy, step)[lane] = static_cast<float>(twist.vy);
    rollouts->at(rollouts->wz, step)[lane] = static_cast<float>(twist.wz);
  }
}

ControlPlan read_lane(const Rollouts& rollouts, int lane) {
  ControlPlan plan;
  plan.reserve(static_cast<std::size_t>(rollouts.steps));
  for (int step = 0; step < rollouts.steps; ++step) {
    plan.push_back({static_cast<double>(rollouts.at(rollouts.vx, step)[lane]),
                    static_cast<double>(rollouts.at(rollouts.vy, step)[lane]),
                    static_cast<double>(rollouts.at(rollouts.wz, step)[lane])});
  }
  return plan;
}

}  // namespace trident::nav
