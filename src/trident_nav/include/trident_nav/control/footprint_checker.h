// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

enum class UnknownCells { kFree, kOccupied };

/// Whether a robot has room at a pose. Calls change nothing and may come from several threads.
class FootprintChecker {
 public:
  FootprintChecker() = default;
  FootprintChecker(const FootprintChecker&) = delete;
  FootprintChecker& operator=(const FootprintChecker&) = delete;
  virtual ~FootprintChecker() = default;

  virtual const Footprint& footprint() const = 0;
  /// True where no occupied cell touches the footprint, the inside included. Cells outside of the
  /// grid count as unknown ones.
  virtual bool is_free(const CostGrid& grid, const Pose2& pose) const = 0;
};

/// Exact: the squares of occupied cells against the polygon (or the circle). A look at the distance
/// field decides the poses that are far from everything, and those whose inscribed circle is hit.
class PolygonFootprintChecker final : public FootprintChecker {
 public:
  explicit PolygonFootprintChecker(Footprint footprint, UnknownCells unknown = UnknownCells::kFree);

  const Footprint& footprint() const override { return footprint_; }
  bool is_free(const CostGrid& grid, const Pose2& pose) const override;

 private:
  enum class Verdict { kFree, kContact, kUnclear };
  Verdict by_distance(const CostGrid& grid, const Pose2& pose) const;
  bool is_occupied(const CostGrid& grid, Cell cell) const;
  bool touches(const std::vector<Point2>& polygon, const Pose2& pose, const CostGrid& grid,
               Cell cell) const;

  Footprint footprint_;
  UnknownCells unknown_;
};

/// The footprint of a polygon, with its two circles; the points come in either sense. Throws Error
/// for fewer than three points, a point that is not finite, edges that cross, or a polygon without
/// the base's origin inside.
Footprint make_polygon_footprint(std::vector<Point2> points);

/// A footprint whose edges are moved outwards by `padding_m`.
Footprint padded(const Footprint& footprint, double padding_m);

/// True for a point inside of a polygon.
bool contains(const std::vector<Point2>& polygon, const Point2& point);

/// The footprint of a round robot. Throws Error unless the radius is positive and finite.
Footprint make_circle_footprint(double radius_m);

}  // namespace trident::nav
