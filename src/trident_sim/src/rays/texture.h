// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace trident {

/// A picture that surfaces are covered with, over and over.
struct Texture {
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> rgb;  ///< row by row from the top

  /// Red, green, blue in [0, 1], linear between the middles of four pixels; v upwards.
  Eigen::Vector3d at(const Eigen::Vector2f& uv) const;
};

/// Reads a PNG; what it has of transparency is left out. Throws Error with the file's name.
Texture read_texture(const std::string& file);

}  // namespace trident
