// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "beam_counts.h"

#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

constexpr double kMaxCells = 268'435'456.0;
constexpr double kMargin = 0.5;          // [m] around what was seen
constexpr int kBeamsForAWall = 2;        // that ended in one cell
constexpr double kShareForAWall = 0.25;  // of the beams that touched it

}  // namespace

void BeamCounts::Counts::add(std::uint8_t Counts::*which) {
  if (this->*which == UINT8_MAX) {
    passed /= 2;
    ended /= 2;
  }
  ++(this->*which);
}

Eigen::Vector2i BeamCounts::cell_at(const Eigen::Vector2d& p_map) const {
  return {static_cast<int>(std::floor(p_map.x() / resolution_)),
          static_cast<int>(std::floor(p_map.y() / resolution_))};
}

void BeamCounts::check_size() const {
  const Eigen::Vector2d size = (seen_.sizes().array() + 2.0 * kMargin) / resolution_;
  if (size.x() * size.y() <= kMaxCells) return;
  throw Error("the map would have " + number_text(std::ceil(size.x())) + " x " +
              number_text(std::ceil(size.y())) + " cells, legal: up to 2^28; raise resolution (" +
              number_text(resolution_) + " m) or lower the range limit");
}

/// Bresenham's line from a to b without b.
void BeamCounts::count_passed(const Eigen::Vector2i& a, const Eigen::Vector2i& b) {
  const Eigen::Vector2i size = (b - a).cwiseAbs();
  const std::ptrdiff_t row = a.y() < b.y() ? counts_.width() : -counts_.width();
  const std::ptrdiff_t column = a.x() < b.x() ? 1 : -1;
  Counts* cell = &counts_.at(a.x(), a.y());
  const Counts* end = &counts_.at(b.x(), b.y());
  for (int error = size.x() - size.y(); cell != end;) {
    cell->add(&Counts::passed);
    const int doubled = 2 * error;
    if (doubled >= -size.y()) {
      error -= size.y();
      cell += column;
    }
    if (doubled <= size.x()) {
      error += size.x();
      cell += row;
    }
  }
}

/// Room for all ends is made once, before the beams are drawn.
void BeamCounts::add_beams(const Eigen::Vector2d& p_map_laser,
                           const std::vector<Eigen::Vector2d>& p_map_ends) {
  if (p_map_ends.empty()) return;
  Eigen::AlignedBox2d box(p_map_laser);
  for (const Eigen::Vector2d& end : p_map_ends) box.extend(end);
  seen_.extend(box);
  check_size();
  const Eigen::Vector2i low = cell_at(box.min());
  const Eigen::Vector2i high = cell_at(box.max());
  counts_.reserve(low.x(), low.y(), high.x(), high.y());
  const Eigen::Vector2i begin = cell_at(p_map_laser);
  for (const Eigen::Vector2d& end : p_map_ends) {
    const Eigen::Vector2i end_cell = cell_at(end);
    count_passed(begin, end_cell);
    counts_.at(end_cell.x(), end_cell.y()).add(&Counts::ended);
  }
}

/// A cell is a wall where enough beams have ended in it, and enough of those that touched it: beams
/// that graze a wall pass through cells of it.
OccupancyGrid BeamCounts::map() const {
  OccupancyGrid grid;
  grid.resolution = resolution_;
  if (seen_.isEmpty()) return grid;
  const Eigen::Vector2d low = ((seen_.min().array() - kMargin) / resolution_).floor();
  const Eigen::Vector2d size = ((seen_.max().array() + kMargin) / resolution_).ceil() - low.array();
  grid.T_map_origin.p = low * resolution_;
  grid.width = static_cast<int>(size.x());
  grid.height = static_cast<int>(size.y());
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kUnknown);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Counts counts =
          counts_.get(x + static_cast<int>(low.x()), y + static_cast<int>(low.y()));
      const int touched = counts.passed + counts.ended;
      if (touched == 0) continue;
      const bool is_wall =
          counts.ended >= kBeamsForAWall && counts.ended >= kShareForAWall * touched;
      grid.cells[grid.index(x, y)] = is_wall ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
    }
  }
  return grid;
}

}  // namespace trident::slam
