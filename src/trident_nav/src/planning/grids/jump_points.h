// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "planning/grids/bucket_queue.h"
#include "planning/grids/jump_scan.h"
#include "planning/grids/search_result.h"
#include "planning/grids/step_costs.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// Shortest paths over the 8-neighbor graph of a grid whose free cells all cost the same: A* that
/// jumps over the cells between turning points (Harabor and Grastien, "Online Graph Pruning for
/// Pathfinding on Grid Maps", AAAI 2011; a diagonal step needs both cells next to it, as in "The
/// JPS Pathfinding System", SoCS 2012). Turning points in the open, from diagonal to straight
/// steps, are passed over as well ("Improving Jump Point Search", ICAPS 2014). Not thread-safe.
class JumpPoints {
 public:
  using Result = SearchResult;

  /// `outline`: the cells along the border of the grid are blocked.
  explicit JumpPoints(const StepCosts& costs, bool outline = false);

  /// Reads the grid, unless it has its revision already. False: free cells cost differently, and no
  /// search is possible.
  bool read(const CostGrid& grid);
  /// After a successful read. Both cells lie in the grid; `goal` is free.
  Result search(Cell start, Cell goal, const CancelFlag& cancel);

  /// Of the path found, in step costs.
  double cost() const { return cost_; }
  /// The cells of the path found from the start to the goal, all of them.
  const std::vector<Cell>& path() const { return path_; }
  /// Jump points that the last search expanded.
  std::size_t expanded() const { return expanded_; }

 private:
  static constexpr int kTile = 64;
  static constexpr std::int32_t kNoParent = -1;
  static constexpr std::uint32_t kAnyDirection = 8;
  static constexpr std::uint32_t kUnreached = std::numeric_limits<std::uint32_t>::max();
  /// Lengths are whole numbers, so that equal sums are equal: of a straight and of a diagonal step.
  /// Two numbers of Pell's, whose ratio is sqrt 2 to 1e-8.
  static constexpr std::uint32_t kStraight = 5741, kSlanted = 8119;
  static constexpr unsigned kBucketShift = 11;  ///< About a third of a step.

  /// What is known of a jump point in this search.
  struct Node {
    std::uint32_t length = kUnreached;  ///< From the start.
    std::int32_t parent = kNoParent;    ///< Index of the jump point before it.
    std::uint32_t search : 27;          ///< The search that set it; older ones count as unset.
    std::uint32_t direction : 4;        ///< In which it was reached.
    std::uint32_t is_open : 1;
    Node() : search(0), direction(kAnyDirection), is_open(0) {}
  };
  using Tile = std::array<Node, std::size_t{kTile} * kTile>;

  static constexpr std::uint32_t kMaxSearches = (std::uint32_t{1} << 27U) - 1;

  std::optional<float> uniform_step(const CostGrid& grid) const;
  bool is_on_outline(int x, int y) const;
  void block_cells(const CostGrid& grid);
  bool read_costs(const CostGrid& grid);
  bool is_free(int x, int y) const { return !map_.rows.blocked(y, x); }
  void forget_nodes();
  Node& node(Cell c);
  void expand(Cell c);
  void jump(Cell from, int direction);
  void jump_straight(Cell from, Cell via, int direction);
  void jump_diagonal(Cell from, int direction);
  unsigned openings(Cell c, int direction) const;
  std::vector<Cell> trace();
  double cost_of(const std::vector<Cell>& path) const;
  void offer(Cell from, Cell to, int direction);
  static std::uint64_t distance(Cell a, Cell b);

  StepCosts costs_;
  bool outline_;
  /// What was read of the grid.
  struct Map {
    GridGeometry geometry;
    std::uint64_t revision = 0;
    bool is_read = false, is_uniform = false;
    double step = 1.0;  ///< Of one cell's length.
    JumpScan rows, columns;
  };
  Map map_;
  std::vector<std::unique_ptr<Tile>> tiles_;
  BucketQueue<Cell> queue_;
  Cell start_, goal_;
  int tiles_x_ = 0;
  std::uint32_t search_ = 0;  ///< Counts the searches since the tiles were made.
  std::vector<Cell> path_;
  double cost_ = 0.0;
  std::size_t expanded_ = 0;
};

}  // namespace trident::nav
