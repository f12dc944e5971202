// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Keys in users' files that upstream ignores, or that mean the same as others.
#pragma once

#include <array>

namespace trident::nav {

/// A key that has no effect, and why.
struct IgnoredKey {
  const char* key;
  const char* why;
};

inline constexpr std::array<IgnoredKey, 23> kIgnoredCostmapKeys{{
    {"meter_scoring", "it is a parameter of the local planner"},
    {"map_type", "the types of layers are given in plugins"},
    {"static_map", "with plugins there is a static layer only if they name one"},
    {"inscribed_radius", "it follows from footprint or robot_radius"},
    {"circumscribed_radius", "it follows from footprint or robot_radius"},
    {"transform_timeout", "transform_tolerance says how old transforms may be"},
    {"initial_transform_timeout", "the costmap waits for its transforms as long as it takes"},
    {"lethal_cost_threshold", "it is a parameter of the static layer"},
    {"trinary_costmap", "it is a parameter of the static layer"},
    {"unknown_cost_value", "it is a parameter of the static layer"},
    {"map_topic", "it is a parameter of the static layer"},
    {"observation_sources", "it is a parameter of obstacle layers"},
    {"inflation_radius", "it is a parameter of the inflation layer"},
    {"cost_scaling_factor", "it is a parameter of the inflation layer"},
    {"origin_z", "it is a parameter of voxel layers"},
    {"z_resolution", "it is a parameter of voxel layers"},
    {"z_voxels", "it is a parameter of voxel layers"},
    {"mark_threshold", "it is a parameter of voxel layers"},
    {"unknown_threshold", "it is a parameter of voxel layers"},
    {"publish_voxel_map", "it is a parameter of voxel layers"},
    {"use_sim_time", "the node has one clock"},
    {"introspection_mode", "there are no services of ROS 2 here"},
    {"map_vis_z", "the costmap is published at height 0"},
}};

inline constexpr std::array<IgnoredKey, 6> kIgnoredLayerKeys{{
    {"map_subscribe_transient_local", "maps are latched topics here"},
    {"map_type", "the layer's type says what it is"},
    {"track_unknown_space", "it is a parameter of static and obstacle layers"},
    {"transform_tolerance", "it is a parameter of the costmap"},
    {"priority", "layers are in the order of plugins"},
    {"footprint_clearing_enabled", "it is a parameter of obstacle layers"},
}};

inline constexpr std::array<IgnoredKey, 3> kIgnoredSourceKeys{{
    {"add_max_range", "inf_is_valid says whether beams that hit nothing clear"},
    {"transform_tolerance", "it is a parameter of the layer"},
    {"transport_type", "messages come as they are"},
}};

/// A key that is another's name in some version of the packages.
struct RenamedKey {
  const char* old_name;
  const char* name;
};

/// Nav2's names, which mean the same.
inline constexpr std::array<RenamedKey, 2> kNav2SourceKeys{{
    {"obstacle_max_range", "obstacle_range"},
    {"raytrace_max_range", "raytrace_range"},
}};

/// Names that are not those of any version but are in users' files.
inline constexpr std::array<RenamedKey, 4> kRenamedCostmapKeys{{
    {"update_rate", "update_frequency"},
    {"publish_rate", "publish_frequency"},
    {"track_unknown", "track_unknown_space"},
    {"rolling", "rolling_window"},
}};

/// Parameters of a costmap without `plugins` that are those of its layers.
inline constexpr std::array<const char*, 4> kOldStaticKeys{
    {"map_topic", "unknown_cost_value", "lethal_cost_threshold", "trinary_costmap"}};
/// Parameters of a Nav2 costmap that its static layers read.
inline constexpr std::array<const char*, 4> kNav2StaticKeys{
    {"track_unknown_space", "lethal_cost_threshold", "trinary_costmap", "unknown_cost_value"}};
inline constexpr std::array<const char*, 6> kOldVoxelKeys{{"origin_z", "z_resolution", "z_voxels",
                                                           "mark_threshold", "unknown_threshold",
                                                           "publish_voxel_map"}};
inline constexpr std::array<const char*, 5> kOldObstacleKeys{
    {"observation_sources", "max_obstacle_height", "combination_method",
     "footprint_clearing_enabled", "decay_time"}};
inline constexpr std::array<const char*, 3> kOldInflationKeys{
    {"inflation_radius", "cost_scaling_factor", "inflate_unknown"}};

/// Keys that a source takes from the layer, the costmap, or what has that, when it has none.
inline constexpr std::array<const char*, 3> kInheritedSourceKeys{
    {"obstacle_range", "raytrace_range", "max_source_age"}};
/// Keys that a costmap takes from what has it.
inline constexpr std::array<const char*, 4> kInheritedCostmapKeys{
    {"footprint", "robot_radius", "footprint_topic", "published_footprint_topic"}};

/// Plugins of old versions whose work others do.
inline constexpr std::array<IgnoredKey, 1> kIgnoredPlugins{{
    {"FootprintLayer", "obstacle layers clear the cells under the robot"},
}};

}  // namespace trident::nav
