// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/costmap.h"

#include <string>
#include <utility>
#include <vector>

#include "costmap_fixture.h"
#include "trident_base/error.h"
#include "trident_nav/costmap/inflation_layer.h"
#include "trident_nav/costmap/obstacle_layer.h"
#include "trident_nav/costmap/published_cost.h"
#include "trident_nav/costmap/static_layer.h"

namespace trident::nav {
namespace {

using Layers = std::vector<std::unique_ptr<Layer>>;

CostmapParams params_of(double size_m, double resolution) {
  CostmapParams params;
  params.width = params.height = size_m;
  params.resolution = resolution;
  params.robot_radius = 0.9 * resolution;
  params.footprint_padding = 0.0;
  return params;
}

std::unique_ptr<Layer> layer(const std::string& type, const std::string& name,
                             const std::string& yaml = "") {
  return make_layer(builtin_layers(), "costmap_2d::" + type, layer_setup(name, yaml));
}

void expect_distances(const CostGrid& grid) {
  const std::vector<std::uint8_t> cost(grid.cost, grid.cost + grid.geometry.size());
  for (int y = 0; y < grid.geometry.height; ++y) {
    for (int x = 0; x < grid.geometry.width; ++x) {
      const int square = nearest_square(cost, grid.geometry, {x, y});
      const double cut = static_cast<double>(grid.max_distance_m);
      const double exact =
          square < 0 ? cut : std::min(cut, std::sqrt(square) * grid.geometry.resolution);
      ASSERT_FLOAT_EQ(grid.distance_m[grid.geometry.index({x, y})], static_cast<float>(exact));
    }
  }
}

TEST(CostmapTest, AMapWithItsInflation) {
  Layers layers;
  layers.push_back(layer("StaticLayer", "static_layer"));
  layers.push_back(
      layer("InflationLayer", "inflation", "{inflation_radius: 2.0, cost_scaling_factor: 1.0}"));
  CostmapParams params = params_of(10.0, 1.0);
  params.robot_radius = 1.0;
  Costmap costmap(params, std::move(layers));
  dynamic_cast<StaticLayer*>(costmap.layer("static_layer"))
      ->set_map(map_of({".....", "?....", "#....", "....."}));
  costmap.update({});
  EXPECT_TRUE(costmap.has_moved());
  EXPECT_EQ(rows_of(costmap.grid()),
            (std::vector<std::vector<int>>{
                {92, 0, 0, 0, 0}, {253, 166, 0, 0, 0}, {254, 253, 92, 0, 0}, {253, 166, 0, 0, 0}}));
  expect_distances(costmap.grid());
  const auto revision = costmap.grid().revision;
  costmap.update({});
  EXPECT_EQ(costmap.grid().revision, revision);
  EXPECT_TRUE(costmap.changed().empty());
}

TEST(CostmapTest, LayersAboveTheInflationAreNotInflated) {
  Layers layers;
  layers.push_back(layer("InflationLayer", "inflation", "{inflation_radius: 2.0}"));
  layers.push_back(layer("StaticLayer", "static_layer", "{use_maximum: true}"));
  Costmap costmap(params_of(3.0, 1.0), std::move(layers));
  dynamic_cast<StaticLayer*>(costmap.layer("static_layer"))->set_map(map_of({"#..", "..?", "..."}));
  costmap.update({});
  EXPECT_EQ(rows_of(costmap.grid()),
            (std::vector<std::vector<int>>{{254, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
  expect_distances(costmap.grid());  // of the master costs, all the same
}

TEST(CostmapTest, ALayerThatIsSwitchedOffLeavesNothing) {
  Layers layers;
  layers.push_back(layer("StaticLayer", "static_layer"));
  layers.push_back(layer("InflationLayer", "inflation", "{inflation_radius: 1.0}"));
  Costmap costmap(params_of(3.0, 1.0), std::move(layers));
  dynamic_cast<StaticLayer*>(costmap.layer("static_layer"))->set_map(map_of({"#.."}));
  costmap.layer("inflation")->set_enabled(false);
  costmap.update({});
  EXPECT_EQ(rows_of(costmap.grid()), (std::vector<std::vector<int>>{{254, 0, 0}}));
  expect_distances(costmap.grid());
  costmap.layer("static_layer")->set_enabled(false);
  costmap.layer("inflation")->set_enabled(true);
  costmap.update({});
  EXPECT_EQ(rows_of(costmap.grid()), (std::vector<std::vector<int>>{{0, 0, 0}}));
  costmap.layer("static_layer")->set_enabled(true);
  costmap.update({});
  EXPECT_EQ(costmap.grid().at(Cell{0, 0}), 254);
  EXPECT_NE(costmap.grid().at(Cell{1, 0}), 0);
}

void add_points(Costmap& costmap, const Eigen::Vector3d& origin,
                const std::vector<Eigen::Vector2d>& ends, double stamp_s) {
  Observation observation;
  observation.stamp_s = stamp_s;
  for (const auto& end : ends) {
    const Eigen::Vector3d p = Eigen::Vector3d(end.x(), end.y(), origin.z()) - origin;
    observation.ends.push_back({p.cast<float>(), true});
  }
  observation.groups.push_back({origin, 0, ends.size()});
  dynamic_cast<ObstacleLayer*>(costmap.layer("obstacles"))
      ->sources()[0]
      .add(std::move(observation));
}

Costmap rolling_costmap(bool is_rolling) {
  Layers layers;
  layers.push_back(layer("ObstacleLayer", "obstacles", "{sources: {scan: {clearing: true}}}"));
  layers.push_back(
      layer("InflationLayer", "inflation", "{inflation_radius: 0.55, cost_scaling_factor: 5.0}"));
  CostmapParams params = params_of(6.0, 0.1);
  params.rolling_window = is_rolling;
  if (!is_rolling) params.origin_x = params.origin_y = -3.0;
  return {params, std::move(layers)};
}

TEST(CostmapTest, AWindowRollsByWholeCellsAndKeepsItsMarks) {
  Costmap costmap = rolling_costmap(true);
  costmap.update({0.0, {0.03, 0.0, 0.0}});
  add_points(costmap, {0.0, 0.0, 0.2}, {{1.25, 0.35}, {-2.05, 1.15}}, 0.0);
  costmap.update({0.0, {0.03, 0.0, 0.0}});
  EXPECT_EQ(costmap.grid().at(1.25, 0.35), kLethalCost);
  EXPECT_EQ(costmap.grid().at(-2.05, 1.15), kLethalCost);
  add_points(costmap, {1.0, -0.7, 0.2}, {}, 0.1);
  costmap.update({0.1, {1.04, -0.73, 0.4}});
  EXPECT_NEAR(std::remainder(costmap.grid().geometry.origin_x, 0.1), 0.0, 1e-9);
  EXPECT_NEAR(costmap.grid().geometry.origin_x, 1.04 - 3.0, 0.1);
  EXPECT_EQ(costmap.grid().at(1.25, 0.35), kLethalCost);
  EXPECT_EQ(costmap.grid().at(-2.05, 1.15), kUnknownCost);  // outside now
  costmap.update({0.2, {0.0, 0.0, 0.4}});
  EXPECT_EQ(costmap.grid().at(-2.05, 1.15), kFreeCost);  // forgotten
}

TEST(CostmapTest, ARollingWindowHasTheCostsOfAFixedMap) {
  // As long as no obstacle leaves the window, both know the same.
  Costmap fixed = rolling_costmap(false), rolling = rolling_costmap(true);
  TestRandom random(5);
  for (int round = 0; round < 8; ++round) {
    const Pose2 robot{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0.0};
    std::vector<Eigen::Vector2d> ends;
    for (int k = 0; k < 40; ++k) {
      const double angle = random.uniform(0.0, 6.28), range = random.uniform(0.3, 2.0);
      ends.emplace_back(robot.x + range * std::cos(angle), robot.y + range * std::sin(angle));
    }
    for (Costmap* costmap : {&fixed, &rolling}) {
      add_points(*costmap, {robot.x, robot.y, 0.2}, ends, 0.1 * round);
      costmap->update({0.1 * round, robot});
    }
    for (double x = -2.45; x < 2.5; x += 0.1) {
      for (double y = -2.45; y < 2.5; y += 0.1) {
        ASSERT_EQ(fixed.grid().at(x, y), rolling.grid().at(x, y)) << x << ' ' << y;
      }
    }
    expect_distances(rolling.grid());
    expect_distances(fixed.grid());
  }
}

TEST(CostmapTest, MarksSurviveAMapThatGrows) {
  Layers layers;
  layers.push_back(layer("StaticLayer", "static_layer"));
  layers.push_back(layer("ObstacleLayer", "obstacles",
                         "{footprint_clearing_enabled: false, sources: {scan: {}}}"));
  Costmap costmap(params_of(4.0, 1.0), std::move(layers));
  auto* map_layer = dynamic_cast<StaticLayer*>(costmap.layer("static_layer"));
  map_layer->set_map(map_of({"....", "...."}));
  add_points(costmap, {0.5, 0.5, 0.2}, {{2.5, 1.5}}, 0.0);
  costmap.update({});
  EXPECT_EQ(costmap.grid().at(2.5, 1.5), kLethalCost);
  add_points(costmap, {0.5, 0.5, 0.2}, {}, 0.1);
  OccupancyGrid larger = map_of({"......", "......", "......"});
  larger.T_map_origin = SE2::from_xy_yaw(-1.0, 0.0, 0.0);
  map_layer->set_map(larger);
  costmap.update({});
  EXPECT_EQ(costmap.grid().geometry.width, 6);
  EXPECT_EQ(costmap.grid().at(2.5, 1.5), kLethalCost);
  // Of another resolution.
  OccupancyGrid finer = map_of(std::vector<std::string>(6, std::string(12, '.')), 0.5);
  finer.T_map_origin = larger.T_map_origin;
  map_layer->set_map(finer);
  costmap.update({});
  EXPECT_EQ(costmap.grid().geometry.resolution, 0.5);
  EXPECT_EQ(costmap.grid().at(2.5, 1.5), kLethalCost);
  EXPECT_EQ(costmap.grid().at(1.9, 1.5), kFreeCost);
}

TEST(CostmapTest, ForgettingRemovesWhatIsStaleAndKeepsWhatIsSeen) {
  Costmap costmap = rolling_costmap(false);
  costmap.update({});
  add_points(costmap, {0.0, 0.0, 0.2}, {{1.25, 0.05}, {0.05, 2.05}}, 0.0);
  costmap.update({});
  add_points(costmap, {0.0, 0.0, 0.2}, {{-1.05, 0.05}}, 0.1);
  costmap.update({0.1, {}});
  EXPECT_EQ(costmap.forget({0.0, 0.0}, 3.0, Layer::Side::kOutside, {"obstacles"}),
            std::vector<std::string>{"obstacles"});
  costmap.update({0.2, {}});
  EXPECT_EQ(costmap.grid().at(1.25, 0.05), kLethalCost);
  EXPECT_NE(costmap.grid().at(0.05, 2.05), kLethalCost);
  costmap.forget({0.0, 0.0}, 3.0, Layer::Side::kInside);
  costmap.update({0.3, {}});
  EXPECT_NE(costmap.grid().at(1.25, 0.05), kLethalCost);
  EXPECT_EQ(costmap.grid().at(-1.05, 0.05), kLethalCost);
  expect_distances(costmap.grid());
  EXPECT_TRUE(costmap.forget({0.0, 0.0}, 3.0, Layer::Side::kInside, {"obstacle_layer"}).empty());
}

TEST(CostmapTest, ParametersThatCannotBeAreRefused) {
  CostmapParams params = params_of(1.0, 2.0);
  EXPECT_THROW(Costmap(params, {}), Error);
  params = params_of(1.0, 0.1);
  params.footprint = "[[0, 0], [1, 1]]";
  EXPECT_THROW(Costmap(params, {}), Error);
  Layers twice;
  twice.push_back(layer("StaticLayer", "a"));
  twice.push_back(layer("StaticLayer", "a"));
  EXPECT_THROW(Costmap(params_of(1.0, 0.1), std::move(twice)), Error);
}

TEST(CostmapTest, CostsAsTheyArePublished) {
  const std::vector<int> costs{0, 1, 128, 252, 253, 254, 255};
  const std::vector<int> expected{0, 1, 50, 98, 99, 100, -1};
  for (std::size_t i = 0; i < costs.size(); ++i) {
    EXPECT_EQ(published_cost(static_cast<std::uint8_t>(costs[i])), expected[i]);
  }
}

TEST(CostmapTest, AnUnknownPluginListsTheKnownOnes) {
  try {
    layer("StaticLayr", "a");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("InflationLayer, ObstacleLayer"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace trident::nav
