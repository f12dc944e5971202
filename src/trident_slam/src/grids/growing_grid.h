// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/error.h"

namespace trident::slam {

/// A dense grid over whole-numbered cells that grows where it is written to; a cell that was never
/// written to reads as `T{}`.
template <class T>
class GrowingGrid {
 public:
  bool contains(int x, int y) const {
    return x >= min_x_ && y >= min_y_ && x < min_x_ + width_ && y < min_y_ + height_;
  }
  T get(int x, int y) const { return contains(x, y) ? cells_[index(x, y)] : T{}; }

  T& at(int x, int y) {
    if (!contains(x, y)) grow(x, y, x, y);
    return cells_[index(x, y)];
  }
  /// Makes room for the rectangle that includes both corners.
  void reserve(int x0, int y0, int x1, int y1) {
    if (!contains(x0, y0) || !contains(x1, y1)) grow(x0, y0, x1, y1);
  }
  /// The cell of (x, y), which must be inside.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - min_y_) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x - min_x_);
  }

  int min_x() const { return min_x_; }
  int min_y() const { return min_y_; }
  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<T>& cells() const { return cells_; }
  std::vector<T>& cells() { return cells_; }

 private:
  /// A gibibyte: one place far away would take all memory.
  static constexpr double kMaxBytes = 1073741824.0;

  /// Of a rectangle of cells.
  struct Extent {
    std::int64_t left, bottom, right, top;
  };

  Extent joined_with(const Extent& other) const {
    if (cells_.empty()) return other;
    return {std::min<std::int64_t>(other.left, min_x_),
            std::min<std::int64_t>(other.bottom, min_y_),
            std::max<std::int64_t>(other.right, min_x_ + width_),
            std::max<std::int64_t>(other.top, min_y_ + height_)};
  }

  /// Throws Error, and stays as it is, for a size that no map can have.
  void check_size(const Extent& added) const {
    const auto [left, bottom, right, top] = joined_with(added);
    const auto columns = static_cast<double>(right - left),
               rows = static_cast<double>(top - bottom);
    constexpr std::int64_t kFarthest = 1 << 30;
    const bool is_near =
        left > -kFarthest && bottom > -kFarthest && right < kFarthest && top < kFarthest;
    if (is_near && columns * rows * sizeof(T) <= kMaxBytes) return;
    throw Error("a grid of the map would have " + std::to_string(right - left) + " x " +
                std::to_string(top - bottom) + " cells from (" + std::to_string(left) + ", " +
                std::to_string(bottom) + "), legal: up to 2^30 bytes, numbers below 2^30");
  }

  /// The first and last cells with room for the rectangle that includes both corners, and a margin
  /// on the sides where that is more than there is.
  Extent grown(int x0, int y0, int x1, int y1) const {
    constexpr int kMargin = 32;
    if (cells_.empty()) return {x0 - kMargin, y0 - kMargin, x1 + kMargin, y1 + kMargin};
    const int end_x = min_x_ + width_ - 1;
    const int end_y = min_y_ + height_ - 1;
    return {x0 < min_x_ ? x0 - kMargin : min_x_, y0 < min_y_ ? y0 - kMargin : min_y_,
            x1 > end_x ? x1 + kMargin : end_x, y1 > end_y ? y1 + kMargin : end_y};
  }

  /// Grows in steps of 64 cells, so that a map that spreads is copied seldom.
  void grow(int x0, int y0, int x1, int y1) {
    check_size({x0, y0, x1, y1});
    const Extent extent = grown(x0, y0, x1, y1);
    GrowingGrid bigger;
    bigger.min_x_ = static_cast<int>(extent.left);
    bigger.min_y_ = static_cast<int>(extent.bottom);
    bigger.width_ = static_cast<int>(extent.right - extent.left + 1);
    bigger.height_ = static_cast<int>(extent.top - extent.bottom + 1);
    bigger.cells_.assign(static_cast<std::size_t>(bigger.width_) * bigger.height_, T{});
    for (int row = 0; row < height_; ++row) {
      const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(row) * width_;
      std::copy(
          begin, begin + width_,
          bigger.cells_.begin() + static_cast<std::ptrdiff_t>(bigger.index(min_x_, min_y_ + row)));
    }
    *this = std::move(bigger);
  }

  int min_x_ = 0;
  int min_y_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<T> cells_;
};

}  // namespace trident::slam
