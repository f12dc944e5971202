// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trident_nav/core/geometry.h"
#include "trident_nav/core/outcome.h"
#include "trident_nav/costmap/layer.h"

namespace trident::nav {

/// Which costmaps a recovery clears.
enum class AffectedMaps { kBoth, kGlobal, kLocal };

/// A square about the robot, and which side of it is meant.
struct ClearedArea {
  double side_m = 0.0;
  Layer::Side side = Layer::Side::kOutside;
  AffectedMaps maps = AffectedMaps::kBoth;
  std::vector<std::string> layers;  ///< Empty: all that hold what sensors saw.
};

/// What a navigator acts on: the planner with its costmap, and what recoveries change. Calls come
/// from the thread that steps the navigator.
class NavigatorWorld {
 public:
  NavigatorWorld() = default;
  NavigatorWorld(const NavigatorWorld&) = delete;
  NavigatorWorld& operator=(const NavigatorWorld&) = delete;
  virtual ~NavigatorWorld() = default;

  /// Begins to plan from the robot to a goal in the global costmap's frame; may end later. A
  /// request while another is in progress replaces it.
  virtual void request_plan(const Pose2& start, const Pose2& goal) = 0;
  /// The outcome of the latest request, once.
  virtual std::optional<PlanOutcome> take_plan() = 0;
  virtual void cancel_plan() = 0;
  /// What a path costs on the global costmap: its length [m] weighted by 1 + cost / 252; infinite
  /// where it is blocked. Poses before `first` do not count.
  virtual double path_cost(const Path& path, std::size_t first) = 0;

  /// The robot got stuck on the path that begins at the first of these poses, in the global
  /// costmap's frame: further plans lead around its tightest place where they can. No poses: all
  /// such places are forgotten.
  virtual void avoid(const Path& /*ahead*/) {}

  /// Lets layers forget what they sensed. The next updates bring back what is still seen, so that
  /// only what is stale goes.
  virtual void forget(const ClearedArea& area) = 0;
  /// Sources that are too old to drive on.
  virtual std::vector<StaleSource> stale_sources(double now_s) = 0;
  /// Where the obstacle nearest to a place of the local costmap is, and which layer with which
  /// sources has it, as a whole sentence; empty when none is near.
  virtual std::string obstacle_text(const Pose2& robot_local) = 0;
};

}  // namespace trident::nav
