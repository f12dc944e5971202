// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/potential/potential_cells.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

#include "core/byte_rows.h"

namespace trident::nav {
namespace {

/// Arrays of this size and more are given large pages: their cells are too far apart for the
/// processor to remember where all small ones lie.
constexpr std::size_t kLarge = std::size_t{1} << 23U;
constexpr std::size_t kLargePage = std::size_t{1} << 21U;

constexpr int kSide = PotentialCells::kSide;
constexpr int kStep = sizeof(Bytes);

/// Of a row of a square, whether a cell and those next to it are equal; not for the first and the
/// last cell.
struct EqualRow {
  explicit EqualRow(const std::uint8_t* row) {
    for (int k = 0; k < kSide / kStep; ++k) {
      const std::uint8_t* from = row + k * kStep;
      const Bytes here = load_bytes(from);
      cells[k] = (here == load_bytes(from - 1)) & (here == load_bytes(from + 1));
    }
  }
  Bytes cells[kSide / kStep];
};

/// Whether the nine cells about a cell are equal, for those that are not along the sides of a
/// square. A byte before the costs and one behind them are read.
void mark_even(const std::uint8_t* costs, std::uint8_t* even) {
  EqualRow below(costs), own(costs + kSide);
  for (int y = 1; y < kSide - 1; ++y) {
    const std::uint8_t* row = costs + y * kSide;
    const EqualRow above(row + kSide);
    for (int k = 0; k < kSide / kStep; ++k) {
      const std::uint8_t* from = row + k * kStep;
      const Bytes here = load_bytes(from);
      const auto column = (here == load_bytes(from - kSide)) & (here == load_bytes(from + kSide));
      store_bytes(even + y * kSide + k * kStep,
                  below.cells[k] & own.cells[k] & above.cells[k] & column);
    }
    even[y * kSide] = even[y * kSide + kSide - 1] = 0;
    below = own;
    own = above;
  }
}

}  // namespace

void PotentialCells::Free::operator()(void* memory) const { std::free(memory); }

template <class Item>
PotentialCells::Array<Item> PotentialCells::make_array(std::size_t count) {
  const std::size_t pages = (count * sizeof(Item) + kLargePage - 1) / kLargePage;
  const bool is_large = count * sizeof(Item) >= kLarge;
  void* memory = is_large ? std::aligned_alloc(kLargePage, pages * kLargePage)
                          : std::malloc(count * sizeof(Item));
  if (memory == nullptr) throw std::bad_alloc();
  if (is_large) ::madvise(memory, pages * kLargePage, MADV_HUGEPAGE);  // a request, no more
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
    costs_ = make_array<std::uint8_t>(needed + 2 * kMargin);
    allocated_ = needed;
  }
  slots_.assign(columns_ * rows_, kNoSlot);
  borders_.clear();
  borders_.reserve(columns_ * rows_);  // so that none moves
}

void PotentialCells::fill_neighbors(int x, int y, const CostGrid& grid) {
  Border& border = borders_[slots_[square(x, y)]];
  const std::size_t side = side_of(x, y);
  const auto own = static_cast<std::ptrdiff_t>(index(x, y));
  for (std::size_t d = 0; d < 8; ++d) {
    fill(x + kDx[d], y + kDy[d], grid);
    border.offsets[side][d] = static_cast<std::ptrdiff_t>(index(x + kDx[d], y + kDy[d])) - own;
  }
  border.ready |= 1U << side;
}

void PotentialCells::fill(int x, int y, const CostGrid& grid) {
  if (is_filled(x, y)) return;
  const std::size_t number = borders_.size();
  slots_[square(x, y)] = static_cast<std::uint32_t>(number);
  borders_.emplace_back();
  std::uint8_t* costs = &costs_[kMargin + number * kNodes];
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
  std::array<std::uint8_t, kNodes> even{};
  mark_even(costs, even.data());
  Node* nodes = &nodes_[number * kNodes];
  for (std::size_t i = 0; i < kNodes; ++i) {
    nodes[i] = {kUnreached, costs[i], kNoParent, false, even[i] != 0};
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
  nodes_[i].cost = costs_[kMargin + i] = cost;
  const int column = x % kSide, row = y % kSide;
  for (int r = std::max(1, row - 1); r <= std::min(kSide - 2, row + 1); ++r) {
    for (int c = std::max(1, column - 1); c <= std::min(kSide - 2, column + 1); ++c) {
      Node* node = &nodes_[i] + (r - row) * kSide + (c - column);
      node->is_even = is_even_at(node);
    }
  }
}

}  // namespace trident::nav
