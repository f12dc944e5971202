// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// How far a point is from a shape's rim, and where the distance grows fastest.
struct SignedDistance {
  double distance_m = 0.0;  ///< Negative inside.
  Point2 direction;         ///< Of length 1, in the base's axes.
};

/// Distances of points from a footprint, exactly: polygons with all their edges, circles.
class FootprintDistance {
 public:
  explicit FootprintDistance(const Footprint& footprint);

  /// Of a point in the base's axes [m].
  SignedDistance to(const Point2& point) const;
  /// Of the polygon, in the base's axes; empty: a circle.
  const std::vector<Point2>& corners() const { return corners_; }
  /// No point nearer to the base's origin is farther from the footprint than the difference [m].
  double reach_m() const { return reach_m_; }

 private:
  struct Edge {
    Point2 start, along;  ///< `along` has length 1.
    double length_m = 0.0;
  };

  bool contains(const Point2& point) const;

  std::vector<Point2> corners_;
  std::vector<Edge> edges_;  ///< Counter-clockwise; empty: a circle.
  double reach_m_;
};

}  // namespace trident::nav
