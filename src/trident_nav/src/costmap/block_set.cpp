// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/block_set.h"

#include <algorithm>

namespace trident::nav {
namespace {

/// Bits [from, to) of a word, 0 <= from < to <= 64.
std::uint64_t bit_range(int from, int to) {
  const std::uint64_t up_to = to == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << to) - 1;
  return up_to & ~((std::uint64_t{1} << from) - 1);
}

}  // namespace

void BlockSet::resize(int width, int height) {
  width_ = width;
  height_ = height;
  blocks_ = (width + kCells - 1) / kCells;
  words_ = (blocks_ + 63) / 64;
  bits_.assign(static_cast<std::size_t>(words_) * static_cast<std::size_t>(height), 0);
  first_row_ = height_;
  end_row_ = 0;
}

void BlockSet::clear() {
  if (!empty()) std::fill(row(first_row_), row(end_row_ - 1) + words_, 0);
  first_row_ = height_;
  end_row_ = 0;
}

void BlockSet::insert_span(int y, int x0, int x1) {
  x0 = std::max(x0, 0);
  x1 = std::min(x1, width_);
  if (x0 >= x1) return;
  const int first = x0 / kCells, end = (x1 + kCells - 1) / kCells;
  touch(y);
  for (int word = first / 64; word * 64 < end; ++word) {
    const int base = word * 64;
    row(y)[word] |= bit_range(std::max(first - base, 0), std::min(end - base, 64));
  }
}

void BlockSet::insert_all() {
  for (int y = 0; y < height_; ++y) insert_span(y, 0, width_);
}

void BlockSet::insert(const BlockSet& other) {
  if (other.empty()) return;
  first_row_ = std::min(first_row_, other.first_row_);
  end_row_ = std::max(end_row_, other.end_row_);
  std::uint64_t* to = row(other.first_row_);
  const std::uint64_t* end = other.row(other.end_row_ - 1) + words_;
  for (const std::uint64_t* from = other.row(other.first_row_); from != end; ++from, ++to) {
    *to |= *from;
  }
}

CellBox BlockSet::bounds() const {
  CellBox box{width_, height_, 0, 0};
  for_each_span([&box](int y, int x0, int x1) {
    box.x0 = std::min(box.x0, x0);
    box.x1 = std::max(box.x1, x1);
    box.y0 = std::min(box.y0, y);
    box.y1 = y + 1;
  });
  return box.empty() ? CellBox{} : box;
}

std::size_t BlockSet::count() const {
  std::size_t sum = 0;
  for (int y = first_row_; y < end_row_; ++y) {
    for (int word = 0; word < words_; ++word) {
      sum += static_cast<std::size_t>(__builtin_popcountll(row(y)[word]));
    }
  }
  return sum;
}

int BlockSet::next(int y, int block, bool present) const {
  const std::uint64_t flip = present ? 0 : ~std::uint64_t{0};
  while (block < blocks_) {
    const int bit = block % 64;
    const std::uint64_t found = (row(y)[block / 64] ^ flip) >> bit;
    if (found != 0) return std::min(block + __builtin_ctzll(found), blocks_);
    block += 64 - bit;
  }
  return blocks_;
}

}  // namespace trident::nav
