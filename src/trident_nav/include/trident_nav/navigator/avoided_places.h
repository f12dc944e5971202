// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

/// Places at which a robot got stuck, in the global costmap's frame, and plans that lead around
/// them: a planner that sees a circle where the robot is a rectangle, or rounds to cells, finds the
/// same gap again and again through which the robot cannot be driven. Not thread-safe.
class AvoidedPlaces {
 public:
  /// The tightest place of the part of a path that lies ahead of a robot at its first pose. Without
  /// obstacles near the path nothing is added.
  void add(const CostGrid& grid, const Footprint& footprint, const Path& ahead);
  void clear() { places_.clear(); }
  bool is_empty() const { return places_.empty(); }

  /// A plan around all places; where that fails, one through them, which forgets them.
  PlanOutcome plan(Planner& planner, const CostGrid& grid, const Footprint& footprint,
                   const Pose2& start, const Pose2& goal, const MotionLimits& limits,
                   const CancelFlag& cancel);

 private:
  struct Disc {
    Point2 center;
    double radius_m = 0.0;
  };

  /// The costs with the places in them, and what they were made of.
  struct Copy {
    std::vector<std::uint8_t> cost;
    std::vector<std::size_t> blocked;  ///< Cells that differ from the source.
    const std::uint8_t* source = nullptr;
    GridGeometry geometry;
    std::uint64_t source_revision = 0;  ///< 0: of a grid that has none, and not kept.
    std::uint64_t revision = 0;         ///< Of the copy.
  };

  static std::optional<Disc> tightest(const CostGrid& grid, const Path& ahead, double radius_m);
  static bool stays_open(const Disc& disc, const Pose2& start, const Point2& p);
  bool is_kept(const CostGrid& grid) const;
  void follow(const CostGrid& grid, const Pose2& start);
  void block(const Disc& disc, const Pose2& start);

  std::vector<Disc> places_;
  Copy copy_;
};

}  // namespace trident::nav
