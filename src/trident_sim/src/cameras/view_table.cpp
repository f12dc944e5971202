// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "view_table.h"

#include <algorithm>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

Eigen::Vector2d direction_of(const CameraModel& model, int column, int row,
                             const std::string& owner) {
  const auto direction = model.back_project(Eigen::Vector2d(column, row));
  if (direction) return *direction;
  throw Error(owner +
              ": the distortion is too strong for the angle of view: nothing appears just " +
              "once at pixel " + std::to_string(column) + ", " + std::to_string(row));
}

}  // namespace

ViewTable::ViewTable(const CameraModel& model, const std::string& owner)
    : tile_columns_((model.width + kSide - 1) / kSide) {
  const int tile_rows = (model.height + kSide - 1) / kSide;
  tiles_.resize(static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows));
  for (int row = 0; row < tile_rows * kSide; ++row) {
    for (int column = 0; column < tile_columns_ * kSide; ++column) {
      const Eigen::Vector2d direction = direction_of(model, std::min(column, model.width - 1),
                                                     std::min(row, model.height - 1), owner);
      Tile& tile =
          tiles_[static_cast<std::size_t>(row / kSide) * static_cast<std::size_t>(tile_columns_) +
                 static_cast<std::size_t>(column / kSide)];
      const std::size_t lane = lane_of(column, row);
      tile.x[lane] = static_cast<float>(direction.x());
      tile.y[lane] = static_cast<float>(direction.y());
    }
  }
}

}  // namespace trident::sim
