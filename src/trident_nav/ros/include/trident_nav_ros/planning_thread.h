// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "trident_nav/costmap/source_age.h"
#include "trident_nav/navigator/costmap_world.h"
#include "trident_nav/planning/planner.h"
#include "trident_nav_ros/costmap_node.h"

namespace trident::nav {

/// A world whose plans are made in a thread of their own, each on the global costmap as it then is.
class PlanningThread : public NavigatorWorld {
 public:
  /// What is referred to outlives it.
  PlanningThread(CostmapNode& global, CostmapNode& local, Planner& planner,
                 const MotionLimits& limits);
  ~PlanningThread() override;

  /// A plan at once, in the calling thread.
  PlanOutcome plan_now(const Pose2& start, const Pose2& goal);
  void set_robot(const Pose2& in_global, const Pose2& in_local) { robot_ = {in_global, in_local}; }
  /// Odometry came, stamped so [s].
  void note_odometry(double stamp_s);
  /// Plans are made within request_plan(), so that the same step takes them in each run.
  void plan_at_once() { plans_at_once_ = true; }
  /// Called after each plan with the grid that it was made on, while the planner is not used. To
  /// be taken away (an empty one) before what it refers to ends.
  void set_plan_listener(std::function<void(const GridGeometry& geometry)> listener);
  /// From the next plan on; from any thread.
  void set_limits(const MotionLimits& limits);
  void set_odometry_topic(const std::string& topic) { odometry_.topic = topic; }

  void request_plan(const Pose2& start, const Pose2& goal) override;
  std::optional<PlanOutcome> take_plan() override;
  void cancel_plan() override;
  double path_cost(const Path& path, std::size_t first) override;
  void avoid(const Path& ahead) override;
  void forget(const ClearedArea& area) override;
  /// The local costmap must be locked by the caller, as in obstacle_text() and forget().
  std::vector<StaleSource> stale_sources(double now_s) override;
  std::string obstacle_text(const Pose2& robot_local) override;

 private:
  struct Request {
    Pose2 start, goal;
  };
  void run();

  CostmapNode& global_;
  CostmapNode& local_;
  Planner& planner_;
  /// Where it is; of the thread that steps the navigator.
  struct Robot {
    Pose2 in_global, in_local;
  };
  Robot robot_;
  bool plans_at_once_ = false;

  std::mutex planner_mutex_;  // guards planner_ and planning_
  /// What a plan is made with.
  struct Planning {
    MotionLimits limits;
    std::function<void(const GridGeometry& geometry)> on_plan;
    AvoidedPlaces avoided;
  };
  Planning planning_;
  CancelFlag cancel_{false};
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  /// The latest plan that was asked for: waiting, or made and not taken.
  struct Order {
    std::optional<Request> request;
    std::optional<PlanOutcome> outcome;
    bool is_last = false;  ///< The thread ends.
  };
  Order order_;
  struct Odometry {
    std::string topic;
    SourceAge age;
  };
  Odometry odometry_;
  std::thread thread_;
};

}  // namespace trident::nav
