// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sea_rays/water_surface.h"

namespace trident::sim {

/// Slopes of the water's tile, and their means over squares of 2, 4, 8 ... cells with the mean
/// squares that go with them: what a pixel sees of water that is far away is a mean slope and a
/// spread about it, and neither sparkles nor repeats.
class WaterSlopes {
 public:
  /// In the tile's axes, as if the sea were at its full strength.
  struct Mean {
    Eigen::Vector2f slope;  ///< along the tile's rows and columns
    float square;           ///< mean of its squared length
    float spread() const { return std::max(square - slope.squaredNorm(), 0.0F); }
    Mean times(float factor) const { return {factor * slope, factor * factor * square}; }
  };
  /// Slopes at the time that `water` follows. Cheap when nothing changed.
  void follow(const WaterSurface& water);

  // Where the water is not flat.

  /// About a place, over a width.
  Mean at(const Eigen::Vector2d& p_world, double width_m) const;
  /// Of all slopes.
  float mean_square() const { return levels_.empty() ? 0.0F : levels_.back().nodes[0].square(); }
  Eigen::Vector2f in_world(const Eigen::Vector2f& slope) const {
    return slope.x() * axis_.cast<float>() + slope.y() * across_.cast<float>();
  }

 private:
  /// Slope along the tile's rows and columns, its squared length, and nothing, for the sake of
  /// vector instructions.
  struct alignas(16) Node {
    std::array<float, 4> values{};
    float along() const { return values[0]; }
    float across() const { return values[1]; }
    float square() const { return values[2]; }
  };
  struct Level {
    std::size_t n = 0;
    std::vector<Node> nodes;  ///< row by row
  };
  void find_slopes(const WaterSurface& water);
  static void halve(const Level& fine, Level& coarse);
  static Node between(const Level& level, float u, float v);

  std::vector<Level> levels_;
  std::vector<float> heights_;
  std::uint64_t serial_ = 0;  ///< of the tile that the slopes are of, with
  float weight_ = 0.0F;
  double length_m_ = 1.0, cell_m_ = 1.0;  ///< of the tile
  Eigen::Vector2d axis_ = Eigen::Vector2d::UnitX(), across_ = Eigen::Vector2d::UnitY();
};

}  // namespace trident::sim
