// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "planning/curves/footprint_contact.h"
#include "planning/curves/motion_curve.h"
#include "planning/curves/motion_set.h"
#include "planning/grids/travel_costs.h"
#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// A path as the robot travels it.
struct TravelPath {
  struct Point {
    Pose2 pose;          ///< In cells.
    bool turns = false;  ///< How the robot comes to the pose.
    bool reverses = false;
  };
  std::vector<Point> points;
};

/// Whether motions are free of contact, and what they cost. Poses in cells of the grid, from its
/// origin.
class CurveChecker {
 public:
  /// Poses are checked at most this far apart [m], and lie at most a cell apart in paths.
  static constexpr double kCheckSpacing = 0.01;

  CurveChecker(const CostGrid& grid, const FootprintContact& contact, const TravelCosts& costs)
      : grid_(grid), contact_(contact), costs_(costs) {}

  const CostGrid& grid() const { return grid_; }
  bool is_free(const Pose2& pose) const { return !contact_.in_contact(to_metric(pose)); }
  /// Whether the poses of a motion are all free; they are offsets from `from`, turned by an angle
  /// of which `cos` and `sin` are given.
  bool is_free(const Pose2& from, const Pose2* poses, std::size_t count, double cos,
               double sin) const;
  bool is_free(const MotionCurve& curve, const Pose2& from) const;
  /// The cost of a curve; infinite where it leaves the grid or a cell's cost is above `max_cost`.
  double cost(const MotionCurve& curve, const Pose2& from, int max_cost) const;
  /// The cost of a point of a path from the one before.
  double cost(const Pose2& from, const TravelPath::Point& to) const;
  /// Adds the points of a curve from the path's last one.
  void append(const MotionCurve& curve, TravelPath& path) const;

  Pose2 to_metric(const Pose2& cells) const {
    const GridGeometry& g = grid_.geometry;
    return {g.origin_x + cells.x * g.resolution, g.origin_y + cells.y * g.resolution, cells.yaw};
  }

 private:
  CostGrid grid_;
  const FootprintContact& contact_;
  TravelCosts costs_;
};

}  // namespace trident::nav
