// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "map_grid.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {

void MapGrid::resize(const CostGrid& grid, const Point2& center, double radius_m) {
  geometry_ = grid.geometry;
  const Cell lo = geometry_.cell(center.x - radius_m, center.y - radius_m);
  const Cell hi = geometry_.cell(center.x + radius_m, center.y + radius_m);
  first_ = {std::clamp(lo.x, 0, geometry_.width), std::clamp(lo.y, 0, geometry_.height)};
  width_ = std::max(std::min(hi.x + 1, geometry_.width) - first_.x, 0);
  height_ = std::max(std::min(hi.y + 1, geometry_.height) - first_.y, 0);
}

bool MapGrid::seed(double x, double y) {
  const Cell cell = geometry_.cell(x, y);
  const int column = cell.x - first_.x;
  const int row = cell.y - first_.y;
  if (column < 0 || row < 0 || column >= width_ || row >= height_) return false;
  const int i = row * width_ + column;
  if (distance_[static_cast<std::size_t>(i)] == 0.0F) return true;
  distance_[static_cast<std::size_t>(i)] = 0.0F;
  front_.push_back(i);
  return true;
}

void MapGrid::measure_from_path(const CostGrid& grid, const Path& path) {
  distance_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                   unreachable());
  front_.clear();
  for (const Pose2& pose : path) seed(pose.x, pose.y);
  spread(grid);
}

void MapGrid::measure_from_end(const CostGrid& grid, const Path& path) {
  distance_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                   unreachable());
  front_.clear();
  for (auto pose = path.rbegin(); pose != path.rend() && !seed(pose->x, pose->y); ++pose) {
  }
  spread(grid);
}

void MapGrid::spread(const CostGrid& grid) {
  const int steps[] = {-1, 1, -width_, width_};
  for (std::size_t head = 0; head < front_.size(); ++head) {
    const int i = front_[head];
    const int column = i % width_;
    const int row = i / width_;
    const float next = distance_[static_cast<std::size_t>(i)] + 1.0F;
    const bool is_inside[] = {column > 0, column + 1 < width_, row > 0, row + 1 < height_};
    for (int k = 0; k < 4; ++k) {
      if (!is_inside[k]) continue;
      const int neighbor = i + steps[k];
      const auto j = static_cast<std::size_t>(neighbor);
      if (distance_[j] <= next) continue;
      const Cell cell{first_.x + static_cast<int>(j) % width_,
                      first_.y + static_cast<int>(j) / width_};
      const std::uint8_t cost = grid.at(cell);
      const bool is_open =
          cost < kInscribedCost || (cost == kUnknownCost && unknown_ == UnknownCells::kFree);
      if (!is_open) continue;
      distance_[j] = next;
      front_.push_back(static_cast<int>(j));
    }
  }
}

float MapGrid::at(double x, double y) const {
  const Cell cell = geometry_.cell(x, y);
  const int column = cell.x - first_.x;
  const int row = cell.y - first_.y;
  if (column < 0 || row < 0 || column >= width_ || row >= height_) return unreachable();
  const int index = row * width_ + column;
  return distance_[static_cast<std::size_t>(index)];
}

}  // namespace trident::nav
