// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "../rays/water_surface.h"

namespace trident {

/// Slopes of the water's tile, and their means over squares of 2, 4, 8 ... cells with the mean
/// squares that go with them: what a pixel sees of water that is far away is a mean slope and a
/// spread about it, and neither sparkles nor repeats.
class WaterSlopes {
 public:
  struct Mean {
    Eigen::Vector2f slope = Eigen::Vector2f::Zero();  ///< along the tile's rows and columns
    float square = 0.0F;                              ///< mean of its squared length
  };
  /// Slopes at the time that `water` follows. Cheap when nothing changed.
  void follow(const WaterSurface& water);
  /// About a place, over a width.
  Mean at(const WaterSurface& water, const Eigen::Vector2d& p_world, double width_m) const;

 private:
  struct Node {
    float along, across, square;
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
  std::weak_ptr<const WaterTile> tile_;  ///< that of the slopes, with
  float weight_ = 0.0F;
};

}  // namespace trident
