// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"

namespace trident::maps {

/// The distance from each cell of a map to the nearest obstacle, for points in the **grid frame**:
/// that of `T_map_origin`, metres from the corner of cell (0, 0). Single precision is enough there,
/// however far from the map's origin the grid lies.
class DistanceField {
 public:
  /// Which cells distances are measured to: for beams unknown cells stop, too.
  enum class Obstacles { kOccupied, kOccupiedOrUnknown };

  /// Distances between centres of cells, exact (Felzenszwalb, Huttenlocher, 2012), cut to
  /// `max_distance` [m].
  DistanceField(const OccupancyGrid& grid, double max_distance,
                Obstacles obstacles = Obstacles::kOccupied);

  int width() const { return width_; }                   ///< cells, without the border
  int height() const { return height_; }                 ///< cells, without the border
  double resolution() const { return resolution_; }      ///< side of a cell [m]
  double max_distance() const { return max_distance_; }  ///< what distances are cut to [m]

  /// Distances [m] in rows of `stride()` cells with one more cell all around the map, which holds
  /// `max_distance`: cell (column, row) is at (row + 1) * stride + column + 1.
  const std::vector<float>& padded() const { return padded_; }
  int stride() const { return width_ + 2; }  ///< of padded() [cells]

  /// The distance at a point in the grid frame [m].
  float at(float x, float y) const;

  /// How far a beam from `p_grid` along `angle` gets to the first obstacle [m]; `max_range` when it
  /// hits nothing in the map.
  double ray(const Eigen::Vector2d& p_grid, double angle, double max_range) const;

 private:
  int width_, height_;
  double resolution_, max_distance_;
  float cells_per_m_;
  std::vector<float> padded_;
};

/// The ends of a scan's beams in the robot's frame, and where they began.
struct ScanPoints {
  Eigen::Vector2d p_base_laser = Eigen::Vector2d::Zero();  ///< [m]
  std::vector<Eigen::Vector2f> p_base;                     ///< ends of beams [m]
};

/// The cells of a map that were seen, in the grid frame of DistanceField.
class KnownSpace {
 public:
  /// Copies what is needed of `grid`.
  explicit KnownSpace(const OccupancyGrid& grid);

  /// Whether a point lies in a cell that is free or occupied; false outside of the map.
  bool contains(float x, float y) const;

 private:
  int width_, height_;
  float cells_per_m_;
  std::vector<bool> is_known_;  ///< in rows of `width_` cells
};

/// The fraction of the beams, 0 ... 1, that the map explains from a pose: the beam is free to
/// within 0.3 m of the beam's end, and something is within 0.3 m of that end.
double scan_agreement(const DistanceField& field, const ScanPoints& points, const SE2& T_grid_base);

/// The same among the beams that the map can judge: one that ends in unknown space, past nothing
/// that it knows, speaks neither for nor against the pose. Half of the beams at least are taken to
/// be judged, so that a pose that looks into the unknown alone explains nothing.
double scan_agreement(const DistanceField& field, const KnownSpace& known, const ScanPoints& points,
                      const SE2& T_grid_base);

}  // namespace trident::maps
