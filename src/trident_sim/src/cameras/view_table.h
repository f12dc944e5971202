// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "../rays/ray_packet.h"
#include "camera_model.h"

namespace trident::sim {

/// Directions of a picture's pixels, in tiles of 4 x 4 that are cast as one packet: tile by tile in
/// rows from the upper left; so are lanes within a tile.
class ViewTable {
 public:
  static constexpr int kSide = 4;
  struct Tile {
    /// Where the ray of each lane hits the plane z = 1 of the optical frame. Lanes beyond the edge
    /// of the picture are copies of the last pixel within.
    alignas(64) PacketFloats x, y;
  };

  /// Throws Error that begins with `owner` when the distortion does not determine where a pixel
  /// looks.
  ViewTable(const CameraModel& model, const std::string& owner);

  /// Of a pixel in its tile.
  static std::size_t lane_of(int column, int row) {
    constexpr auto kWide = static_cast<unsigned>(kSide);
    return static_cast<unsigned>(row) % kWide * kWide + static_cast<unsigned>(column) % kWide;
  }

  int tile_columns() const { return tile_columns_; }
  int tile_rows() const { return static_cast<int>(tiles_.size()) / tile_columns_; }
  const Tile& tile(int column, int row) const {
    return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(tile_columns_) +
                  static_cast<std::size_t>(column)];
  }

 private:
  int tile_columns_;
  std::vector<Tile> tiles_;
};

}  // namespace trident::sim
