// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "planning/grids/grid_directions.h"
#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// What a potential knows of the cells of a grid, with a rim of blocked ones around it: x and y
/// count from the rim. Cells lie in squares of 64 x 64, so that neighbors are near in memory. A
/// square is filled with the grid's costs when a search comes to it, and lies behind that which was
/// filled before: memory that is touched for the first time is dear.
class PotentialCells {
 public:
  static constexpr int kSide = 64;
  static constexpr std::uint32_t kUnreached = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint8_t kRoot = 8;       ///< Of Node::parent: the goal.
  static constexpr std::uint8_t kNoParent = 15;  ///< Of Node::parent: not reached.

  struct Node {
    std::uint32_t value;  ///< kUnreached, or the cost of a path to the goal.
    std::uint8_t cost;  ///< As the search takes it; a raised one of the grid may not be known yet.
    std::uint8_t parent;  ///< The direction of the next cell towards the goal.
    bool is_open;         ///< It may lower its neighbors.
    bool is_even;         ///< It and all eight neighbors cost the same, and lie in one square.
  };

  /// `outline`: the cells along the border of the grid are blocked.
  explicit PotentialCells(bool outline) : outline_(outline) {}

  /// Forgets all cells, and takes another shape.
  void reset(const GridGeometry& geometry);

  /// Of a cell in a square that has been filled.
  std::size_t index(int x, int y) const {
    const auto column = static_cast<unsigned>(x);
    const auto row = static_cast<unsigned>(y);
    return slots_[square(x, y)] * kNodes + row % kSide * kSide + column % kSide;
  }
  Node& operator[](std::size_t index) { return nodes_[index]; }
  const Node& operator[](std::size_t index) const { return nodes_[index]; }
  /// Whether the square of a cell has been filled.
  bool is_filled(int x, int y) const { return slots_[square(x, y)] != kNoSlot; }
  /// By direction, what the index of a neighbor differs by from that of a cell within the rim;
  /// after `fill_around` for that cell.
  using Offsets = std::array<std::ptrdiff_t, 8>;
  const Offsets& offsets(int x, int y) const {
    if (is_inner(x) && is_inner(y)) return inner_;
    return borders_[slots_[square(x, y)]].offsets[side_of(x, y)];
  }
  /// Fills the squares of a cell, whose own is filled, and of its neighbors.
  void fill_around(int x, int y, const CostGrid& grid) {
    if (is_inner(x) && is_inner(y)) return;
    if ((borders_[slots_[square(x, y)]].ready >> side_of(x, y) & 1U) != 0) return;
    fill_neighbors(x, y, grid);
  }
  /// Fills the square of a cell.
  void fill(int x, int y, const CostGrid& grid);

  /// The cost in the grid; that of a blocked cell on the rim.
  std::uint8_t cost_in(const CostGrid& grid, int x, int y) const;
  /// Sets the cost of a cell in a square that has been filled.
  void set_cost(int x, int y, std::uint8_t cost);
  /// Calls visit(x, y) for each cell of a filled square whose cost differs from the grid's, in rows
  /// that the grid has changed after `revision`.
  template <class Visit>
  void for_each_difference(const CostGrid& grid, std::uint64_t revision, Visit&& visit) const;
  /// The same for the squares around that of a cell.
  template <class Visit>
  void for_each_difference_near(int x, int y, const CostGrid& grid, Visit&& visit) const;

 private:
  static constexpr std::size_t kNodes = std::size_t{kSide} * kSide;
  static constexpr std::size_t kMargin = 64;  ///< Bytes before and behind the costs.
  static constexpr std::uint32_t kNoSlot = std::numeric_limits<std::uint32_t>::max();
  struct Free {
    void operator()(void* memory) const;
  };
  template <class Item>
  using Array = std::unique_ptr<Item[], Free>;
  template <class Item>
  static Array<Item> make_array(std::size_t count);

