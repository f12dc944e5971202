// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "water_pattern.h"
#include "water_transform.h"

namespace trident::sim {

/// Heights of the sea above its still level at the nodes of a square that repeats, at the beginning
/// and the end of one period of its pattern, with their bounds. A pure function of the pattern, the
/// anchor and the number of the period.
class WaterTile {
 public:
  struct Bounds {
    float low, high;
  };
  /// Squares of so many cells have bounds of their own.
  static constexpr std::array<int, 2> kBoundSides = {4, 32};

  /// Which tile it is.
  struct Key {
    std::int64_t anchor_row, anchor_column, period;
    bool operator==(const Key& other) const {
      return anchor_row == other.anchor_row && anchor_column == other.anchor_column &&
             period == other.period;
    }
  };

  /// To be made again.
  void begin(const Key& key, std::uint64_t serial) {
    key_ = key;
    serial_ = serial;
  }

  /// A node's heights at both ends of the period [m]; any whole numbers, as it repeats.
  const std::array<float, 2>& ends(std::int64_t row, std::int64_t column) const {
    return ends_[wrapped(row) * n_ + wrapped(column)];
  }
  /// At a node, `weight` of the period after its beginning.
  float height(std::int64_t row, std::int64_t column, float weight) const {
    const std::array<float, 2>& node = ends(row, column);
    return node[0] + weight * (node[1] - node[0]);
  }
  /// Of all points of the square of kBoundSides[level] cells, at any time of the period.
  const Bounds& bounds(std::size_t level, std::int64_t row, std::int64_t column) const {
    const std::size_t side = n_ / static_cast<std::size_t>(kBoundSides[level]);
    return bounds_[level][(static_cast<std::size_t>(row) & (side - 1)) * side +
                          (static_cast<std::size_t>(column) & (side - 1))];
  }
  const Bounds& bounds() const { return all_; }
  /// No two heights differ more from one node to the next, along rows and columns together [m].
  float steepest_step_m() const { return steepest_step_m_; }
  const Key& key() const { return key_; }
  /// Which one of those that one surface has made.
  std::uint64_t serial() const { return serial_; }

 private:
  friend class WaterTileMaker;
  std::size_t wrapped(std::int64_t i) const { return static_cast<std::size_t>(i) & (n_ - 1); }
  void find_bounds();
  void find_steepest();

  Key key_{};
  std::uint64_t serial_ = 0;
  std::size_t n_ = 0;
  std::vector<std::array<float, 2>> ends_;
  std::array<std::vector<Bounds>, 2> bounds_;
  Bounds all_{};
  float steepest_step_m_ = 0.0F;
};

/// Makes tiles of one pattern, by Fourier transforms.
class WaterTileMaker {
 public:
  /// pattern.n > 0
  explicit WaterTileMaker(const WaterPattern& pattern);
  const WaterPattern& pattern() const { return pattern_; }
  /// What belongs to the tile's key.
  void make(WaterTile& tile);

 private:
  struct Moment {
    Eigen::Vector2d p_world_anchor;
    double time_s;
  };
  void transform_elevations(const std::array<Moment, 2>& ends);
  void transform_displacements(const Moment& moment);
  void bend(std::size_t end, WaterTile& tile) const;

  WaterPattern pattern_;
  WaterTransform transform_;
  ComplexGrid elevations_;     ///< at the beginning of the period, and as imaginary part at its end
  ComplexGrid displacements_;  ///< Gerstner: of particles, along the rows, and across them
};

}  // namespace trident::sim
