// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trident_nav/core/cost_grid.h"

namespace trident::nav::bench {

/// A costmap that owns its arrays.
struct BenchMap {
  CostGrid view() const;

  std::string name;
  GridGeometry geometry;
  std::vector<std::uint8_t> cost;
  std::vector<float> distance_m;
  float max_distance_m = 0.0F;
  std::uint64_t revision = 1;
  std::vector<std::uint64_t> row_revisions;  ///< Empty: not kept.
};

/// How obstacles are inflated, in costmap_2d's terms.
struct Inflation {
  double inscribed_radius_m = 0.165;
  double inflation_radius_m = 0.55;
  double cost_scaling_factor = 10.0;
};

/// Costs and distances of a map from its lethal cells.
void inflate(BenchMap& map, const Inflation& inflation);

/// Adds an obstacle of so many cells a side about a cell, and what it costs to be near it.
/// Distances stay as they are.
void add_box(BenchMap& map, Cell center, int side, const Inflation& inflation = {});

/// Rooms of 4 to 8 m along corridors of 2 m, doors of 1 m, furniture; cells of 0.05 m. Inflated.
BenchMap office_map(int width, int height, std::uint64_t seed, const Inflation& inflation = {});

/// An open hall with boxes of 0.5 to 4 m that cover about a fifth of it; cells of 0.05 m. Inflated.
BenchMap hall_map(int width, int height, std::uint64_t seed, const Inflation& inflation = {});

/// One query of a MovingAI scenario file.
struct Scenario {
  Cell start, goal;
  double length = 0.0;  ///< Optimal octile length [cells].
};

/// Reads a map of the MovingAI format: `.` and `G` are free, all else is lethal, 1 m cells, row 0
/// of the file is row 0 of the grid. Throws Error naming file and line.
BenchMap load_movingai_map(const std::string& path);
/// The queries of a scenario file. Throws Error naming file and line.
std::vector<Scenario> load_movingai_scenarios(const std::string& path);

/// Cells whose center the robot can be at, drawn at random, at least `least_m` apart.
std::vector<std::pair<Cell, Cell>> random_queries(const BenchMap& map, int count, double least_m,
                                                  std::uint64_t seed);

}  // namespace trident::nav::bench
