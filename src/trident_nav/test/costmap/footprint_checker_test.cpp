// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/footprint_checker.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "costmap_fixture.h"
#include "trident_nav/core/footprint.h"
#include "trident_nav/costmap/inflation_layer.h"
#include "trident_nav/costmap/static_layer.h"

namespace trident::nav {
namespace {

Costmap costmap_of(const OccupancyGrid& map, const Footprint& footprint) {
  std::vector<std::unique_ptr<Layer>> layers;
  layers.push_back(make_layer(builtin_layers(), "StaticLayer", layer_setup("map", "")));
  layers.push_back(make_layer(builtin_layers(), "InflationLayer",
                              layer_setup("inflation", "{inflation_radius: 0.3}")));
  dynamic_cast<StaticLayer*>(layers[0].get())->set_map(map);
  Costmap costmap(CostmapParams{}, std::move(layers));
  costmap.set_footprint(footprint);
  costmap.update({});
  return costmap;
}

OccupancyGrid scattered_map(int obstacles) {
  OccupancyGrid map;
  map.width = map.height = 60;
  map.resolution = 0.05;
  map.cells.assign(map.index(0, 60), 0);
  TestRandom random(4);
  for (int k = 0; k < obstacles; ++k)
    map.cells[map.index(random.below(60), random.below(60))] = 100;
  for (int k = 0; k < 10; ++k) map.cells[map.index(random.below(60), random.below(60))] = -1;
  return map;
}

class FootprintCheckerTest : public ::testing::TestWithParam<const char*> {
 protected:
  static Footprint footprint() {
    const std::string text = GetParam();
    return text.front() == '[' ? polygon_footprint(parse_polygon(text))
                               : circle_footprint(std::stod(text));
  }
};

TEST_P(FootprintCheckerTest, EveryAnswerIsThatOfTheCells) {
  const Costmap costmap = costmap_of(scattered_map(25), footprint());
  const CostGrid grid = costmap.grid();
  FootprintChecker checker(grid, footprint());
  ShapeCells shape;
  TestRandom random(8);
  int contacts = 0;
  for (int k = 0; k < 20000; ++k) {
    const Pose2 pose{random.uniform(-0.2, 3.2), random.uniform(-0.2, 3.2),
                     random.uniform(-3.2, 3.2)};
    bool is_lethal = false, is_unknown = false, is_outside = false;
    int highest = 0;
    for (const CellRun& run : shape.footprint(grid.geometry, footprint(), pose)) {
      for (int x = run.x0; x < run.x1; ++x) {
        if (!grid.geometry.contains({x, run.y})) {
          is_outside = true;
          continue;
        }
        const int cost = grid.at(Cell{x, run.y});
        is_lethal |= cost == kLethalCost;
        is_unknown |= cost == kUnknownCost;
        if (cost < kLethalCost) highest = std::max(highest, cost);
      }
    }
    const bool has_center = grid.geometry.contains(grid.geometry.cell(pose.x, pose.y));
    ASSERT_EQ(checker.is_in_contact(pose), is_lethal || !has_center)
        << pose.x << ' ' << pose.y << ' ' << pose.yaw;
    const Contact expected = !has_center  ? Contact::kOutside
                             : is_lethal  ? Contact::kLethal
                             : is_outside ? Contact::kOutside
                             : is_unknown ? Contact::kUnknown
                                          : Contact::kFree;
    ASSERT_EQ(checker.contact(pose), expected);
    const int cost = is_lethal || is_outside || !has_center ? kLethalCost
                     : is_unknown                           ? kUnknownCost
                                                            : highest;
    ASSERT_EQ(checker.cost(pose), cost);
    contacts += is_lethal ? 1 : 0;
  }
  EXPECT_GT(contacts, 200);
  EXPECT_LT(contacts, 19500);
}

INSTANTIATE_TEST_SUITE_P(
    Footprints, FootprintCheckerTest,
    ::testing::Values("0.18", "0.02", "[[0.21,0.155],[0.21,-0.155],[-0.21,-0.155],[-0.21,0.155]]",
                      "[[0.4,0.05],[0.4,-0.05],[-0.05,-0.05],[-0.05,0.05]]",
                      "[[0.3,0.3],[0.05,0.05],[-0.2,0.3],[-0.2,-0.2],[0.3,-0.2]]"));

TEST(FootprintCheckerTest, ARobotPassesADoorThatIsWiderByOneCell) {
  // A gap of 9 cells in a wall; the robot is 8.2 cells long and 6 wide.
  OccupancyGrid map;
  map.width = map.height = 60;
  map.resolution = 0.05;
  map.cells.assign(map.index(0, 60), 0);
  for (int y = 0; y < 60; ++y) {
    if (y < 20 || y >= 29) map.cells[map.index(30, y)] = 100;
  }
  const Footprint robot =
      polygon_footprint({{0.205, 0.15}, {-0.205, 0.15}, {-0.205, -0.15}, {0.205, -0.15}});
  const Costmap costmap = costmap_of(map, robot);
  FootprintChecker checker(costmap.grid(), robot);
  for (double x = 0.5; x < 2.5; x += 0.01) {
    EXPECT_FALSE(checker.is_in_contact({x, 24.5 * 0.05, 0.0})) << x;
    EXPECT_FALSE(checker.is_in_contact({x, 24.5 * 0.05, 1.5707963267948966})) << x;
  }
  EXPECT_TRUE(checker.is_in_contact({30.5 * 0.05, 24.5 * 0.05, 0.9}));
  EXPECT_TRUE(checker.is_in_contact({30.5 * 0.05, 24.5 * 0.05 + 0.08, 0.0}));
}

}  // namespace
}  // namespace trident::nav
