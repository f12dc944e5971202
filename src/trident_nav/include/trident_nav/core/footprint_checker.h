// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"
#include "trident_nav/core/shape_cells.h"

namespace trident::nav {

/// What a footprint at a pose meets, from the best to the worst.
enum class Contact {
  kFree,
  kUnknown,  ///< It lies on unknown cells, but on no lethal one.
  kOutside,  ///< A part of it lies outside of the grid.
  kLethal,   ///< It overlaps a lethal cell.
};

/// What is_free() makes of cells of which nothing is known.
enum class UnknownCells { kFree, kOccupied };

/// Checks poses of a footprint against costmaps, exactly: a footprint touches a cell that its
/// inside overlaps, those in its middle included. Most poses need one look-up of the distance field
/// (footprints are free of lethal cells farther away than their circumscribed radius, and not free
/// of those nearer than the inscribed one); others a few more, for discs that together cover it;
/// what is still open then is told by the cells. Calls change nothing and may come from several
/// threads.
class FootprintChecker {
 public:
  explicit FootprintChecker(const Footprint& footprint, UnknownCells unknown = UnknownCells::kFree);

  const Footprint& footprint() const { return footprint_; }

  /// True when the footprint overlaps no occupied cell, by far the fastest where unknown cells are
  /// free. Cells outside of the grid count as unknown ones.
  bool is_free(const CostGrid& grid, const Pose2& pose) const;
  /// The worst that the footprint meets; kOutside where its center is outside of the grid.
  Contact contact(const CostGrid& grid, const Pose2& pose) const;
  /// The highest cost of the cells under the footprint where unknown counts as lower than lethal
  /// and higher than all others; kLethalCost outside of the grid, too.
  std::uint8_t cost(const CostGrid& grid, const Pose2& pose) const;

 private:
  /// What the distance field tells about a pose.
  enum class Verdict { kFree, kLethal, kOpen };
  Verdict look_up(const CostGrid& grid, const Pose2& pose) const;
  void cover_footprint();
  bool is_cover_free(const CostGrid& grid, const Pose2& pose) const;
  bool is_run_free(const CostGrid& grid, const CellRun& run) const;

  Footprint footprint_;
  UnknownCells unknown_;
  std::vector<Point2> discs_;  // centers of discs that cover the footprint, in its axes
  double disc_radius_m_ = 0.0;
};

/// How far a point lies from the center of the nearest lethal cell, at least [m]: 0 outside of the
/// grid, and where the costmap keeps no distances. Interpolates nothing.
double distance_at_least(const CostGrid& grid, const Point2& p);

}  // namespace trident::nav
