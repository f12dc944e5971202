// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// A set of cells with headings, one bit each, in tiles that are made where they are needed.
class StateSet {
 public:
  /// Empties the set.
  void reset(const GridGeometry& geometry, std::size_t headings) {
    const int tiles_x = (geometry.width - 1) / kSide + 1;
    const int tiles_y = (geometry.height - 1) / kSide + 1;
    const std::size_t words = (headings + 63) / 64;
    const auto count = static_cast<std::size_t>(tiles_x) * static_cast<std::size_t>(tiles_y);
    forget();
    if (words == words_ && tiles_.size() == count && tiles_x == tiles_x_) return;
    tiles_.clear();
    tiles_.resize(count);
    is_used_.assign(count, 0);
    tiles_x_ = tiles_x;
    words_ = words;
  }

  bool contains(int x, int y, unsigned heading) const {
    const std::size_t t = tile_of(x, y);
    return tiles_[t] != nullptr && (tiles_[t][word_of(x, y, heading)] >> (heading % 64U) & 1U) != 0;
  }

  void insert(int x, int y, unsigned heading) {
    const std::size_t t = tile_of(x, y);
    if (tiles_[t] == nullptr) tiles_[t] = std::make_unique<std::uint64_t[]>(tile_words());
    if (is_used_[t] == 0) used_.push_back(t);
    is_used_[t] = 1;
    tiles_[t][word_of(x, y, heading)] |= std::uint64_t{1} << (heading % 64U);
  }

 private:
  static constexpr int kSide = 64;
  /// So many tiles are kept for the next search.
  static constexpr std::size_t kMaxKept = 256;

  std::size_t tile_words() const { return words_ * kSide * kSide; }
  std::size_t tile_of(int x, int y) const {
    return static_cast<std::size_t>(y / kSide) * static_cast<std::size_t>(tiles_x_) +
           static_cast<std::size_t>(x / kSide);
  }
  std::size_t word_of(int x, int y, unsigned heading) const {
    const int cell = (y % kSide) * kSide + x % kSide;  // of the tile
    return static_cast<std::size_t>(cell) * words_ + heading / 64U;
  }
  void forget() {
    for (const std::size_t t : used_) {
      if (used_.size() > kMaxKept) {
        tiles_[t].reset();
      } else {
        std::fill_n(tiles_[t].get(), tile_words(), 0);
      }
      is_used_[t] = 0;
    }
    used_.clear();
  }

  int tiles_x_ = 0;
  std::size_t words_ = 0;
  std::vector<std::unique_ptr<std::uint64_t[]>> tiles_;
  std::vector<std::size_t> used_;
  std::vector<std::uint8_t> is_used_;
};

}  // namespace trident::nav
