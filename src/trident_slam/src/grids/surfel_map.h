// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "growing_grid.h"
#include "trident_base/se2.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {

/// A small piece of surface: the mean of the points, and of their normals, that fell into one cell.
struct Surfel {
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();    ///< in the map's frame [m]
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();  ///< length 1 or 0
  Eigen::Vector2f normal_sum = Eigen::Vector2f::Zero();
  float count = 0.0F;
  std::int32_t next = 0;   ///< another surfel of the same cell, 1 + index, 0: none
  std::int32_t owner = 0;  ///< who saw it first

  bool has_normal() const { return normal.x() != 0.0F || normal.y() != 0.0F; }
};

/// A map of surfels. Both faces of a thin wall keep surfels of their own, distinguished by where
/// they were seen from. Owners can be hidden: their surfels are then neither found nor added to.
class SurfelMap {
 public:
  /// Surfels are found in cells up to so many cells away.
  static constexpr int kMaxRings = 3;

  explicit SurfelMap(double cell = 0.1) : cell_(cell), per_meter_(static_cast<float>(1.0 / cell)) {}

  void insert(const SE2& T_map_base, const PointScan& scan, int owner = 0);
  void clear();

  /// One entry per owner; owners beyond its end are shown.
  void set_hidden(std::vector<char> hidden) { hidden_ = std::move(hidden); }
  bool empty() const { return surfels_.empty(); }

  /// The surfel nearest to a point among those that face in the same direction, at most `rings`
  /// cells away, up to kMaxRings; nullptr if there is no such surfel.
  const Surfel* nearest(const Eigen::Vector2f& p, const Eigen::Vector2f& normal, int rings) const;

  bool is_hidden(int owner) const {
    return static_cast<std::size_t>(owner) < hidden_.size() && hidden_[owner] != 0;
  }
  double cell() const { return cell_; }
  const std::vector<Surfel>& surfels() const { return surfels_; }

 private:
  /// A place in cells, and the parts of a cell that lie below it.
  struct Place {
    Eigen::Vector2i cell;
    Eigen::Vector2f below;  ///< [m], 0 to the side of a cell
  };

  Place place_of(const Eigen::Vector2f& p) const;
  void insert_point(const SurfacePoint& point, int owner);
  void mark_neighbors(const Eigen::Vector2i& cell);

  double cell_;
  float per_meter_;
  /// 1 + index of a cell's first surfel; without any: minus the rings to the nearest cell that has
  /// one, 0 beyond kMaxRings.
  GrowingGrid<std::int32_t> first_;
  std::vector<Surfel> surfels_;
  std::vector<Eigen::Vector2i> touched_;  ///< cells that have surfels
  std::vector<char> hidden_;
};

}  // namespace trident::slam
