// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trident_base/config_node.h"
#include "trident_base/registry.h"
#include "trident_nav/costmap/costmap_params.h"
#include "trident_nav/costmap/layer_factory.h"

namespace trident::nav {

/// A layer that a configuration asks for.
struct LayerSpec {
  std::string plugin;  ///< As the configuration names it: "costmap_2d::StaticLayer".
  LayerSetup setup;
};

/// The parameters of a costmap and of its layers, from the lowest to the highest, under the names
/// of costmap_2d, whatever form they were written in.
struct CostmapConfig {
  CostmapParams params;
  std::vector<LayerSpec> layers;
  /// One sentence for each key that is renamed, has no effect, or is unknown; for the latter with
  /// the nearest known one.
  std::vector<std::string> warnings;
};

/// Where a configuration comes from.
struct CostmapConfigSource {
  std::string label = "parameter";  ///< How errors call it: a file's name, "parameter".
  std::string path;                 ///< Name of the costmap: "/move_base/global_costmap".
  const ConfigNode* above =
      nullptr;  ///< The map that has the costmap's, where costmap_2d looks
                ///< for footprint, robot_radius and ranges, too; nullptr: none.
};

/// Reads a costmap's configuration, a map, in any of three forms:
/// - ROS 1: `plugins: [{name: N, type: T}, ...]`, each layer's parameters below its name;
/// - ROS 1 before Hydro, without `plugins`: `static_map: true` makes a layer static_layer,
///   `map_type: voxel` (else costmap) one that is called obstacle_layer, and all have an
///   inflation_layer, whose parameters are those of the costmap itself;
/// - Nav2: `plugins: [N, ...]`, each layer's map with its `plugin`, all within `ros__parameters`;
///   its own defaults, obstacle_max_range for obstacle_range, raytrace_max_range for
///   raytrace_range, and what it means by combination_method 2.
/// Keys that nobody knows give warnings; values of a wrong type or out of range a ConfigError, and
/// so does a plugin that is not in the registry.
CostmapConfig read_costmap_config(const ConfigNode& config, const CostmapConfigSource& source,
                                  const Registry<LayerType>& registry);

/// The layers of a configuration. Throws ConfigError naming parameter, value and range.
std::vector<std::unique_ptr<Layer>> make_layers(const CostmapConfig& config,
                                                const Registry<LayerType>& registry);

}  // namespace trident::nav
