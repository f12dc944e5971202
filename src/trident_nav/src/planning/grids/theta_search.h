// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "planning/grids/bucket_queue.h"
#include "planning/grids/step_costs.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// Lazy Theta* between the centers of two cells. Keeps its arrays between searches.
class ThetaSearch {
 public:
  enum class Result { kFound, kNotBetter, kCanceled };

  /// `corners`: neighbors that a cell is expanded to, 4 or 8.
  ThetaSearch(const StepCosts& costs, int corners);

  /// Searches for a path that costs less than `bound`, in step costs; the cells at its corners are
  /// in `corners()` then.
  Result search(const CostGrid& grid, Cell start, Cell goal, double bound,
                const CancelFlag& cancel);
  const std::vector<Cell>& corners() const { return path_; }
  double cost() const { return cost_; }

 private:
  struct Node {
    float g = 0.0F;
    std::uint32_t stamp = 0;
    std::uint32_t parent = 0;
    bool closed = false;
    bool checked = false;  ///< g is that of a line that has been looked at.
  };

  void begin(const CostGrid& grid, Cell start, Cell goal);
  Cell cell(std::uint32_t i) const;
  double step(Cell a, Cell b) const;
  bool can_step(Cell from, int direction) const;
  double distance_cost(Cell a, Cell b) const;
  Node& node(std::uint32_t i);
  void offer(std::uint32_t i, double g, std::uint32_t parent, bool checked);
  bool settle(std::uint32_t i);
  void expand(std::uint32_t i);
  void trace();

  StepCosts costs_;
  int corners_;
  double least_;
  CostGrid grid_;
  Cell start_, goal_;
  double bound_ = 0.0, cost_ = 0.0;
  std::uint32_t stamp_ = 0;
  std::vector<Node> nodes_;
  BucketQueue<std::uint32_t> queue_;
  std::vector<Cell> path_;
};

}  // namespace trident::nav
