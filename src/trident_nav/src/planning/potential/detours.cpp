// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/potential/detours.h"

#include <algorithm>

namespace trident::nav {
namespace {

/// How far a detour may lead away from the path [cells].
constexpr int kMargin = 64;
/// Windows of more cells are too dear.
constexpr std::size_t kMaxCells = 800U * 800U;

}  // namespace

Detours::Detours(const StepCosts& costs, bool outline)
    : outline_(outline), potential_(costs, false) {}

std::optional<std::vector<Cell>> Detours::around(const CostGrid& grid, const Potential& potential,
                                                 const std::vector<Cell>& path, std::size_t reach,
                                                 const CancelFlag& cancel) {
  std::vector<Cell> cells;
  std::size_t next = 0;
  for (const Segment& segment : segments(grid, potential, path, reach)) {
    cells.insert(cells.end(), path.begin() + static_cast<std::ptrdiff_t>(next),
                 path.begin() + static_cast<std::ptrdiff_t>(segment.from));
    if (!look(grid, path, segment)) return std::nullopt;
    if (!append_detour(path, segment, cancel, cells)) return std::nullopt;
    next = segment.to + 1;
  }
  cells.insert(cells.end(), path.begin() + static_cast<std::ptrdiff_t>(next), path.end());
  return cells;
}

// Segments that come close to each other are one.
std::vector<Detours::Segment> Detours::segments(const CostGrid& grid, const Potential& potential,
                                                const std::vector<Cell>& path, std::size_t reach) {
  std::vector<Segment> result;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (!potential.is_dearer(grid, path[i], path[i + 1])) continue;
    const std::size_t from = i > reach ? i - reach : 0;
    const std::size_t to = std::min(i + 1 + reach, path.size() - 1);
    if (!result.empty() && from <= result.back().to) {
      result.back().to = to;
    } else {
      result.push_back({from, to});
    }
  }
  return result;
}

// False when the window would be too large.
bool Detours::look(const CostGrid& grid, const std::vector<Cell>& path, Segment segment) {
  const GridGeometry& g = grid.geometry;
  const int edge = outline_ ? 1 : 0;
  Cell low = path[segment.from], high = low;
  for (std::size_t i = segment.from; i <= segment.to; ++i) {
    low = {std::min(low.x, path[i].x), std::min(low.y, path[i].y)};
    high = {std::max(high.x, path[i].x), std::max(high.y, path[i].y)};
  }
  low = {std::max(edge, low.x - kMargin), std::max(edge, low.y - kMargin)};
  high = {std::min(g.width - 1 - edge, high.x + kMargin),
          std::min(g.height - 1 - edge, high.y + kMargin)};
  window_.low = low;
  window_.geometry = {high.x - low.x + 1, high.y - low.y + 1, g.resolution, 0.0, 0.0};
  if (window_.geometry.size() > kMaxCells) return false;
  window_.cost.resize(window_.geometry.size());
  for (int y = low.y; y <= high.y; ++y) {
    const std::uint8_t* row = grid.cost + g.index({low.x, y});
    std::copy(
        row, row + window_.geometry.width,
        window_.cost.begin() + static_cast<std::ptrdiff_t>(window_.geometry.index({0, y - low.y})));
  }
  return true;
}

bool Detours::append_detour(const std::vector<Cell>& path, Segment segment,
                            const CancelFlag& cancel, std::vector<Cell>& cells) {
  CostGrid grid;
  grid.geometry = window_.geometry;
  grid.cost = window_.cost.data();
  const auto inside = [this](Cell c) { return Cell{c.x - window_.low.x, c.y - window_.low.y}; };
  const Cell from = inside(path[segment.from]);
  const Cell to = inside(path[segment.to]);
  if (!window_.geometry.contains(from) || !window_.geometry.contains(to)) return false;
  potential_.clear();
  if (potential_.search(grid, to, from, cancel) != SearchResult::kFound) return false;
  for (const Cell c : potential_.trace()) {
    cells.push_back({c.x + window_.low.x, c.y + window_.low.y});
  }
  return true;
}

}  // namespace trident::nav
