// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "marine/environment/environment.h"
#include "models.h"
#include "ray_check.h"
#include "sea_rays/water_surface.h"
#include "test_world.h"

namespace trident::sim {

/// A world of nothing but a sea, whose <waves> these are.
inline WorldSpec sea_spec(const ParamList& waves, const std::string& level_m = "0") {
  PluginSpec plugin = make_plugin("sea", "libtrident_sea.so", {{"water_level", level_m}});
  ParamNode node{"waves", "", {}, {}};
  for (const auto& [key, value] : waves) node.children.push_back({key, value, {}, {}});
  plugin.params.children.push_back(std::move(node));
  WorldSpec spec = world_spec();
  spec.plugins = {plugin};
  return spec;
}

inline ParamList jonswap(const std::string& height_m, const std::string& period_s) {
  return {{"spectrum", "jonswap"},   {"significant_height", height_m},
          {"peak_period", period_s}, {"components", "60"},
          {"spreading", "10"},       {"direction", "0.5"}};
}

inline ParamList regular(const std::string& amplitude_m, const std::string& period_s) {
  return {{"spectrum", "regular"},
          {"amplitude", amplitude_m},
          {"period", period_s},
          {"direction", "0.7"}};
}

inline const WaveField& waves_of(const World& world) {
  return dynamic_cast<const WaveField&>(find_sea(world)->water());
}

/// The scene with the water about a place.
inline RayScene& scene_on_water(TestWorld& world, const Eigen::Vector3d& p_world_viewer,
                                RayGeometry geometry = RayGeometry::kCollision) {
  RayScene& scene = fresh_rays(world, geometry);
  scene.refresh_surface(p_world_viewer);
  return scene;
}

}  // namespace trident::sim
