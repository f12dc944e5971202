// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "teb_obstacles.h"
#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// The H-signature of a line: of each obstacle, how often the line crosses the ray that leads down
/// from it, with the sense of the crossing, modulo 4; two bits each. Lines between the same ends
/// have equal signatures if they pass all obstacles on the same side.
using HSignature = std::uint64_t;

/// A line to a goal, of its class the shortest one on the lattice.
struct HomotopyPath {
  std::vector<Point2> points;
  HSignature signature = 0;
  double length_m = 0.0;
};

/// A lattice over a part of a costmap, whose obstacles are what the center of the robot cannot
/// enter: gaps that it does not fit through separate none. Those that touch the edge cannot be
/// walked around and do not count. Bhattacharya, Likhachev, Kumar, "Topological constraints in
/// search-based robot path planning", Autonomous Robots 33 (2012), sections 3 and 4.
class HomotopyMap {
 public:
  /// `grid` must have distances.
  HomotopyMap(const CostGrid& grid, const TebRegion& area, double inscribed_radius,
              UnknownCells unknown);

  HSignature signature(const std::vector<Point2>& line) const;

  /// The shortest paths to a goal, one of each class, the shortest first: up to `count` of them and
  /// none longer than `max_ratio` times the first. Empty where nothing leads there.
  std::vector<HomotopyPath> paths(const Point2& from, const Point2& to, std::size_t count,
                                  double max_ratio) const;

  std::size_t obstacles() const { return rays_.size(); }

 private:
  /// Down from an obstacle, at a column that no node lies on.
  struct Ray {
    double x = 0.0;
    double top = 0.0;
  };
  static constexpr std::size_t kMaxRays = 32;

  void block(const CostGrid& grid, double inscribed_radius, UnknownCells unknown);
  void find_obstacles();
  bool flood(int seed, std::vector<std::uint8_t>* seen) const;
  HSignature crossed(const Point2& a, const Point2& b) const;
  Point2 point(int node) const;
  int node_at(const Point2& point) const;
  bool is_edge(int x, int y) const;
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  friend class HomotopySearch;

  int width_ = 0, height_ = 0;
  double step_m_ = 0.0;
  Point2 origin_;  ///< Of node 0.
  std::vector<std::uint8_t> is_blocked_;
  std::vector<Ray> rays_;
};

/// The sum of two signatures.
HSignature added(HSignature a, HSignature b);

}  // namespace trident::nav
