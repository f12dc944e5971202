// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "planning/grids/step_costs.h"
#include "planning/potential/potential.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// Leads a path of a kept potential around cells that have become dearer since, by short searches
/// between cells of the path some distance before and behind them: what an obstacle on a long path
/// needs where the potential beyond it is as it was.
class Detours {
 public:
  /// `outline`: the cells along the border of the grid are blocked.
  Detours(const StepCosts& costs, bool outline);

  /// The cells of the potential's path with detours, which begin and end `reach` cells before and
  /// behind what they lead around. None when no path leads around there, or when canceled.
  std::optional<std::vector<Cell>> around(const CostGrid& grid, const Potential& potential,
                                          const std::vector<Cell>& path, std::size_t reach,
                                          const CancelFlag& cancel);

 private:
  /// Cells [from, to] of a path, between which there are dearer ones.
  struct Segment {
    std::size_t from, to;
  };
  /// A part of the grid: what the short searches see.
  struct Window {
    Cell low;  ///< Its first cell, in the grid.
    GridGeometry geometry;
    std::vector<std::uint8_t> cost;
  };

  static std::vector<Segment> segments(const CostGrid& grid, const Potential& potential,
                                       const std::vector<Cell>& path, std::size_t reach);
  bool look(const CostGrid& grid, const std::vector<Cell>& path, Segment segment);
  bool append_detour(const std::vector<Cell>& path, Segment segment, const CancelFlag& cancel,
                     std::vector<Cell>& cells);

  bool outline_;
  Window window_;
  Potential potential_;
};

}  // namespace trident::nav
