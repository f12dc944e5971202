// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/keyframe_map.h"

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

}  // namespace

void KeyframeMap::Counts::add(std::uint8_t Counts::*which) {
  if (this->*which == UINT8_MAX) {
    passed /= 2;
    ended /= 2;
  }
  ++(this->*which);
}

Eigen::Vector2i KeyframeMap::cell_at(const Eigen::Vector2d& p_map) const {
  return {static_cast<int>(std::floor(p_map.x() / resolution_)),
          static_cast<int>(std::floor(p_map.y() / resolution_))};
}

bool KeyframeMap::only_grew(const KeyframeGraph& graph) const {
  if (static_cast<std::size_t>(graph.size()) < drawn_.size()) return false;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const Keyframe& keyframe = graph[static_cast<int>(i)];
    if (keyframe.scan != drawn_[i].scan || keyframe.T_map_base.p != drawn_[i].T_map_base.p ||
        keyframe.T_map_base.angle != drawn_[i].T_map_base.angle) {
      return false;
    }
  }
  return true;
}

void KeyframeMap::check_size() const {
  const Eigen::Vector2d size = (box_.sizes().array() + 2.0 * kMargin) / resolution_;
  if (size.x() * size.y() <= kMaxCells) return;
  throw Error("the map would have " + number_text(std::ceil(size.x())) + " x " +
              number_text(std::ceil(size.y())) + " cells, legal: up to 2^28; raise resolution (" +
              number_text(resolution_) + " m)");
}

/// Bresenham's line from a to b without b.
void KeyframeMap::count_passed(const Eigen::Vector2i& a, const Eigen::Vector2i& b) {
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

void KeyframeMap::draw(const Keyframe& keyframe) {
  const SE2& T = keyframe.T_map_base;
  const PointScan& scan = *keyframe.scan;
  drawn_.push_back({T, keyframe.scan});
  if (scan.points.empty()) return;
  const Eigen::Matrix2d R = T.rotation();
  const Eigen::Vector2d origin = T * scan.origin.cast<double>();
  Eigen::AlignedBox2d box(origin);
  std::vector<Eigen::Vector2d> ends;
  ends.reserve(scan.points.size());
  for (const SurfacePoint& point : scan.points) {
    ends.emplace_back(R * point.p.cast<double>() + T.p);
    box.extend(ends.back());
  }
  box_.extend(box);
  check_size();
  const Eigen::Vector2i low = cell_at(box.min());
  const Eigen::Vector2i high = cell_at(box.max());
  counts_.reserve(low.x(), low.y(), high.x(), high.y());
  const Eigen::Vector2i begin = cell_at(origin);
  for (const Eigen::Vector2d& end : ends) {
    const Eigen::Vector2i end_cell = cell_at(end);
    count_passed(begin, end_cell);
    counts_.at(end_cell.x(), end_cell.y()).add(&Counts::ended);
  }
}

OccupancyGrid KeyframeMap::grid() const {
  OccupancyGrid grid;
  grid.resolution = resolution_;
  if (box_.isEmpty()) return grid;
  const Eigen::Vector2d low = ((box_.min().array() - kMargin) / resolution_).floor();
  const Eigen::Vector2d size = ((box_.max().array() + kMargin) / resolution_).ceil() - low.array();
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

OccupancyGrid KeyframeMap::update(const KeyframeGraph& graph) {
  if (!only_grew(graph)) *this = KeyframeMap(resolution_);
  for (int i = static_cast<int>(drawn_.size()); i < graph.size(); ++i) draw(graph[i]);
  return grid();
}

OccupancyGrid keyframe_map(const KeyframeGraph& graph, double resolution) {
  return KeyframeMap(resolution).update(graph);
}

}  // namespace trident
