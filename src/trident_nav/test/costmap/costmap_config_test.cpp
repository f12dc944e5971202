// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/costmap_config.h"

#include <string>
#include <vector>

#include "costmap_fixture.h"
#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/inflation_layer.h"
#include "trident_nav/costmap/static_layer.h"
#include "trident_nav/costmap/voxel_layer.h"

namespace trident::nav {
namespace {

/// A configuration, read, and the costmap that it makes.
struct Loaded {
  explicit Loaded(const std::string& yaml, const std::string& above = "{}")
      : above_map(parse_yaml(above, "test")),
        config(read_costmap_config(parse_yaml(yaml, "test"), source(), builtin_layers())),
        costmap(config.params, make_layers(config, builtin_layers())) {}

  CostmapConfigSource source() const {
    CostmapConfigSource result;
    result.label = "test";
    result.path = "/move_base/costmap";
    result.above = &above_map;
    return result;
  }
  std::vector<std::string> layers() const {
    std::vector<std::string> names;
    for (const LayerSpec& spec : config.layers) {
      names.push_back(spec.setup.name + " " + plugin_class(spec.plugin));
    }
    return names;
  }
  template <class T>
  T& layer(const std::string& name) {
    return dynamic_cast<T&>(*costmap.layer(name));
  }

  ConfigNode above_map;
  CostmapConfig config;
  Costmap costmap;
};

using Names = std::vector<std::string>;

const char* const kTurtlebotCommon =
    "obstacle_range: 3.0\nraytrace_range: 3.5\n"
    "footprint: [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]]\n"
    "inflation_radius: 1.0\ncost_scaling_factor: 3.0\nmap_type: costmap\n"
    "observation_sources: scan\n"
    "scan: {sensor_frame: base_scan, data_type: LaserScan, topic: scan, marking: true, "
    "clearing: true}\n"
    "robot_base_frame: /base_footprint\nupdate_frequency: 10.0\npublish_frequency: 10.0\n"
    "transform_tolerance: 0.5\n";

TEST(CostmapConfigTest, Turtlebot3sFilesWithoutPlugins) {
  Loaded global(kTurtlebotCommon + std::string("global_frame: /map\nstatic_map: true\n"));
  EXPECT_EQ(global.layers(), (Names{"static_layer StaticLayer", "obstacle_layer ObstacleLayer",
                                    "inflation_layer InflationLayer"}));
  EXPECT_EQ(global.config.warnings, Names{});
  EXPECT_EQ(global.config.params.global_frame, "map");
  EXPECT_EQ(global.config.params.robot_base_frame, "base_footprint");
  EXPECT_DOUBLE_EQ(global.costmap.footprint().inscribed_radius, 0.051);
  EXPECT_EQ(global.layer<InflationLayer>("inflation_layer").params().cost_scaling_factor, 3.0);
  const BeamSource& scan = global.layer<BeamLayer>("obstacle_layer").sources().at(0);
  EXPECT_EQ(scan.params().obstacle_range, 3.0);
  EXPECT_EQ(scan.params().raytrace_range, 3.5);
  EXPECT_TRUE(scan.params().clearing);
  EXPECT_EQ(scan.params().sensor_frame, "base_scan");

  Loaded local(kTurtlebotCommon +
               std::string("global_frame: /odom\nstatic_map: false\nrolling_window: true\n"
                           "width: 3\nheight: 3\nresolution: 0.05\n"));
  EXPECT_EQ(local.layers(),
            (Names{"obstacle_layer ObstacleLayer", "inflation_layer InflationLayer"}));
  EXPECT_EQ(local.config.warnings, Names{});
  EXPECT_EQ(local.costmap.grid().geometry.width, 60);
}

TEST(CostmapConfigTest, JackalsFileHasAWarningForEachKeyThatMeansNothing) {
  Loaded jackal(
      "map_type: costmap\norigin_z: 0.0\nz_resolution: 1\nz_voxels: 2\nobstacle_range: 2.5\n"
      "raytrace_range: 3.0\npublish_voxel_map: false\ntransform_tolerance: 0.5\n"
      "meter_scoring: true\nfootprint_padding: 0.1\nstatic_map: true\n"
      "footprint: [[-0.21, -0.165], [-0.21, 0.165], [0.21, 0.165], [0.21, -0.165]]\n"
      "plugins:\n- {name: footprint_layer, type: 'costmap_2d::FootprintLayer'}\n"
      "- {name: obstacles_layer, type: 'costmap_2d::ObstacleLayer'}\n"
      "- {name: inflater_layer, type: 'costmap_2d::InflationLayer'}\n"
      "obstacles_layer:\n  observation_sources: scan\n"
      "  scan: {sensor_frame: front_laser, data_type: LaserScan, topic: front/scan, marking: true, "
      "clearing: true, min_obstacle_height: -2.0, max_obstacle_height: 2.0}\n"
      "inflater_layer: {inflation_radius: 0.3}\n");
  EXPECT_EQ(jackal.layers(),
            (Names{"obstacles_layer ObstacleLayer", "inflater_layer InflationLayer"}));
  const std::string costmap = "/move_base/costmap/";
  EXPECT_EQ(
      jackal.config.warnings,
      (Names{costmap + "footprint_layer of type costmap_2d::FootprintLayer is left out: obstacle "
                       "layers clear the cells under the robot",
             costmap + "map_type has no effect: the types of layers are given in plugins",
             costmap + "origin_z has no effect: it is a parameter of voxel layers",
             costmap + "z_resolution has no effect: it is a parameter of voxel layers",
             costmap + "z_voxels has no effect: it is a parameter of voxel layers",
             costmap + "publish_voxel_map has no effect: it is a parameter of voxel layers",
             costmap + "meter_scoring has no effect: it is a parameter of the local planner",
             costmap + "static_map has no effect: with plugins there is a static layer only if "
                       "they name one"}));
  EXPECT_NEAR(jackal.costmap.footprint().inscribed_radius, 0.265, 1e-12);
}

TEST(CostmapConfigTest, HuskysLayersTakeRangesFromTheCostmap) {
  Loaded husky(
      "footprint: [[-0.5, -0.33], [-0.5, 0.33], [0.5, 0.33], [0.5, -0.33]]\nobstacle_range: 5.5\n"
      "raytrace_range: 6.0\nstatic: {map_topic: /map, subscribe_to_updates: true}\n"
      "obstacles_laser:\n  observation_sources: laser\n"
      "  laser: {data_type: LaserScan, clearing: true, marking: true, topic: scan, "
      "inf_is_valid: true}\ninflation: {inflation_radius: 1.0}\n"
      "rolling_window: true\nplugins:\n"
      "- {name: obstacles_laser, type: 'costmap_2d::ObstacleLayer'}\n"
      "- {name: inflation, type: 'costmap_2d::InflationLayer'}\n");
  EXPECT_EQ(husky.config.warnings,
            Names{"/move_base/costmap/static has no effect: no plugin has this name"});
  const BeamSource& laser = husky.layer<BeamLayer>("obstacles_laser").sources().at(0);
  EXPECT_EQ(laser.params().obstacle_range, 5.5);
  EXPECT_TRUE(laser.params().inf_is_valid);
}

TEST(CostmapConfigTest, Nav2sFile) {
  Loaded nav2(
      "local_costmap:\n  local_costmap:\n    ros__parameters:\n"
      "      rolling_window: true\n      width: 3\n      height: 3\n      resolution: 0.05\n"
      "      robot_radius: 0.22\n      track_unknown_space: true\n"
      "      plugins: ['voxel_layer', 'static', 'inflation_layer']\n"
      "      filters: ['keepout_filter']\n      keepout_filter: {plugin: 'a::KeepoutFilter'}\n"
      "      static: {plugin: 'nav2_costmap_2d::StaticLayer', map_subscribe_transient_local: "
      "true}\n"
      "      voxel_layer:\n        plugin: 'nav2_costmap_2d::VoxelLayer'\n"
      "        combination_method: 2\n        observation_sources: scan\n"
      "        scan: {topic: /scan, obstacle_max_range: 2.0, raytrace_max_range: 4.0, "
      "clearing: True}\n"
      "      inflation_layer: {plugin: 'nav2_costmap_2d/InflationLayer', "
      "cost_scaling_factor: 3.0}\n");
  EXPECT_EQ(nav2.layers(), (Names{"voxel_layer VoxelLayer", "static StaticLayer",
                                  "inflation_layer InflationLayer"}));
  EXPECT_EQ(nav2.config.warnings,
            (Names{"/move_base/costmap/keepout_filter has no effect: there are no costmap filters "
                   "yet",
                   "/move_base/costmap/static/map_subscribe_transient_local has no effect: maps "
                   "are latched topics here"}));
  const BeamSource& scan = nav2.layer<VoxelLayer>("voxel_layer").sources().at(0);
  EXPECT_EQ(scan.params().obstacle_range, 2.0);
  EXPECT_EQ(scan.params().raytrace_range, 4.0);
  EXPECT_EQ(scan.params().data_type, BeamDataType::kLaserScan);
  EXPECT_EQ(nav2.layer<VoxelLayer>("voxel_layer").params().combination_method, 3);
  EXPECT_TRUE(nav2.layer<StaticLayer>("static").params().track_unknown_space);
  EXPECT_EQ(nav2.config.params.publish_frequency, 1.0);
  EXPECT_EQ(nav2.costmap.grid().geometry.width, 60);
}

TEST(CostmapConfigTest, TheOldFormsVoxels) {
  Loaded old(
      "map_type: voxel\nz_voxels: 16\norigin_z: -0.1\nmark_threshold: 2\nmax_obstacle_height: 1.5\n"
      "observation_sources: 'a b'\na: {topic: /a}\nmax_source_age: 0\nrobot_radius: 0.3\n");
  EXPECT_EQ(old.layers(), (Names{"obstacle_layer VoxelLayer", "inflation_layer InflationLayer"}));
  VoxelLayer& voxels = old.layer<VoxelLayer>("obstacle_layer");
  EXPECT_EQ(voxels.params().z_voxels, 16);
  EXPECT_EQ(voxels.params().mark_threshold, 2);
  EXPECT_EQ(voxels.params().max_obstacle_height, 1.5);
  ASSERT_EQ(voxels.sources().size(), 2U);
  EXPECT_EQ(voxels.sources()[1].topic(), "b");
  EXPECT_EQ(voxels.sources()[1].params().max_source_age, 0.0);
  EXPECT_EQ(old.config.warnings, Names{});
}

TEST(CostmapConfigTest, TypingErrorsAreWarningsWithTheNearestName) {
  Loaded loaded(
      "updat_frequency: 3\nrolling: 1\nobstacle_layer: {observation_sources: s, "
      "max_obstacle_heigth: 1.0, s: {topics: /a}, t: {topic: /b}}");
  const std::string costmap = "/move_base/costmap/";
  EXPECT_EQ(loaded.config.warnings,
            (Names{costmap + "rolling is taken as rolling_window",
                   costmap + "obstacle_layer/s/topics is not known and has no effect; did you mean "
                             "topic?",
                   costmap + "obstacle_layer/t has no effect: observation_sources does not name it",
                   costmap + "obstacle_layer/max_obstacle_heigth is not known and has no effect; "
                             "did you mean max_obstacle_height?",
                   costmap + "updat_frequency is not known and has no effect; did you mean "
                             "update_frequency?"}));
  EXPECT_TRUE(loaded.config.params.rolling_window);
}

TEST(CostmapConfigTest, FootprintsAreLookedForAboveTheCostmap) {
  EXPECT_NEAR(Loaded("{}", "robot_radius: 0.2").costmap.footprint().inscribed_radius, 0.21, 1e-12);
  EXPECT_NEAR(
      Loaded("footprint: '[[1,1],[-1,1],[-1,-1],[1,-1]]'\nfootprint_padding: 0", "robot_radius: 2")
          .costmap.footprint()
          .inscribed_radius,
      1.0, 1e-12);
}

std::string error_of(const std::string& yaml) {
  try {
    Loaded loaded(yaml);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(CostmapConfigTest, WrongTypesInNav2sFormAreErrorsThatNameKeyAndValue) {
  const std::string begin = "local_costmap:\n  local_costmap:\n    ros__parameters:";
  const std::string width = error_of(begin + "\n      width: wide\n      plugins: []\n");
  EXPECT_NE(width.find("width"), std::string::npos) << width;
  EXPECT_NE(width.find("wide"), std::string::npos) << width;
  const std::string map = error_of(begin + " 5\n");
  EXPECT_NE(map.find("a map"), std::string::npos) << map;
  const std::string rolling = error_of(begin + "\n      rolling_window: [1]\n");
  EXPECT_NE(rolling.find("rolling_window"), std::string::npos) << rolling;
}

TEST(CostmapConfigTest, ValuesThatCannotBeAreErrorsThatNameKeyValueAndRange) {
  EXPECT_NE(error_of("width: -1").find("width"), std::string::npos);
  EXPECT_NE(error_of("width: -1").find("> 0"), std::string::npos);
  EXPECT_NE(error_of("width: wide").find("wide"), std::string::npos);
  EXPECT_NE(error_of("footprint: [[0, 0], [1, 1]]").find("at least 3 corners"), std::string::npos);
  EXPECT_NE(error_of("map_type: octomap").find("costmap and voxel are legal"), std::string::npos);
  EXPECT_NE(error_of("plugins: [{name: a}]").find("a name and a type"), std::string::npos);
  EXPECT_NE(error_of("plugins: [{name: a, type: b}]").find("known: DenoiseLayer"),
            std::string::npos);
  EXPECT_NE(error_of("plugins: [mine]").find("/move_base/costmap/mine"), std::string::npos);
  EXPECT_NE(error_of("inflation_radius: -0.1").find("inflation_radius"), std::string::npos);
  EXPECT_NE(error_of("observation_sources: s\ns: {data_type: Scan}").find("LaserScan"),
            std::string::npos);
  EXPECT_NE(error_of("observation_sources: s\ns: {min_obstacle_height: 3}")
                .find("must not exceed max_obstacle_height"),
            std::string::npos);
  EXPECT_NE(error_of("observation_sources: s\ns: 5").find("a map"), std::string::npos);
}

}  // namespace
}  // namespace trident::nav
