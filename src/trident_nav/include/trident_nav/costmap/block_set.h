// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trident::nav {

/// Cells [x0, x1) x [y0, y1).
struct CellBox {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  bool empty() const { return x0 >= x1 || y0 >= y1; }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

/// Which parts of a grid changed: a set of blocks, each of up to 16 neighboring cells of one row.
/// What is done for a set costs in proportion to its blocks, not to its bounding box.
class BlockSet {
 public:
  static constexpr int kCells = 16;  ///< Cells of a block; those that end a row may have fewer.

  BlockSet() = default;
  BlockSet(int width, int height) { resize(width, height); }

  /// Empties the set and gives it the size of a grid [cells].
  void resize(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  void clear();
  bool empty() const { return first_row_ >= end_row_; }
  /// True when the block of a cell is in the set; the cell lies in the grid.
  bool contains(int x, int y) const {
    const int block = x / kCells;
    return (row(y)[block / 64] >> (block % 64) & 1U) != 0;
  }
  /// Adds the block of a cell; the cell lies in the grid.
  void insert(int x, int y) {
    const int block = x / kCells;
    touch(y);
    row(y)[block / 64] |= std::uint64_t{1} << (block % 64);
  }
  /// Removes the block of a cell; the cell lies in the grid.
  void erase(int x, int y) {
    const int block = x / kCells;
    row(y)[block / 64] &= ~(std::uint64_t{1} << (block % 64));
  }
  /// Adds the blocks of the cells [x0, x1) of a row, which may reach beyond the grid at its sides.
  void insert_span(int y, int x0, int x1);
  void insert_all();
  /// Adds the blocks of another set for a grid of the same size.
  void insert(const BlockSet& other);

  /// The smallest box that has all blocks.
  CellBox bounds() const;
  /// Number of blocks.
  std::size_t count() const;

  /// Calls visit(y, x0, x1) for each run of neighboring blocks, with its cells [x0, x1), x0 a
  /// multiple of kCells; by rows, then from left to right.
  template <class Visit>
  void for_each_span(Visit&& visit) const {
    for (int y = first_row_; y < end_row_; ++y) {
      for (int block = next(y, 0, true); block < blocks_;) {
        const int end = next(y, block, false);
        const int x1 = end * kCells;
        visit(y, block * kCells, x1 < width_ ? x1 : width_);
        block = next(y, end, true);
      }
    }
  }

 private:
  std::uint64_t* row(int y) { return bits_.data() + static_cast<std::ptrdiff_t>(y) * words_; }
  const std::uint64_t* row(int y) const {
    return bits_.data() + static_cast<std::ptrdiff_t>(y) * words_;
  }
  void touch(int y) {
    if (y < first_row_) first_row_ = y;
    if (y >= end_row_) end_row_ = y + 1;
  }
  /// The first block from `block` on that is in the set (or is not); blocks_ without one.
  int next(int y, int block, bool present) const;

  int width_ = 0, height_ = 0;
  int blocks_ = 0;                   // of a row
  int words_ = 0;                    // of a row
  int first_row_ = 0, end_row_ = 0;  // all blocks lie in these rows
  std::vector<std::uint64_t> bits_;
};

}  // namespace trident::nav
