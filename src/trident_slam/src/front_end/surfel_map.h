// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "front_end/growing_grid.h"
#include "trident_base/se2.h"
#include "trident_slam/point_scan.h"

namespace trident {

/// A small piece of surface: the mean of the points, and of their normals, that fell into one cell.
struct Surfel {
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();    ///< in the map's frame [m]
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();  ///< length 1 or 0
  Eigen::Vector2f normal_sum = Eigen::Vector2f::Zero();
  float count = 0.0F;
  std::int32_t next = 0;   ///< another surfel of the same cell, 1 + index, 0: none
  std::int32_t owner = 0;  ///< who saw it first
};

/// A map of surfels. Both faces of a thin wall keep surfels of their own, told apart by where they
/// were seen from. Owners can be hidden: their surfels are then neither found nor added to.
class SurfelMap {
 public:
  explicit SurfelMap(double cell = 0.1) : cell_(cell), per_metre_(static_cast<float>(1.0 / cell)) {}

  void insert(const SE2& T_map_base, const PointScan& scan, int owner = 0);
  void clear();

  /// One entry per owner; owners beyond its end are shown.
  void set_hidden(std::vector<char> hidden) { hidden_ = std::move(hidden); }
  bool empty() const { return surfels_.empty(); }

  /// The surfel nearest to a point among those that face the same way, at most `rings` cells away;
  /// nullptr if there is none.
  const Surfel* nearest(const Eigen::Vector2f& p, const Eigen::Vector2f& normal, int rings) const;

  bool is_hidden(int owner) const {
    return static_cast<std::size_t>(owner) < hidden_.size() && hidden_[owner] != 0;
  }
  double cell() const { return cell_; }
  const std::vector<Surfel>& surfels() const { return surfels_; }

 private:
  int cell_of(float value) const;
  void insert_point(const SurfacePoint& point, int owner);

  double cell_;
  float per_metre_;
  GrowingGrid<std::int32_t> first_;  ///< 1 + index of a cell's first surfel
  std::vector<Surfel> surfels_;
  std::vector<Eigen::Vector2i> touched_;
  std::vector<char> hidden_;
};

}  // namespace trident
