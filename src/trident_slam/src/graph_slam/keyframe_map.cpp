// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/keyframe_map.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <string>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

constexpr double kMaxCells = 268'435'456.0;
constexpr double kMargin = 0.5;          // [m] around what was seen
constexpr int kBeamsForAWall = 2;        // that ended in one cell
constexpr double kShareForAWall = 0.25;  // of the beams that touched it

/// Beams that ended in a cell and beams that went through, halved when they run over.
struct Counts {
  std::uint8_t passed = 0;
  std::uint8_t ended = 0;

  void add(std::uint8_t Counts::*which) {
    if (this->*which == UINT8_MAX) {
      passed /= 2;
      ended /= 2;
    }
    ++(this->*which);
  }
};

template <class Use>
void for_each_beam(const KeyframeGraph& graph, const Use& use) {
  for (int i = 0; i < graph.size(); ++i) {
    const SE2& T = graph.pose(i);
    const Eigen::Matrix2d R = T.rotation();
    const Eigen::Vector2d origin = T * graph[i].scan->origin.cast<double>();
    for (const SurfacePoint& point : graph[i].scan->points) {
      use(origin, R * point.p.cast<double>() + T.p);
    }
  }
}

OccupancyGrid empty_map(const KeyframeGraph& graph, double resolution) {
  Eigen::AlignedBox2d box;
  for_each_beam(graph, [&](const Eigen::Vector2d& origin, const Eigen::Vector2d& end) {
    box.extend(origin);
    box.extend(end);
  });
  OccupancyGrid grid;
  grid.resolution = resolution;
  if (box.isEmpty()) return grid;
  const Eigen::Vector2d low = ((box.min().array() - kMargin) / resolution).floor();
  const Eigen::Vector2d size = ((box.max().array() + kMargin) / resolution).ceil() - low.array();
  if (size.x() * size.y() > kMaxCells) {
    throw Error("the map would have " + number_text(size.x()) + " x " + number_text(size.y()) +
                " cells, legal: up to 2^28; raise resolution (" + number_text(resolution) + " m)");
  }
  grid.T_map_origin.p = low * resolution;
  grid.width = static_cast<int>(size.x());
  grid.height = static_cast<int>(size.y());
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kUnknown);
  return grid;
}

/// Bresenham's line from a to b without b.
void count_passed(const Eigen::Vector2i& a, const Eigen::Vector2i& b, const OccupancyGrid& grid,
                  std::vector<Counts>* counts) {
  const Eigen::Vector2i size = (b - a).cwiseAbs();
  const Eigen::Vector2i step(a.x() < b.x() ? 1 : -1, a.y() < b.y() ? 1 : -1);
  int error = size.x() - size.y();
  for (Eigen::Vector2i cell = a; cell != b;) {
    (*counts)[grid.index(cell.x(), cell.y())].add(&Counts::passed);
    const int doubled = 2 * error;
    if (doubled >= -size.y()) {
      error -= size.y();
      cell.x() += step.x();
    }
    if (doubled <= size.x()) {
      error += size.x();
      cell.y() += step.y();
    }
  }
}

}  // namespace

OccupancyGrid keyframe_map(const KeyframeGraph& graph, double resolution) {
  OccupancyGrid grid = empty_map(graph, resolution);
  std::vector<Counts> counts(grid.cells.size());
  for_each_beam(graph, [&](const Eigen::Vector2d& origin, const Eigen::Vector2d& end) {
    const Eigen::Vector2i end_cell = grid.cell_at(end);
    count_passed(grid.cell_at(origin), end_cell, grid, &counts);
    counts[grid.index(end_cell.x(), end_cell.y())].add(&Counts::ended);
  });
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const int touched = counts[i].passed + counts[i].ended;
    if (touched == 0) continue;
    const bool is_wall =
        counts[i].ended >= kBeamsForAWall && counts[i].ended >= kShareForAWall * touched;
    grid.cells[i] = is_wall ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  }
  return grid;
}

}  // namespace trident
