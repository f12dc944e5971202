// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"
#include "trident_nav/core/shape_cells.h"

namespace trident::nav {

/// What a footprint at a pose overlaps, from the best to the worst.
enum class Contact {
  kFree,
  kUnknown,  ///< It lies on unknown cells, but on no lethal one.
  kOutside,  ///< A part of it lies outside of the grid.
  kLethal,   ///< It overlaps a lethal cell.
};

/// Checks poses of a footprint against a costmap, exactly: a footprint touches a cell that its
/// inside overlaps, those in its middle included. Most poses need one look-up of the distance field
/// (footprints are free of lethal cells farther away than their circumscribed radius, and not free
/// of those nearer than the inscribed one); others a few more, for discs that together cover it;
/// what is still open then, the cells decide. One checker per thread.
class FootprintChecker {
 public:
  /// `grid` stays valid while the checker is used.
  FootprintChecker(const CostGrid& grid, const Footprint& footprint);

  /// Lethal cells alone, by far the fastest: true when the footprint overlaps one, or has its
  /// center outside of the grid.
  bool is_in_contact(const Pose2& pose);
  Contact contact(const Pose2& pose);
  /// The highest cost of the cells under the footprint where unknown counts as lower than lethal
  /// and higher than all others; kLethalCost outside of the grid, too.
  std::uint8_t cost(const Pose2& pose);

  /// How far the center lies from the center of the nearest lethal cell, at least [m]: 0 outside of
  /// the grid, and where the costmap keeps no distances. Interpolates nothing.
  double distance_at_least(const Point2& p) const;

 private:
  /// What is known of a pose from the distance field.
  enum class Verdict { kFree, kLethal, kOpen };
  Verdict look_up(const Pose2& pose) const;
  void cover_footprint();
  bool is_cover_free(const Pose2& pose) const;
  bool is_inside(const CellRun& run) const {
    return run.y >= 0 && run.y < grid_.geometry.height && run.x0 >= 0 &&
           run.x1 <= grid_.geometry.width;
  }

  CostGrid grid_;
  Footprint footprint_;
  double half_diagonal_m_;     // of a cell
  std::vector<Point2> discs_;  // centers of discs that cover the footprint, in its axes
  double disc_radius_m_ = 0.0;
  ShapeCells shape_;
};

}  // namespace trident::nav
