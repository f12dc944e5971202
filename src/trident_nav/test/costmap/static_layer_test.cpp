// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/static_layer.h"

#include <string>
#include <vector>

#include "costmap_fixture.h"
#include "trident_base/error.h"

namespace trident::nav {
namespace {

using Plane = std::vector<std::uint8_t>;

/// The costs of one row of occupancies.
Plane costs_of(const std::string& yaml, const std::vector<std::int8_t>& occupancy) {
  auto layer = new_layer<StaticLayer>(yaml);
  OccupancyGrid map;
  map.width = static_cast<int>(occupancy.size());
  map.height = 1;
  map.resolution = 1.0;
  map.cells = occupancy;
  layer->set_map(map);
  layer->resize(*layer->wanted_geometry());
  Plane row(occupancy.size(), 7);
  layer->combine(0, 0, map.width, row.data());
  return row;
}

TEST(StaticLayerTest, OccupanciesBecomeCostsAsInCostmap2d) {
  EXPECT_EQ(costs_of("", {-1, 0, 50, 99, 100}), (Plane{255, 0, 0, 0, 254}));
  EXPECT_EQ(costs_of("{track_unknown_space: false}", {-1, 0}), (Plane{0, 0}));
  EXPECT_EQ(costs_of("{lethal_cost_threshold: 50}", {49, 50, 51}), (Plane{0, 254, 254}));
  EXPECT_EQ(costs_of("{trinary_costmap: false}", {-1, 0, 50, 99, 100}),
            (Plane{255, 0, 127, 251, 254}));
  EXPECT_EQ(costs_of("{unknown_cost_value: 7}", {7, 0}), (Plane{255, 0}));
  EXPECT_EQ(costs_of("{use_maximum: true}", {-1, 0, 100}), (Plane{7, 7, 254}));
}

TEST(StaticLayerTest, TheCostmapTakesTheMapsGeometry) {
  auto layer = new_layer<StaticLayer>();
  EXPECT_FALSE(layer->wanted_geometry());
  OccupancyGrid map = map_of({"..", "#."}, 0.5);
  map.T_map_origin = SE2::from_xy_yaw(3.0, -1.0, 0.0);
  ASSERT_TRUE(layer->set_map(map));
  const GridGeometry grid = *layer->wanted_geometry();
  EXPECT_EQ(grid.width, 2);
  EXPECT_EQ(grid.height, 2);
  EXPECT_EQ(grid.resolution, 0.5);
  EXPECT_EQ(grid.origin_x, 3.0);
  EXPECT_EQ(grid.origin_y, -1.0);
}

TEST(StaticLayerTest, ATurnedMapFillsTheBoxAroundIt) {
  auto layer = new_layer<StaticLayer>();
  OccupancyGrid map = map_of({"#.", "..", ".."});
  map.T_map_origin = SE2::from_xy_yaw(0.0, 0.0, 1.5707963267948966);
  layer->set_map(map);
  const GridGeometry grid = *layer->wanted_geometry();
  EXPECT_EQ(grid.width, 3);
  EXPECT_EQ(grid.height, 2);
  layer->resize(grid);
  Plane row(3, 7);
  layer->combine(0, 0, 3, row.data());
  // The map's first column, from its top row down, is the box's lowest row from the left.
  EXPECT_EQ(row, (Plane{254, 0, 0}));
}

TEST(StaticLayerTest, OutsideOfTheMapAWindowKeepsWhatIsBelow) {
  auto layer = new_layer<StaticLayer>();
  layer->set_map(map_of({"#?"}));
  for (const double origin : {-1.0, -1.25}) {  // by whole cells, and sampled
    layer->resize({4, 1, 1.0, origin, origin + 1.0});
    Plane row(4, 7);
    layer->combine(0, 0, 4, row.data());
    EXPECT_EQ(row, (Plane{7, 254, 255, 7})) << origin;
  }
}

TEST(StaticLayerTest, AnUpdateChangesItsBlocksAlone) {
  auto layer = new_layer<StaticLayer>();
  OccupancyGrid map;
  map.width = 64;
  map.height = 3;
  map.resolution = 1.0;
  map.cells.assign(192, 0);
  layer->set_map(map);
  layer->resize(*layer->wanted_geometry());
  BlockSet changed(64, 3);
  layer->update({}, changed);
  EXPECT_EQ(changed.count(), 12U);
  changed.clear();
  layer->update_map({20, 1, 22, 3}, {100, 0, 0, 0});
  layer->update({}, changed);
  EXPECT_EQ(changed.count(), 1U);
  EXPECT_TRUE(changed.contains(20, 1));
  changed.clear();
  map.cells[map.index(50, 2)] = 100;
  map.cells[map.index(20, 1)] = 100;
  layer->set_map(map);
  layer->update({}, changed);
  EXPECT_EQ(changed.count(), 1U);
  EXPECT_TRUE(changed.contains(50, 2));
}

TEST(StaticLayerTest, MapsThatDoNotFitAreRefused) {
  auto layer = new_layer<StaticLayer>();
  OccupancyGrid map = map_of({".."});
  map.cells.pop_back();
  EXPECT_THROW(layer->set_map(map), Error);
  map = map_of({".."});
  map.resolution = 0.0;
  EXPECT_THROW(layer->set_map(map), Error);
  layer->set_map(map_of({".."}));
  EXPECT_THROW(layer->update_map({1, 0, 3, 1}, {0, 0}), Error);
  EXPECT_THROW(layer->update_map({0, 0, 2, 1}, {0}), Error);
}

TEST(StaticLayerTest, FirstMapOnly) {
  auto layer = new_layer<StaticLayer>("{first_map_only: true}");
  EXPECT_TRUE(layer->set_map(map_of({".."})));
  EXPECT_FALSE(layer->set_map(map_of({"..."})));
  EXPECT_EQ(layer->wanted_geometry()->width, 2);
}

}  // namespace
}  // namespace trident::nav
