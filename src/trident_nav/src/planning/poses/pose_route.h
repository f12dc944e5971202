// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planning/curves/motion_set.h"
#include "planning/curves/path_shortcuts.h"
#include "planning/grids/step_costs.h"
#include "planning/poses/goal_probe.h"
#include "planning/poses/obstacle_heuristic.h"
#include "planning/poses/pose_search.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// What a planner over poses is made of; lengths in cells but for the tolerance.
struct PoseRouteOptions {
  TravelCosts costs;
  PoseSearchOptions search;
  ObstacleHeuristic::Options heuristic;
  std::optional<ShortcutOptions> shortcuts;  ///< Absent: paths stay as they were found.
  double tolerance_m = 0.25;
  std::int64_t max_iterations = 1000000;  ///< Of the last search; negative: no limit.
  double max_time_s = 2.0;
};

/// Plans over poses with one set of motions on grids of one resolution: checks the request, leaves
/// a blocked start, finds a free goal within the tolerance, searches and smooths.
class PoseRoute {
 public:
  PoseRoute(MotionSet motions, const PoseRouteOptions& options);

  PlanOutcome plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                   const Pose2& goal, const CancelFlag& cancel);
  /// Poses that the searches of the last plan came to.
  std::size_t iterations() const { return iterations_; }

 private:
  /// One request, and what is known of it.
  struct Request {
    CostGrid grid;
    Pose2 start, goal;  ///< In the grid's frame [m].
    Pose2 end;          ///< The goal, or the one that stands for it.
    const CancelFlag& cancel;
    PlanOutcome outcome;
    PoseSearch::Query query;
    Cell exit;  ///< Where blocked cells at the start are left; else its own.
  };

  Footprint checked_footprint(const Footprint& footprint, double resolution) const;
  static void allow_start(Request& request, FootprintContact& contact);
  bool leave_start(Request& request, FootprintContact& contact, double reach_m) const;
  bool is_cut_off(Cell cell, const std::optional<Cell>& cut_off);
  bool can_enter(const CurveChecker& checker, const Pose2& goal);
  bool find_goal(Request& request, const FootprintContact& contact, const CurveChecker& checker);
  std::vector<Pose2> goal_places(const Request& request) const;
  std::vector<Pose2> free_goals(const Request& request, const FootprintContact& contact) const;
  std::optional<TravelPath> out_of_slot(const CurveChecker& checker, const Pose2& goal) const;
  void explain_goal(Request& request, bool is_occupied, bool can_enter) const;
  void accept_near(Request& request) const;
  bool aim(Request& request, const Pose2& goal);
  void search(Request& request, const CurveChecker& checker);
  PoseSearch::Result first_search(Request& request);
  bool search_by_approach(Request& request, TravelPath& path);
  PoseSearch::Result last_search(Request& request);
  PoseSearch::Result search_further(Request& request, PoseSearch::Result first, TravelPath& path);
  void take_found(Request& request, TravelPath& path) const;
  PoseSearch::Result run(Request& request, TravelPath& path);
  std::optional<TravelPath> find_approach(Request& request);
  bool enter_slot(Request& request, TravelPath& path);
  bool leave_slot(Request& request, TravelPath& path);
  void place_start(PoseSearch::Query& query, const Pose2& start) const;
  bool join_approach(Request& request, const TravelPath& approach, TravelPath& path);
  void use(Request& request, TravelPath path, const CurveChecker& checker) const;
  void use_nearest(Request& request, PoseSearch::Result result, const CurveChecker& checker) const;

  MotionSet motions_, reversed_;
  PoseRouteOptions options_;
  StepCosts open_cells_;  ///< Which cells the base may be in.
  ObstacleHeuristic heuristic_;
  ObstacleHeuristic gate_heuristic_;  ///< To where approaches begin.
  PoseSearch search_, approach_search_;
  GoalProbe probe_;
  std::size_t iterations_ = 0;
};

}  // namespace trident::nav
