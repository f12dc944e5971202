// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// What every layer must do. A new layer has one line in kLayers.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "costmap_fixture.h"
#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/range_sensor_layer.h"
#include "trident_nav/costmap/static_layer.h"

namespace trident::nav {
namespace {

/// Gives a layer data of a moment, of which there are many.
using Feed = std::function<void(Layer&, TestRandom&, double now_s, const Pose2& robot)>;

struct LayerCase {
  const char* plugin;
  const char* yaml;
  Feed feed;
};

void feed_nothing(Layer& /*layer*/, TestRandom& /*random*/, double /*now_s*/,
                  const Pose2& /*robot*/) {}

void feed_map(Layer& layer, TestRandom& random, double /*now_s*/, const Pose2& /*robot*/) {
  OccupancyGrid map;
  map.width = 45;
  map.height = 40;
  map.resolution = 0.1;
  map.T_map_origin = SE2::from_xy_yaw(-2.0, -2.0, 0.0);
  for (int i = 0; i < 45 * 40; ++i) {
    const int draw = random.below(30);
    map.cells.push_back(static_cast<std::int8_t>(draw == 0 ? 100 : (draw == 1 ? -1 : 0)));
  }
  dynamic_cast<StaticLayer&>(layer).set_map(map);
}

void feed_beams(Layer& layer, TestRandom& random, double now_s, const Pose2& robot) {
  Observation observation;
  observation.stamp_s = now_s;
  for (int i = 0; i < 100; ++i) {
    const double angle = random.uniform(0.0, 6.283), range = random.uniform(0.2, 4.0);
    const Eigen::Vector3d p(range * std::cos(angle), range * std::sin(angle),
                            random.uniform(-0.5, 2.5));
    observation.ends.push_back({p.cast<float>(), random.below(5) != 0});
  }
  observation.groups.push_back({{robot.x, robot.y, 0.3}, 0, 100});
  dynamic_cast<BeamLayer&>(layer).sources()[0].add(std::move(observation));
}

void feed_ranges(Layer& layer, TestRandom& random, double now_s, const Pose2& robot) {
  for (int i = 0; i < 4; ++i) {
    RangeReading reading;
    reading.stamp_s = now_s;
    reading.field_of_view = 0.5;
    reading.max_range = 2.0;
    reading.range = random.uniform(0.1, 2.0);
    reading.T_costmap_sensor =
        SE3::from_xyz_rpy({robot.x, robot.y, 0.2}, 0.0, 0.0, random.uniform(-3.0, 3.0));
    dynamic_cast<RangeSensorLayer&>(layer).add_reading(0, reading);
  }
}

const char* const kBeams =
    "{sources: {scan: {clearing: true, raytrace_range: 3.0, obstacle_range: 2.5}}}";

const std::vector<LayerCase> kLayers{
    {"DenoiseLayer", "{minimal_group_size: 3}", feed_nothing},
    {"InflationLayer", "{inflation_radius: 0.35, cost_scaling_factor: 4}", feed_nothing},
    {"ObstacleLayer", kBeams, feed_beams},
    {"RangeSensorLayer", "{topics: [/sonar]}", feed_ranges},
    {"StaticLayer", "{use_maximum: true}", feed_map},
    {"VoxelLayer", kBeams, feed_beams},
};

class LayerConformanceTest : public ::testing::TestWithParam<LayerCase> {
 protected:
  /// A costmap of the layer above a map and beams, and below a layer of beams.
  static Costmap costmap(bool is_rolling) {
    std::vector<std::unique_ptr<Layer>> layers;
    layers.push_back(make_layer(builtin_layers(), "ObstacleLayer", layer_setup("below", kBeams)));
    layers.push_back(
        make_layer(builtin_layers(), GetParam().plugin, layer_setup("tested", GetParam().yaml)));
    layers.push_back(make_layer(builtin_layers(), "ObstacleLayer", layer_setup("above", kBeams)));
    CostmapParams params;
    params.width = 4.5;
    params.height = 4.0;
    params.origin_x = params.origin_y = -2.0;
    params.resolution = 0.1;
    params.robot_radius = 0.1;
    params.rolling_window = is_rolling;
    return {params, std::move(layers)};
  }
  static void feed(Costmap& costmap, TestRandom& random, double now_s, const Pose2& robot) {
    feed_beams(*costmap.layer("below"), random, now_s, robot);
    if (random.below(3) == 0) feed_beams(*costmap.layer("above"), random, now_s, robot);
    GetParam().feed(*costmap.layer("tested"), random, now_s, robot);
  }
  static Pose2 robot_at(int round, bool is_rolling) {
    return is_rolling ? Pose2{0.037 * round, -0.021 * round, 0.1} : Pose2{0.1, 0.2, 0.3};
  }
  static std::vector<std::uint8_t> costs(const Costmap& costmap) {
    return {costmap.grid().cost, costmap.grid().cost + costmap.grid().geometry.size()};
  }
};

TEST_P(LayerConformanceTest, ChangesGiveWhatAFullComputationGives) {
  for (const bool is_rolling : {false, true}) {
    TestRandom random_a(6), random_b(6);
    Costmap kept = costmap(is_rolling), renewed = costmap(is_rolling);
    for (int round = 0; round < 20; ++round) {
      const Pose2 robot = robot_at(round, is_rolling);
      feed(kept, random_a, 0.1 * round, robot);
      feed(renewed, random_b, 0.1 * round, robot);
      kept.update({0.1 * round, robot});
      // Switched off and on again, every stage above computes all cells.
      for (const auto& layer : renewed.layers()) layer->set_enabled(false);
      renewed.update({0.1 * round, robot});
      for (const auto& layer : renewed.layers()) layer->set_enabled(true);
      renewed.update({0.1 * round, robot});
      ASSERT_EQ(costs(kept), costs(renewed)) << GetParam().plugin << " in round " << round;
      const std::size_t cells = kept.grid().geometry.size();
      for (std::size_t i = 0; i < cells; ++i) {
        ASSERT_EQ(kept.grid().distance_m[i], renewed.grid().distance_m[i]);
      }
    }
  }
}

TEST_P(LayerConformanceTest, ChangedBlocksAreThoseWhoseCostsChanged) {
  TestRandom random(7);
  Costmap map = costmap(false);
  map.update({});
  for (int round = 0; round < 15; ++round) {
    const std::vector<std::uint8_t> before = costs(map);
    const auto revision = map.grid().revision;
    if (round % 3 != 0) feed(map, random, 0.1 * round, robot_at(0, false));
    map.update({0.1 * round, robot_at(0, false)});
    const std::vector<std::uint8_t> after = costs(map);
    const GridGeometry& grid = map.grid().geometry;
    for (int y = 0; y < grid.height && !map.has_moved(); ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const std::size_t i = grid.index({x, y});
        if (before[i] == after[i]) continue;
        ASSERT_TRUE(map.changed().contains(x, y));
        ASSERT_EQ(map.grid().row_revisions[y], map.grid().revision);
      }
    }
    if (before != after) EXPECT_NE(map.grid().revision, revision);
  }
}

TEST_P(LayerConformanceTest, WhatIsSwitchedOffLeavesTheCostsBelow) {
  TestRandom random_a(8), random_b(8);
  Costmap with = costmap(false), without = costmap(false);
  without.layer("tested")->set_enabled(false);
  for (int round = 0; round < 5; ++round) {
    feed(with, random_a, 0.1 * round, {});
    feed(without, random_b, 0.1 * round, {});
    with.update({0.1 * round, {}});
    without.update({0.1 * round, {}});
  }
  with.layer("tested")->set_enabled(false);
  with.update({0.5, {}});
  without.update({0.5, {}});
  EXPECT_EQ(costs(with), costs(without));
}

TEST_P(LayerConformanceTest, ForgettingAllAndFeedingNothingLeavesNoTrace) {
  if (std::string(GetParam().plugin) == "StaticLayer") return;  // a map is not sensed
  TestRandom random(9);
  Costmap map = costmap(false);
  for (int round = 0; round < 5; ++round) {
    feed(map, random, 0.1 * round, {});
    map.update({0.1 * round, {}});
  }
  for (const auto& layer : map.layers()) {
    if (auto* beams = dynamic_cast<BeamLayer*>(layer.get())) {
      beams->sources()[0].add(Observation{0.6, {}, {}});
    }
    layer->forget({0, 0, 45, 40}, Layer::Side::kInside);
  }
  map.update({0.6, {}});
  EXPECT_EQ(costs(map), std::vector<std::uint8_t>(45 * 40, kFreeCost));
}

TEST_P(LayerConformanceTest, OneCellAndNoDataAreLegal) {
  std::vector<std::unique_ptr<Layer>> layers;
  layers.push_back(
      make_layer(builtin_layers(), GetParam().plugin, layer_setup("tested", GetParam().yaml)));
  CostmapParams params;
  params.width = params.height = params.resolution = 0.1;
  Costmap map(params, std::move(layers));
  map.update({});
  EXPECT_EQ(costs(map), std::vector<std::uint8_t>(1, kFreeCost));
}

TEST_P(LayerConformanceTest, UnknownKeysAndWrongTypesAreErrors) {
  EXPECT_THROW(make_layer(builtin_layers(), GetParam().plugin, layer_setup("a", "{nonsense: 1}")),
               ConfigError);
  EXPECT_THROW(make_layer(builtin_layers(), GetParam().plugin, layer_setup("a", "{enabled: 7}")),
               ConfigError);
  EXPECT_NO_THROW(
      make_layer(builtin_layers(), GetParam().plugin, layer_setup("a", "{enabled: 0}")));
}

INSTANTIATE_TEST_SUITE_P(All, LayerConformanceTest, ::testing::ValuesIn(kLayers),
                         [](const auto& info) { return std::string(info.param.plugin); });

TEST(LayerRegistryTest, EachLayerIsInTheConformanceSuite) {
  std::vector<std::string> tested;
  for (const LayerCase& layer : kLayers) tested.emplace_back(layer.plugin);
  EXPECT_EQ(builtin_layers().names(), tested);
}

}  // namespace
}  // namespace trident::nav
