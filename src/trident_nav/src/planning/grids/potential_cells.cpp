// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/potential_cells.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace trident::nav {
namespace {

/// Arrays of this size and more are given large pages: their cells are too far apart for the
/// processor to remember where all small ones lie.
constexpr std::size_t kLarge = std::size_t{1} << 23U;
constexpr std::size_t kLargePage = std::size_t{1} << 21U;

}  // namespace

void PotentialCells::Free::operator()(void* memory) const { std::free(memory); }

template <class Item>
PotentialCells::Array<Item> PotentialCells::make_array(std::size_t count) {
  const std::size_t pages = (count * sizeof(Item) + kLargePage - 1) / kLargePage;
  const bool is_large = count * sizeof(Item) >= kLarge;
  void* memory = is_large ? std::aligned_alloc(kLargePage, pages * kLargePage)
                          : std::malloc(count * sizeof(Item));
  if (memory == nullptr) throw std::bad_alloc();
  if (is_large) ::madvise(memory, pages * kLargePage, MADV_HUGEPAGE);  // no more than a wish
  return Array<Item>(static_cast<Item*>(memory));
}

void PotentialCells::reset(const GridGeometry& geometry) {
  geometry_ = geometry;
  columns_ = static_cast<std::size_t>(geometry.width + 2 + kSide - 1) / kSide;
  rows_ = static_cast<std::size_t>(geometry.height + 2 + kSide - 1) / kSide;
  const std::size_t needed = columns_ * rows_ * kNodes;
  if (needed > allocated_) {
    nodes_.reset();
    costs_.reset();
    nodes_ = make_array<Node>(needed);
    costs_ = make_array<std::uint8_t>(needed);
    allocated_ = needed;
  }
  is_filled_.assign(columns_ * rows_, 0);
}

void PotentialCells::fill_neighbors(int x, int y, const CostGrid& grid) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) fill(x + dx, y + dy, grid);
  }
}

void PotentialCells::fill(int x, int y, const CostGrid& grid) {
  const std::size_t number = square(x, y);
  if (is_filled_[number] != 0) return;
  is_filled_[number] = 1;
  std::uint8_t* costs = &costs_[number * kNodes];
  std::memset(costs, kLethalCost, kNodes);
  const int x0 = x / kSide * kSide, y0 = y / kSide * kSide;
  const int from = std::max(x0, first());
  const int to = std::min(x0 + kSide, end(geometry_.width));
  const int last = std::min(y0 + kSide, end(geometry_.height));
  for (int row = std::max(y0, first()); row < last && from < to; ++row) {
    std::memcpy(costs + (row - y0) * kSide + (from - x0),
                grid.cost + geometry_.index({from - 1, row - 1}),
                static_cast<std::size_t>(to - from));
  }
  Node* nodes = &nodes_[number * kNodes];
  for (std::size_t i = 0; i < kNodes; ++i) nodes[i] = {kUnreached, costs[i], kNoParent, false, false};
  mark_even(number);
}

void PotentialCells::mark_even(std::size_t square) {
  const std::uint8_t* costs = &costs_[square * kNodes];
  Node* nodes = &nodes_[square * kNodes];
  std::array<std::array<bool, kSide>, 3> rows{};  // Whether a cell and both beside it are equal.
  const auto compare_row = [&](int y) {
    const std::uint8_t* row = costs + y * kSide;
    for (int x = 1; x < kSide - 1; ++x) {
      rows[static_cast<std::size_t>(y % 3)][static_cast<std::size_t>(x)] =
          (row[x] == row[x - 1]) & (row[x] == row[x + 1]);
    }
  };
  compare_row(0);
  compare_row(1);
  for (int y = 1; y < kSide - 1; ++y) {
    compare_row(y + 1);
    const std::uint8_t* row = costs + y * kSide;
    for (int x = 1; x < kSide - 1; ++x) {
      const auto column = static_cast<std::size_t>(x);
      nodes[y * kSide + x].is_even = rows[0][column] & rows[1][column] & rows[2][column] &
                                     (row[x] == row[x - kSide]) & (row[x] == row[x + kSide]);
    }
  }
}

std::uint8_t PotentialCells::cost_in(const CostGrid& grid, int x, int y) const {
  const bool is_inside =
      x >= first() && y >= first() && x < end(geometry_.width) && y < end(geometry_.height);
  return is_inside ? grid.at(Cell{x - 1, y - 1}) : kLethalCost;
}

bool PotentialCells::is_even_at(const Node* node) const {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (node[dy * kSide + dx].cost != node->cost) return false;
    }
  }
  return true;
}

void PotentialCells::set_cost(int x, int y, std::uint8_t cost) {
  const std::size_t i = index(x, y);
  nodes_[i].cost = costs_[i] = cost;
  const int column = x % kSide, row = y % kSide;
  for (int r = std::max(1, row - 1); r <= std::min(kSide - 2, row + 1); ++r) {
    for (int c = std::max(1, column - 1); c <= std::min(kSide - 2, column + 1); ++c) {
      Node* node = &nodes_[i] + (r - row) * kSide + (c - column);
      node->is_even = is_even_at(node);
    }
  }
}

}  // namespace trident::nav
