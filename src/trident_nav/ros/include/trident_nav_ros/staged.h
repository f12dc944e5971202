// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "trident_base/mutex.h"
#include "trident_nav/control/controller.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

/// What one thread makes and another one takes over when it likes.
template <class T>
class Staged {
 public:
  void stage(std::unique_ptr<T> next) {
    const Lock lock(mutex_);
    next_ = std::move(next);
  }
  /// nullptr: nothing new.
  std::unique_ptr<T> take() {
    const Lock lock(mutex_);
    return std::move(next_);
  }

 private:
  Mutex mutex_;
  std::unique_ptr<T> next_ TRIDENT_GUARDED_BY(mutex_);
};

/// A controller that any thread may replace: from the next command on, the thread that commands
/// uses the newest one, which begins with the motion that is measured.
class StagedController final : public Controller {
 public:
  explicit StagedController(std::unique_ptr<Controller> first) : current_(std::move(first)) {}

  void stage(std::unique_ptr<Controller> next) { staged_.stage(std::move(next)); }
  CommandOutcome command(const RobotState& state, const Path& path, const CostGrid& grid,
                         const Tracks& tracks) override {
    return newest().command(state, path, grid, tracks);
  }
  void reset() override { newest().reset(); }
  void set_watched(const WatchedDetails& watched) override { newest().set_watched(watched); }
  ControlDetails details() const override { return current_->details(); }
  void set_via_points(const std::optional<std::vector<Point2>>& points) override {
    newest().set_via_points(points);
  }

 private:
  Controller& newest() {
    if (auto next = staged_.take()) current_ = std::move(next);
    return *current_;
  }

  std::unique_ptr<Controller> current_;
  Staged<Controller> staged_;
};

/// A planner that any thread may replace: the next plan is the newest one's.
class StagedPlanner final : public Planner {
 public:
  explicit StagedPlanner(std::unique_ptr<Planner> first) : current_(std::move(first)) {}

  void stage(std::unique_ptr<Planner> next) { staged_.stage(std::move(next)); }
  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel) override {
    if (auto next = staged_.take()) current_ = std::move(next);
    return current_->plan(grid, footprint, start, goal, limits, cancel);
  }
  /// The potential of the planner of the last plan; nullptr: it has none.
  const PotentialSource* potential_source() const {
    return dynamic_cast<const PotentialSource*>(current_.get());
  }

 private:
  std::unique_ptr<Planner> current_;
  Staged<Planner> staged_;
};

}  // namespace trident::nav
