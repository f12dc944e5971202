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

  /// Throws Error, and stays as it is, for a size that no map can have.
  void check_size(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) const {
    const bool is_empty = cells_.empty();
    const std::int64_t left = is_empty ? x0 : std::min<std::int64_t>(x0, min_x_);
    const std::int64_t bottom = is_empty ? y0 : std::min<std::int64_t>(y0, min_y_);
    const std::int64_t right = is_empty ? x1 : std::max<std::int64_t>(x1, min_x_ + width_);
    const std::int64_t top = is_empty ? y1 : std::max<std::int64_t>(y1, min_y_ + height_);
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

  /// Grows in steps of 64 cells, so that a map that spreads is copied seldom.
  void grow(int x0, int y0, int x1, int y1) {
    check_size(x0, y0, x1, y1);
    constexpr int kMargin = 32;
    const bool is_empty = cells_.empty();
    const int new_min_x = is_empty || x0 < min_x_ ? x0 - kMargin : min_x_;
    const int new_min_y = is_empty || y0 < min_y_ ? y0 - kMargin : min_y_;
    const int end_x = is_empty ? x1 : min_x_ + width_ - 1;
    const int end_y = is_empty ? y1 : min_y_ + height_ - 1;
    const int new_end_x = is_empty || x1 > end_x ? x1 + kMargin : end_x;
    const int new_end_y = is_empty || y1 > end_y ? y1 + kMargin : end_y;
    GrowingGrid bigger;
    bigger.min_x_ = new_min_x;
    bigger.min_y_ = new_min_y;
    bigger.width_ = new_end_x - new_min_x + 1;
    bigger.height_ = new_end_y - new_min_y + 1;
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
