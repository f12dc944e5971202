// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "footprint_distance.h"
#include "teb_band.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/footprint_checker.h"

namespace trident::nav {

/// A rectangle of the costmap's frame [m].
struct TebRegion {
  Point2 lo, hi;

  void include(const Point2& point, double margin_m);
};

/// The occupied cells that a band may come near to, as discs about their centers.
struct TebObstacles {
  std::vector<Point2> centers;  ///< Of cells that a free one is next to.
  double radius_m = 0.0;        ///< Of the circle around a cell.
};

/// Those in a region. `unknown`: what cells of which nothing is known are.
TebObstacles collect_obstacles(const CostGrid& grid, const TebRegion& region, UnknownCells unknown);

/// What a corner of the footprint shall keep away from: the half plane behind the point of an
/// obstacle that is nearest, square to the direction in which it is. Along a wall that is the same
/// for all of its cells, so that nothing is gained by sliding from one to the next.
struct TebPlane {
  Point2 corner;         ///< In the base's axes.
  Point2 direction;      ///< To the obstacle, in the costmap's axes, of length 1.
  double reach_m = 0.0;  ///< Of the plane from the costmap's origin in that direction.
};

/// Of a pose of a band, the planes of the obstacle that is nearest in each octant about the base:
/// two each, for the corners of the footprint that are nearest to it.
struct TebNeighbors {
  std::array<TebPlane, 16> planes;
  std::size_t count = 0;
  double clearance_m = 0.0;  ///< To the nearest obstacle; infinite without one.
};

/// The neighbors of each pose of a band within `cutoff_m` of its footprint.
std::vector<TebNeighbors> find_neighbors(const TebBand& band, const FootprintDistance& footprint,
                                         const TebObstacles& obstacles, double cutoff_m);

}  // namespace trident::nav
