// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// A part of a ray, in cells: the points origin + t (dx, dy) for t in [t0, t1].
struct RayPart {
  double x, y;
  double dx, dy;
  double t0 = 0.0, t1 = 1.0;

  bool empty() const { return !(t0 <= t1); }
  /// Shortens the part to where low <= from + t step <= high.
  void clip(double from, double step, double low, double high) {
    const double to = from + step;
    if (from >= low && from <= high && to >= low && to <= high) return;
    if (step == 0.0) {
      t1 = -1.0;
      return;
    }
    const double a = (low - from) / step, b = (high - from) / step;
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  /// Shortens the part to lengths along the ground from low to high, of the whole ray's `length`.
  void clip_length(double length, double low, double high) {
    if (low > 0.0) t0 = std::max(t0, length > 0.0 ? low / length : 1.0 + low);
    if (length > high) t1 = std::min(t1, high / length);
  }
  /// Shortens the part to a grid of so many cells.
  void clip_to(int width, int height) {
    constexpr double kInside = 1e-5;  // more than steps in fixed point may err along a ray
    clip(x, dx, kInside, width - kInside);
    clip(y, dy, kInside, height - kInside);
  }
};

/// The largest whole number that is not above a value of moderate size: std::floor is a call
/// without SSE 4.1.
inline std::int64_t fast_floor(double value) {
  const auto truncated = static_cast<std::int64_t>(value);
  return truncated - (value < static_cast<double>(truncated) ? 1 : 0);
}

/// Calls visit(index) for the cells along a part of a ray that lies in the grid, from its begin to
/// its end: one for each column where the ray is rather horizontal, for each row where it is rather
/// vertical, namely the one that the ray passes in the column's (row's) middle; the cells of the
/// part's ends are always among them. `is_open`: the last cell is left out.
template <class Visit>
void walk_cells(const RayPart& ray, int width, bool is_open, Visit&& visit) {
  const bool is_flat = std::abs(ray.dx) >= std::abs(ray.dy);
  const double along = is_flat ? ray.x : ray.y, across = is_flat ? ray.y : ray.x;
  const double d_along = is_flat ? ray.dx : ray.dy, d_across = is_flat ? ray.dy : ray.dx;
  const double first = along + ray.t0 * d_along, last = along + ray.t1 * d_along;
  const auto begin = fast_floor(first);
  const auto end = fast_floor(last);
  const std::int64_t stride_along = is_flat ? 1 : width, stride_across = is_flat ? width : 1;
  const auto cell = [&](std::int64_t a, double c) {
    return static_cast<std::size_t>(a * stride_along + fast_floor(c) * stride_across);
  };
  if (begin != end || !is_open) visit(cell(begin, across + ray.t0 * d_across));
  if (begin == end) return;
  const std::int64_t sign = end > begin ? 1 : -1;
  constexpr double kFixed = 4294967296.0;  // 2^32: fractions of a cell in fixed point
  const double slope = d_across / d_along;
  const double start = across + (static_cast<double>(begin + sign) + 0.5 - along) * slope;
  auto fixed = static_cast<std::int64_t>(start * kFixed);
  const auto step = static_cast<std::int64_t>(slope * kFixed * static_cast<double>(sign));
  const std::int64_t stride = stride_along * sign;
  std::int64_t line = (begin + sign) * stride_along;
  for (std::int64_t k = std::abs(end - begin) - 1; k > 0; --k) {
    visit(static_cast<std::size_t>(line + (fixed >> 32) * stride_across));
    line += stride;
    fixed += step;
  }
  if (!is_open) visit(cell(end, across + ray.t1 * d_across));
}

}  // namespace trident::nav
