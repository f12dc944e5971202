// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace trident::sim {

/// A picture that surfaces are covered with, over and over; with itself at a half, a quarter, ...
/// of its size, for where it is seen from afar.
struct Texture {
  struct Level {
    int columns = 0, rows = 0;
    std::vector<std::uint8_t> rgba;  ///< row by row from the top; the fourth is not used
  };
  std::vector<Level> levels;  ///< the picture as read, then smaller and smaller ones

  /// Red, green, blue in [0, 1], linear between the middles of four pixels; v upwards.
  /// `width_px`: pixels of the picture as read that one ray stands for.
  Eigen::Vector3f at(const Eigen::Vector2f& uv, float width_px = 0.0F) const;
};

/// Reads a PNG or a JPEG; what it has of transparency is left out. Throws Error with the file's
/// name.
Texture read_texture(const std::string& file);

}  // namespace trident::sim
