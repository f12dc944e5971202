// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/planning_thread.h"

#include <utility>

namespace trident::nav {
namespace {

constexpr double kObstacleReach_m = 2.0;

}  // namespace

PlanningThread::PlanningThread(CostmapNode& global, CostmapNode& local, Planner& planner,
                               const MotionLimits& limits)
    : global_(global), local_(local), planner_(planner), planning_{limits, {}, {}}, thread_([this] {
        run();
      }) {}

void PlanningThread::set_limits(const MotionLimits& limits) {
  const std::lock_guard lock(planner_mutex_);
  planning_.limits = limits;
}

void PlanningThread::set_plan_listener(std::function<void(const GridGeometry& geometry)> listener) {
  const std::lock_guard lock(planner_mutex_);
  planning_.on_plan = std::move(listener);
}

PlanningThread::~PlanningThread() {
  {
    const std::lock_guard lock(mutex_);
    order_.is_last = true;
    cancel_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

PlanOutcome PlanningThread::plan_now(const Pose2& start, const Pose2& goal) {
  const std::lock_guard planning(planner_mutex_);
  const auto lock = global_.lock();
  const CancelFlag never{false};
  const Costmap& costmap = global_.costmap();
  PlanOutcome outcome =
      planner_.plan(costmap.grid(), costmap.footprint(), start, goal, planning_.limits, never);
  if (planning_.on_plan) planning_.on_plan(costmap.grid().geometry);
  return outcome;
}

void PlanningThread::run() {
  std::unique_lock lock(mutex_);
  while (!order_.is_last) {
    if (!order_.request) {
      changed_.wait(lock);
      continue;
    }
    const Request request = *std::exchange(order_.request, std::nullopt);
    cancel_ = false;
    lock.unlock();
    PlanOutcome outcome;
    {
      const std::lock_guard planning(planner_mutex_);
      const auto costs = global_.lock();
      const Costmap& costmap = global_.costmap();
      outcome = planning_.avoided.plan(planner_, costmap.grid(), costmap.footprint(), request.start,
                                       request.goal, planning_.limits, cancel_);
      if (planning_.on_plan) planning_.on_plan(costmap.grid().geometry);
    }
    lock.lock();
    if (!cancel_) order_.outcome = std::move(outcome);
  }
}

void PlanningThread::request_plan(const Pose2& start, const Pose2& goal) {
  if (plans_at_once_) {
    PlanOutcome outcome = plan_now(start, goal);
    const std::lock_guard lock(mutex_);
    order_.outcome = std::move(outcome);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    order_.outcome.reset();
    order_.request = Request{start, goal};
    cancel_ = true;  // of the one in progress
  }
  changed_.notify_all();
}

std::optional<PlanOutcome> PlanningThread::take_plan() {
  const std::lock_guard lock(mutex_);
  return std::exchange(order_.outcome, std::nullopt);
}

void PlanningThread::cancel_plan() {
  const std::lock_guard lock(mutex_);
  order_.request.reset();
  order_.outcome.reset();
  cancel_ = true;
}

double PlanningThread::path_cost(const Path& path, std::size_t first) {
  const auto lock = global_.lock();
  return path_cost_on(global_.costmap().grid(), path, first);
}

void PlanningThread::avoid(const Path& ahead) {
  const std::lock_guard planning(planner_mutex_);
  const auto lock = global_.lock();
  if (ahead.empty()) planning_.avoided.clear();
  planning_.avoided.add(global_.costmap().grid(), global_.costmap().footprint(), ahead);
}

void PlanningThread::forget(const ClearedArea& area) {
  if (area.maps != AffectedMaps::kGlobal) forget_area(local_.costmap(), robot_.in_local, area);
  if (area.maps == AffectedMaps::kLocal) return;
  const auto lock = global_.lock();
  forget_area(global_.costmap(), robot_.in_global, area);
}

void PlanningThread::note_odometry(double stamp_s) {
  const std::lock_guard lock(mutex_);
  odometry_.age.note(stamp_s);
}

std::vector<StaleSource> PlanningThread::stale_sources(double now_s) {
  std::vector<StaleSource> stale = local_.costmap().stale_sources(now_s);
  const std::lock_guard lock(mutex_);
  if (!odometry_.age.has_data() || odometry_.age.is_stale(now_s)) {
    stale.push_back({"local planner", "odometry", odometry_.topic, odometry_.age.age_s(now_s),
                     odometry_.age.limit_s()});
  }
  return stale;
}

std::string PlanningThread::obstacle_text(const Pose2& robot_local) {
  return nearest_obstacle_text(local_.costmap(), robot_local, kObstacleReach_m);
}

}  // namespace trident::nav
