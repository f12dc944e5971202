// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"
#include "trident_nav/costmap/layer.h"
#include "trident_nav/costmap/layer_factory.h"

namespace trident::nav {

struct StaticLayerParams {
  bool enabled = true;
  std::string map_topic = "map";
  bool first_map_only = false;
  bool subscribe_to_updates = false;
  bool track_unknown_space = true;
  bool use_maximum = false;
  int lethal_cost_threshold = 100;
  int unknown_cost_value = -1;
  bool trinary_costmap = true;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("enabled", enabled, "the layer leaves costs");
    ar.field("map_topic", map_topic, "topic of the map");
    ar.field("first_map_only", first_map_only, "maps after the first are not used");
    ar.field("subscribe_to_updates", subscribe_to_updates,
             "parts of maps are taken from <map>_updates");
    ar.field("track_unknown_space", track_unknown_space,
             "unknown cells stay so; else they are free");
    ar.field("use_maximum", use_maximum,
             "the higher cost stays; else the map's replaces all below");
    ar.field("lethal_cost_threshold", lethal_cost_threshold, Range{0, 100},
             "occupancy from which on a cell is lethal [%]");
    ar.field("unknown_cost_value", unknown_cost_value, Range{-1, 255},
             "occupancy that means unknown");
    ar.field("trinary_costmap", trinary_costmap,
             "cells are free, lethal or unknown; else costs rise with occupancy");
  }
};

/// The costs of an occupancy grid. Unless the costmap's window rolls, the costmap takes the grid's
/// geometry.
class StaticLayer : public CellLayer {
 public:
  using Params = StaticLayerParams;

  /// Read at the start alone: what subscribes to the map, and what the map's cells are made with.
  static constexpr std::array kFixedKeys = {
      "map_topic",           "first_map_only",        "subscribe_to_updates",
      "track_unknown_space", "lethal_cost_threshold", "unknown_cost_value",
      "trinary_costmap"};

  explicit StaticLayer(const LayerSetup& setup);

  const Params& params() const { return params_; }
  /// Takes `enabled` and `use_maximum` over.
  void set_params(const Params& params);

  /// Takes a map. Returns false when it is not used because of first_map_only. Throws Error when
  /// the map's numbers of cells do not fit its size or its resolution is not positive.
  bool set_map(const OccupancyGrid& map);
  /// Replaces the occupancies of a part of the map, rows without gaps. Throws Error unless the part
  /// lies in the map and has as many cells as its size says.
  void update_map(const CellBox& part, const std::vector<std::int8_t>& occupancy);
  /// Where a map's frame is in the costmap's from now on: a rolling window in the odometry's frame
  /// drifts against the map.
  void set_map_pose(const SE2& T_costmap_map);
  bool has_map() const { return !costs_.empty(); }

  std::optional<GridGeometry> wanted_geometry() const override;
  void resize(const GridGeometry& geometry) override;
  void update(const CostmapInput& input, BlockSet& changed) override;
  void combine(int y, int x0, int x1, std::uint8_t* cost) const override;

 private:
  void fill_table();
  /// The map's cells are cells of the costmap, too, unless its axes are turned.
  GridGeometry map_in_costmap() const;
  bool is_turned() const;
  void place();
  void sample();
  void put_row(const std::uint8_t* from, int count, std::uint8_t* cost) const;
  bool is_in_place(const OccupancyGrid& map) const;
  bool is_inside(const CellBox& part) const;
  void replace_row(int y, int x0, int x1, const std::int8_t* occupancy);

  Params params_;
  std::array<std::uint8_t, 256> table_{};  // costs by occupancy as an unsigned byte
  GridGeometry map_;                       // in the axes of the map's cells
  SE2 T_map_grid_;                         // of the corner of the map's cell (0, 0)
  SE2 T_costmap_map_;
  std::vector<std::uint8_t> costs_;  // of the map's cells
  GridGeometry geometry_;            // of the costmap
  // Of the costmap's cells unless those are the map's shifted; empty if they are.
  std::vector<std::uint8_t> sampled_;
  Cell offset_;       // of the costmap's cell (0, 0) in the map
  BlockSet changed_;  // of the costmap, since the last update
};

}  // namespace trident::nav
