// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "growing_grid.h"

namespace trident::slam {

/// A grid over whole-numbered cells, in tiles that exist where it was written to. A copy shares its
/// tiles with the original until one of them writes: many maps that differ in few places are cheap.
template <class T>
class TiledGrid {
 public:
  static constexpr int kTileBits = 5;
  static constexpr int kTileSide = 1 << kTileBits;
  using Tile = std::array<T, static_cast<std::size_t>(kTileSide* kTileSide)>;

  /// `T{}` where nothing was written.
  T get(int x, int y) const {
    const std::int32_t tile = index_.get(x >> kTileBits, y >> kTileBits);
    return tile == 0 ? T{} : (*tiles_[static_cast<std::size_t>(tile - 1)])[cell_index(x, y)];
  }
  T& at(int x, int y) { return own_tile(x >> kTileBits, y >> kTileBits)[cell_index(x, y)]; }

  struct Extent {
    int min_x = 0;
    int min_y = 0;
    int width = 0;
    int height = 0;
  };
  /// Of the tiles that exist [cells].
  Extent extent() const {
    int left = INT_MAX, bottom = INT_MAX, right = INT_MIN, top = INT_MIN;
    for (int y = index_.min_y(); y < index_.min_y() + index_.height(); ++y) {
      for (int x = index_.min_x(); x < index_.min_x() + index_.width(); ++x) {
        if (index_.get(x, y) == 0) continue;
        left = std::min(left, x);
        right = std::max(right, x);
        bottom = std::min(bottom, y);
        top = std::max(top, y);
      }
    }
    if (right < left) return {};
    return {left * kTileSide, bottom * kTileSide, (right - left + 1) * kTileSide,
            (top - bottom + 1) * kTileSide};
  }

  /// (x, y); (x + 1, y) is one, (x, y + 1) `kTileSide` further. Null where they are not all in one
  /// tile that exists.
  const T* square(int x, int y) const {
    constexpr int kMask = kTileSide - 1;
    if ((x & kMask) == kMask || (y & kMask) == kMask) return nullptr;
    const std::int32_t tile = index_.get(x >> kTileBits, y >> kTileBits);
    if (tile == 0) return nullptr;
    return tiles_[static_cast<std::size_t>(tile - 1)]->data() + cell_index(x, y);
  }

  /// Writes to cells of which each is near the one before. The grid must not be copied meanwhile.
  class Pen {
   public:
    explicit Pen(TiledGrid& grid) : grid_(grid) {}
    T& at(int x, int y) {
      const int tile_x = x >> kTileBits;
      const int tile_y = y >> kTileBits;
      if (tile_ == nullptr || tile_x != tile_x_ || tile_y != tile_y_) {
        tile_ = &grid_.own_tile(tile_x, tile_y);
        tile_x_ = tile_x;
        tile_y_ = tile_y;
      }
      return (*tile_)[cell_index(x, y)];
    }

   private:
    TiledGrid& grid_;
    typename TiledGrid::Tile* tile_ = nullptr;
    int tile_x_ = 0;
    int tile_y_ = 0;
  };

 private:
  static std::size_t cell_index(int x, int y) {
    constexpr int kMask = kTileSide - 1;
    const auto row = static_cast<std::size_t>(y & kMask);
    const auto column = static_cast<std::size_t>(x & kMask);
    return row * kTileSide + column;
  }
  Tile& own_tile(int tile_x, int tile_y) {
    std::int32_t& number = index_.at(tile_x, tile_y);
    if (number == 0) {
      tiles_.push_back(std::make_shared<Tile>());
      number = static_cast<std::int32_t>(tiles_.size());
    }
    std::shared_ptr<Tile>& tile = tiles_[static_cast<std::size_t>(number - 1)];
    if (tile.use_count() > 1) tile = std::make_shared<Tile>(*tile);
    return *tile;
  }

  GrowingGrid<std::int32_t> index_;  ///< 1 + place in tiles_, 0: none
  std::vector<std::shared_ptr<Tile>> tiles_;
};

}  // namespace trident::slam
