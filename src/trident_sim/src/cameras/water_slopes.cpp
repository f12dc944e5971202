// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_slopes.h"

#include <algorithm>
#include <cmath>

namespace trident::sim {
namespace {

/// Neighbors in a tile that repeats; n is a power of two.
std::size_t below(std::size_t i, std::size_t n) { return (i + n - 1) & (n - 1); }
std::size_t above(std::size_t i, std::size_t n) { return (i + 1) & (n - 1); }

int whole(float value) {
  const int cut = static_cast<int>(value);
  return cut - (value < static_cast<float>(cut) ? 1 : 0);
}

}  // namespace

void WaterSlopes::follow(const WaterSurface& water) {
  if (water.tile() == nullptr) {
    levels_.clear();
    return;
  }
  const std::uint64_t serial = water.tile()->serial();
  // Several cameras may look at one tile, which changes less often than the time.
  if (serial_ == serial && weight_ == water.weight() && !levels_.empty()) return;
  serial_ = serial;
  weight_ = water.weight();
  length_m_ = water.pattern().length_m;
  cell_m_ = water.pattern().cell_m;
  axis_ = water.pattern().axis;
  across_ = water.pattern().across;
  find_slopes(water);
  std::size_t level = 0;
  // A pyramid as of mip maps, down to one node with the mean of the whole tile.
  for (; levels_[level].n > 1; ++level) {
    if (levels_.size() == level + 1) levels_.emplace_back();
    halve(levels_[level], levels_[level + 1]);
  }
  levels_.resize(level + 1);
}

/// Central differences of the heights.
void WaterSlopes::find_slopes(const WaterSurface& water) {
  const std::size_t n = water.pattern().n;
  const WaterTile& tile = *water.tile();
  heights_.resize(n * n);
  for (std::size_t i = 0; i < n * n; ++i) {
    heights_[i] =
        tile.height(static_cast<std::int64_t>(i / n), static_cast<std::int64_t>(i % n), weight_);
  }
  if (levels_.empty()) levels_.emplace_back();
  Level& fine = levels_.front();
  fine.n = n;
  fine.nodes.resize(n * n);
  const auto per_m = static_cast<float>(0.5 / water.pattern().cell_m);
  for (std::size_t row = 0; row < n; ++row) {
    const float* const before = &heights_[below(row, n) * n];
    const float* const here = &heights_[row * n];
    const float* const after = &heights_[above(row, n) * n];
    for (std::size_t column = 0; column < n; ++column) {
      const float along = per_m * (after[column] - before[column]);
      const float across = per_m * (here[above(column, n)] - here[below(column, n)]);
      // The squared slope is averaged along: less the square of the mean slope it is the variance
      // that a pixel does not resolve.
      fine.nodes[row * n + column] = {{along, across, along * along + across * across, 0.0F}};
    }
  }
}

void WaterSlopes::halve(const Level& fine, Level& coarse) {
  const std::size_t n = fine.n / 2;
  coarse.n = n;
  coarse.nodes.resize(n * n);
  for (std::size_t row = 0; row < n; ++row) {
    const Node* const low = &fine.nodes[2 * row * fine.n];
    const Node* const high = low + fine.n;
    for (std::size_t i = 0; i < n; ++i) {
      const auto &a = low[2 * i].values, &b = low[2 * i + 1].values;
      const auto &c = high[2 * i].values, &d = high[2 * i + 1].values;
      Node& mean = coarse.nodes[row * n + i];
      for (std::size_t k = 0; k < 4; ++k) mean.values[k] = 0.25F * (a[k] + b[k] + c[k] + d[k]);
    }
  }
}

/// Bilinear; u and v in units of the level's nodes.
WaterSlopes::Node WaterSlopes::between(const Level& level, float u, float v) {
  const int row = whole(u), column = whole(v);
  const float p = u - static_cast<float>(row), q = v - static_cast<float>(column);
  const std::size_t mask = level.n - 1;
  const auto i = static_cast<std::size_t>(row) & mask;
  const auto j = static_cast<std::size_t>(column) & mask;
  const Node* const low = &level.nodes[i * level.n];
  const Node* const high = &level.nodes[((i + 1) & mask) * level.n];
  const std::size_t next = (j + 1) & mask;
  const float a = (1.0F - p) * (1.0F - q), b = (1.0F - p) * q, c = p * (1.0F - q), d = p * q;
  const auto &low0 = low[j].values, &low1 = low[next].values;
  const auto &high0 = high[j].values, &high1 = high[next].values;
  Node mean;
  for (std::size_t k = 0; k < 4; ++k) {
    mean.values[k] = a * low0[k] + b * low1[k] + c * high0[k] + d * high1[k];
  }
  return mean;
}

WaterSlopes::Mean WaterSlopes::at(const Eigen::Vector2d& p_world, double width_m) const {
  // Within one tile, so that floats are fine enough.
  const auto n = static_cast<double>(levels_.front().n);
  const auto cells = [&](const Eigen::Vector2d& axis) {
    const double turns = axis.dot(p_world) / length_m_;
    return static_cast<float>((turns - static_cast<double>(floor_of(turns))) * n);
  };
  const float u = cells(axis_), v = cells(across_);
  const auto most = static_cast<float>(levels_.size() - 1);
  const float level =
      std::min(std::log2(std::max(static_cast<float>(width_m / cell_m_), 1.0F)), most);
  const auto fine = static_cast<std::size_t>(level);
  const float share = level - static_cast<float>(fine);
  // Nodes of a coarser level lie amidst those that they are means of.
  const auto sample = [&](std::size_t number) {
    const float scale = 1.0F / static_cast<float>(std::size_t{1} << number);
    return between(levels_[number], (u + 0.5F) * scale - 0.5F, (v + 0.5F) * scale - 0.5F);
  };
  // Between two levels as well, so that no line shows where the level changes.
  const Node a = sample(fine);
  if (share == 0.0F) return {{a.along(), a.across()}, a.square()};
  const Node b = sample(fine + 1);
  Node mean;
  for (std::size_t k = 0; k < 4; ++k) {
    mean.values[k] = a.values[k] + share * (b.values[k] - a.values[k]);
  }
  return {{mean.along(), mean.across()}, mean.square()};
}

}  // namespace trident::sim
