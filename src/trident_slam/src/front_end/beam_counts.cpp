// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "front_end/beam_counts.h"

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

constexpr double kMaxCells = 268'435'456.0;
constexpr double kMargin = 0.5;    // [m] around what was seen
constexpr int kBeamsForAWall = 2;  // that ended in one cell

OccupancyGrid empty_map(const Eigen::AlignedBox2d& seen, double resolution) {
  OccupancyGrid grid;
  grid.resolution = resolution;
  if (seen.isEmpty()) return grid;
  const Eigen::Vector2d low = ((seen.min().array() - kMargin) / resolution).floor();
  const Eigen::Vector2d size = ((seen.max().array() + kMargin) / resolution).ceil() - low.array();
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

void BeamCounts::Counts::add(std::uint8_t Counts::*which) {
  if (this->*which == UINT8_MAX) {
    passed /= 2;
    ended /= 2;
  }
  ++(this->*which);
}

BeamCounts::BeamCounts(const Eigen::AlignedBox2d& seen, double resolution)
    : grid_(empty_map(seen, resolution)), counts_(grid_.cells.size()) {}

// Bresenham's line, its last cell apart.
void BeamCounts::add_beam(const Eigen::Vector2d& p_map_laser, const Eigen::Vector2d& p_map_end) {
  const Eigen::Vector2i end = grid_.cell_at(p_map_end);
  Eigen::Vector2i cell = grid_.cell_at(p_map_laser);
  const Eigen::Vector2i size = (end - cell).cwiseAbs();
  const Eigen::Vector2i step(cell.x() < end.x() ? 1 : -1, cell.y() < end.y() ? 1 : -1);
  int error = size.x() - size.y();
  while (cell != end) {
    at(cell).add(&Counts::passed);
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
  at(end).add(&Counts::ended);
}

OccupancyGrid BeamCounts::map(double occupied_share) const {
  OccupancyGrid grid = grid_;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const int touched = counts_[i].passed + counts_[i].ended;
    if (touched == 0) continue;
    const bool is_wall =
        counts_[i].ended >= kBeamsForAWall && counts_[i].ended >= occupied_share * touched;
    grid.cells[i] = is_wall ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  }
  return grid;
}

}  // namespace trident