  static bool is_inner(int coordinate) {
    const unsigned within = static_cast<unsigned>(coordinate) % kSide;
    return within != 0 && within != kSide - 1;
  }
  /// What the neighbors of a square's outer cells are off by, by the sides that a cell is at.
  struct Border {
    std::array<Offsets, 9> offsets{};
    unsigned ready = 0;  ///< A bit for each of them.
  };
  /// 0: at the lower side of its square, 2: at the upper one, 1: between them.
  static std::size_t side_of(int coordinate) {
    const unsigned within = static_cast<unsigned>(coordinate) % kSide;
    return (within != 0 ? 1U : 0U) + (within == kSide - 1 ? 1U : 0U);
  }
  static std::size_t side_of(int x, int y) { return 3 * side_of(y) + side_of(x); }
  std::size_t square(int x, int y) const {
    return static_cast<std::size_t>(y) / kSide * columns_ + static_cast<std::size_t>(x) / kSide;
  }
  /// Of the columns or rows of the grid that are not on its outline, counted from the rim.
  int first() const { return outline_ ? 2 : 1; }
  int end(int length) const { return outline_ ? length : length + 1; }
  void fill_neighbors(int x, int y, const CostGrid& grid);
  bool is_even_at(const Node* node) const;
  template <class Visit>
  void compare(int column, int row, const CostGrid& grid, std::uint64_t revision,
               Visit&& visit) const;

  bool outline_;
  GridGeometry geometry_;
  std::size_t columns_ = 0, rows_ = 0;  ///< Of squares.
  std::size_t allocated_ = 0;           ///< Nodes.
  Array<Node> nodes_;
  Array<std::uint8_t> costs_;         ///< Those of the nodes once more, after kMargin bytes.
  std::vector<std::uint32_t> slots_;  ///< By square: its place among the nodes, or kNoSlot.
  std::vector<Border> borders_;       ///< By slot; there is room for all.
  /// Of cells that are not at a side of their square.
  static constexpr Offsets inner_{1,         kSide,     -1,         -kSide,
                                  kSide + 1, kSide - 1, -kSide - 1, 1 - kSide};
};

template <class Visit>
void PotentialCells::compare(int column, int row, const CostGrid& grid, std::uint64_t revision,
                             Visit&& visit) const {
  const int x0 = column * kSide, y0 = row * kSide;
  if (!is_filled(x0, y0)) return;
  constexpr int kAhead = 8;  // rows; those of the grid lie far apart
  const int from = std::max(x0, first());
  const int to = std::min(x0 + kSide, end(geometry_.width));
  if (from >= to) return;
  const int last = std::min(y0 + kSide, end(geometry_.height));
  for (int y = std::max(y0, first()); y < last; ++y) {
    if (grid.row_revisions != nullptr && grid.row_revisions[y - 1] <= revision) continue;
    const std::uint8_t* kept = &costs_[kMargin + index(from, y)];
    const std::uint8_t* now = grid.cost + geometry_.index({from - 1, y - 1});
    __builtin_prefetch(grid.cost + geometry_.index({from - 1, std::min(y + kAhead, last - 1) - 1}));
    __builtin_prefetch(grid.cost + geometry_.index({to - 2, std::min(y + kAhead, last - 1) - 1}));
    if (std::equal(kept, kept + (to - from), now)) continue;
    for (int x = from; x < to; ++x) {
      if (kept[x - from] != now[x - from]) visit(x, y);
    }
  }
}

template <class Visit>
void PotentialCells::for_each_difference(const CostGrid& grid, std::uint64_t revision,
                                         Visit&& visit) const {
  for (int row = 0; row < static_cast<int>(rows_); ++row) {
    for (int column = 0; column < static_cast<int>(columns_); ++column) {
      compare(column, row, grid, revision, visit);
    }
  }
}

template <class Visit>
void PotentialCells::for_each_difference_near(int x, int y, const CostGrid& grid,
                                              Visit&& visit) const {
  const int column = x / kSide, row = y / kSide;
  for (int r = std::max(0, row - 1); r <= std::min(static_cast<int>(rows_) - 1, row + 1); ++r) {
    const int right = std::min(static_cast<int>(columns_) - 1, column + 1);
    for (int c = std::max(0, column - 1); c <= right; ++c) compare(c, r, grid, 0, visit);
  }
}

}  // namespace trident::nav
