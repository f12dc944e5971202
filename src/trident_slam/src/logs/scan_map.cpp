// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "logs/scan_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

constexpr double kMaxCells = 268'435'456.0;
constexpr double kMargin = 0.5;  // [m] around what was seen

struct Counts {
  std::uint16_t passed = 0;
  std::uint16_t ended = 0;
};

void count_up(std::uint16_t& value) {
  if (value < UINT16_MAX) ++value;
}

// Calls use(p_map_laser, p_map_end) for each return.
template <class Use>
void for_each_return(const PlacedScan& placed, double range_limit, const Use& use) {
  const LaserScan& scan = *placed.scan;
  const SE2 T_map_laser = placed.T_map_base * scan.T_base_laser;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double range = scan.ranges[i];
    if (!scan.is_return(i) || range > range_limit || range <= 0.0) continue;
    const double angle = scan.angle(i);
    use(T_map_laser.p,
        T_map_laser * Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle)));
  }
}

// Bresenham's line from a to b without b.
void count_passed(const Eigen::Vector2i& a, const Eigen::Vector2i& b, const OccupancyGrid& grid,
                  std::vector<Counts>& counts) {
  const int dx = std::abs(b.x() - a.x());
  const int dy = -std::abs(b.y() - a.y());
  const int step_x = a.x() < b.x() ? 1 : -1;
  const int step_y = a.y() < b.y() ? 1 : -1;
  int error = dx + dy;
  for (Eigen::Vector2i cell = a; cell != b;) {
    count_up(counts[grid.index(cell.x(), cell.y())].passed);
    const int doubled = 2 * error;
    if (doubled >= dy) {
      error += dy;
      cell.x() += step_x;
    }
    if (doubled <= dx) {
      error += dx;
      cell.y() += step_y;
    }
  }
}

OccupancyGrid empty_map(const Eigen::AlignedBox2d& box, double resolution) {
  OccupancyGrid grid;
  grid.resolution = resolution;
  const Eigen::Vector2d low = ((box.min().array() - kMargin) / resolution).floor();
  const Eigen::Vector2d size = ((box.max().array() + kMargin) / resolution).ceil() - low.array();
  if (size.x() * size.y() > kMaxCells) {
    throw Error("the map would have " + number_text(size.x()) + " x " + number_text(size.y()) +
                " cells, legal: up to 2^28; raise resolution (" + number_text(resolution) +
                " m) or lower the range limit");
  }
  grid.T_map_origin.p = low * resolution;
  grid.width = static_cast<int>(size.x());
  grid.height = static_cast<int>(size.y());
  grid.cells.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height),
                    OccupancyGrid::kUnknown);
  return grid;
}

}  // namespace

OccupancyGrid build_scan_map(std::size_t count,
                             const std::function<PlacedScan(std::size_t)>& placed_scan,
                             const ScanMapOptions& options) {
  Eigen::AlignedBox2d box;
  for (std::size_t k = 0; k < count; ++k) {
    for_each_return(placed_scan(k), options.range_limit,
                    [&](const Eigen::Vector2d& p_laser, const Eigen::Vector2d& p_end) {
                      box.extend(p_laser);
                      box.extend(p_end);
                    });
  }
  if (box.isEmpty()) return {};
  OccupancyGrid grid = empty_map(box, options.resolution);
  std::vector<Counts> counts(grid.cells.size());
  for (std::size_t k = 0; k < count; ++k) {
    for_each_return(placed_scan(k), options.range_limit,
                    [&](const Eigen::Vector2d& p_laser, const Eigen::Vector2d& p_end) {
                      const Eigen::Vector2i end = grid.cell_at(p_end);
                      count_passed(grid.cell_at(p_laser), end, grid, counts);
                      count_up(counts[grid.index(end.x(), end.y())].ended);
                    });
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const int touched = counts[i].passed + counts[i].ended;
    if (touched == 0) continue;
    const bool is_occupied =
        counts[i].ended >= 2 && counts[i].ended >= options.occupied_share * touched;
    grid.cells[i] = is_occupied ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  }
  return grid;
}

}  // namespace trident
