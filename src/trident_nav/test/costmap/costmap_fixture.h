// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Small costmaps for tests, and what they should hold, computed cell by cell.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../core/test_random.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/layer_factory.h"

namespace trident::nav {

inline const Registry<LayerType>& builtin_layers() {
  static const Registry<LayerType>* registry = [] {
    auto* result = new Registry<LayerType>("layer");
    register_builtin_layers(*result);
    return result;
  }();
  return *registry;
}

inline LayerSetup layer_setup(const std::string& name, const std::string& yaml,
                              bool is_tracking_unknown = false) {
  LayerSetup setup;
  setup.name = name;
  setup.config = parse_yaml(yaml, "test");
  setup.is_tracking_unknown = is_tracking_unknown;
  return setup;
}

/// One layer by class name, as its own type.
template <class T>
std::unique_ptr<T> new_layer(const std::string& yaml = "", bool is_tracking_unknown = false) {
  return std::make_unique<T>(layer_setup("layer", yaml, is_tracking_unknown));
}

inline GridGeometry grid_of(int width, int height, double resolution = 1.0) {
  return {width, height, resolution, 0.0, 0.0};
}

/// An occupancy grid from rows of text, the topmost first: '#' occupied, '.' free, '?' unknown.
inline OccupancyGrid map_of(const std::vector<std::string>& rows, double resolution = 1.0) {
  OccupancyGrid map;
  map.width = static_cast<int>(rows[0].size());
  map.height = static_cast<int>(rows.size());
  map.resolution = resolution;
  map.cells.resize(map.index(0, map.height));
  for (int y = 0; y < map.height; ++y) {
    const std::string& row = rows[static_cast<std::size_t>(map.height - 1 - y)];
    for (int x = 0; x < map.width; ++x) {
      const char c = row[static_cast<std::size_t>(x)];
      map.cells[map.index(x, y)] = c == '#' ? 100 : (c == '?' ? -1 : 0);
    }
  }
  return map;
}

/// The costs of a grid, the topmost row first.
inline std::vector<std::vector<int>> rows_of(const CostGrid& grid) {
  std::vector<std::vector<int>> rows;
  for (int y = grid.geometry.height - 1; y >= 0; --y) {
    rows.emplace_back();
    for (int x = 0; x < grid.geometry.width; ++x) rows.back().push_back(grid.at(Cell{x, y}));
  }
  return rows;
}

/// Squared distance to the nearest cell with cost `seed` [cells^2]; -1 without one.
inline int nearest_square(const std::vector<std::uint8_t>& cost, const GridGeometry& grid, Cell at,
                          std::uint8_t seed = kLethalCost) {
  int best = -1;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (cost[grid.index({x, y})] != seed) continue;
      const int square = (x - at.x) * (x - at.x) + (y - at.y) * (y - at.y);
      if (best < 0 || square < best) best = square;
    }
  }
  return best;
}

}  // namespace trident::nav
