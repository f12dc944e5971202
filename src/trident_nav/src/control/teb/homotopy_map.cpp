// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "homotopy_map.h"

#include <algorithm>
#include <cmath>

#include "homotopy_search.h"

namespace trident::nav {
namespace {

constexpr int kMaxSide = 48;  // nodes: more distinguish no more classes
constexpr HSignature kLowBits = 0x5555555555555555ULL;

}  // namespace

// Fields of two bits that do not carry into each other.
HSignature added(HSignature a, HSignature b) {
  const HSignature low = (a & kLowBits) + (b & kLowBits);  // a field's carry lands in its high bit
  return low ^ ((a ^ b) & ~kLowBits);
}

HomotopyMap::HomotopyMap(const CostGrid& grid, const TebRegion& area, double inscribed_radius,
                         UnknownCells unknown) {
  const double resolution = grid.geometry.resolution;
  const double side_m = std::max(area.hi.x - area.lo.x, area.hi.y - area.lo.y);
  step_m_ = std::max({resolution, 0.7 * inscribed_radius, side_m / kMaxSide});
  width_ = std::clamp(1 + static_cast<int>((area.hi.x - area.lo.x) / step_m_), 1, kMaxSide + 1);
  height_ = std::clamp(1 + static_cast<int>((area.hi.y - area.lo.y) / step_m_), 1, kMaxSide + 1);
  origin_ = area.lo;
  block(grid, inscribed_radius, unknown);
  find_obstacles();
}

Point2 HomotopyMap::point(int node) const {
  const int column = node % width_;
  const int row = node / width_;
  return {origin_.x + step_m_ * column, origin_.y + step_m_ * row};
}

int HomotopyMap::node_at(const Point2& point) const {
  const int x = static_cast<int>(std::lround((point.x - origin_.x) / step_m_));
  const int y = static_cast<int>(std::lround((point.y - origin_.y) / step_m_));
  return std::clamp(y, 0, height_ - 1) * width_ + std::clamp(x, 0, width_ - 1);
}

bool HomotopyMap::is_edge(int x, int y) const {
  return x == 0 || y == 0 || x == width_ - 1 || y == height_ - 1;
}

void HomotopyMap::block(const CostGrid& grid, double inscribed_radius, UnknownCells unknown) {
  is_blocked_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
  for (int node = 0; node < width_ * height_; ++node) {
    const Point2 p = point(node);
    const Cell cell = grid.geometry.cell(p.x, p.y);
    // Nothing leads around what is beyond the grid's edge.
    bool is_blocked = true;
    if (grid.geometry.contains(cell)) {
      const double d = static_cast<double>(grid.distance_m[grid.geometry.index(cell)]);
      const bool is_unknown = grid.at(cell) == kUnknownCost;
      is_blocked = d < inscribed_radius || (is_unknown && unknown == UnknownCells::kOccupied);
    }
    is_blocked_[static_cast<std::size_t>(node)] = is_blocked ? 1 : 0;
  }
}

/// Marks all blocked nodes that are connected with one. False: some lie on the edge.
bool HomotopyMap::flood(int seed, std::vector<std::uint8_t>* seen) const {
  std::vector<int> open{seed};
  (*seen)[static_cast<std::size_t>(seed)] = 1;
  bool is_inside = true;
  while (!open.empty()) {
    const int x = open.back() % width_;
    const int y = open.back() / width_;
    open.pop_back();
    is_inside = is_inside && !is_edge(x, y);
    for (int k = 0; k < 9; ++k) {
      const int nx = x + k % 3 - 1;
      const int ny = y + k / 3 - 1;
      if (!contains(nx, ny)) continue;
      const int neighbor = ny * width_ + nx;
      const auto next = static_cast<std::size_t>(neighbor);
      if (is_blocked_[next] == 0 || (*seen)[next] != 0) continue;
      (*seen)[next] = 1;
      open.push_back(static_cast<int>(next));
    }
  }
  return is_inside;
}

void HomotopyMap::find_obstacles() {
  constexpr double kOffNodes = 0.37;  // of a step
  std::vector<std::uint8_t> seen(is_blocked_.size(), 0);
  for (int node = 0; node < width_ * height_ && rays_.size() < kMaxRays; ++node) {
    const auto i = static_cast<std::size_t>(node);
    if (is_blocked_[i] == 0 || seen[i] != 0) continue;
    // The first node of an obstacle is of its lowest row: nothing of it is below.
    const Point2 p = point(node);
    if (flood(node, &seen)) rays_.push_back({p.x + kOffNodes * step_m_, p.y});
  }
}

HSignature HomotopyMap::crossed(const Point2& a, const Point2& b) const {
  HSignature sum = 0;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const Ray& ray = rays_[i];
    if ((a.x < ray.x) == (b.x < ray.x)) continue;
    const double t = (ray.x - a.x) / (b.x - a.x);
    if (a.y + t * (b.y - a.y) >= ray.top) continue;
    sum = added(sum, (b.x > a.x ? HSignature{1} : HSignature{3}) << (2 * i));
  }
  return sum;
}

HSignature HomotopyMap::signature(const std::vector<Point2>& line) const {
  HSignature sum = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    sum = added(sum, crossed(line[i], line[i + 1]));
  }
  return sum;
}

std::vector<HomotopyPath> HomotopyMap::paths(const Point2& from, const Point2& to,
                                             std::size_t count, double max_ratio) const {
  return HomotopySearch(*this, from, to).run(count, max_ratio);
}

}  // namespace trident::nav
