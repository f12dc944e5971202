// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_returns.h"

#include <algorithm>
#include <cmath>

#include "sea_rays/water_surface.h"

namespace trident::sim {

WaterReturns read_water_returns(const PluginParams& params, WaterReturns fallback) {
  const std::string text = params.text("water_returns", "");
  if (text.empty()) return fallback;
  if (text == "auto") return WaterReturns::kAuto;
  if (text == "off") return WaterReturns::kOff;
  if (text != "on") params.refuse("water_returns", text, "auto, off or on");
  return WaterReturns::kOn;
}

namespace {

/// -log(1 - p) of water_return_probability(), which is more than p.
double return_strength(double cos_incidence, double distance_m) {
  constexpr double kMirror = 0.02, kSlopes = 0.01, kScattered = 0.0005;
  constexpr double kBoard = 0.1, kBoardRange_m = 100.0;
  const double c = std::clamp(cos_incidence, 1e-3, 1.0);
  const double tan2 = 1.0 / (c * c) - 1.0;
  constexpr double kSteepest = 30.0 * kSlopes;  // beyond it no mirror leans so
  const double mirrored = tan2 < kSteepest ? kMirror * std::exp(-tan2 / kSlopes) /
                                                 (4.0 * kSlopes * (c * c) * (c * c) * c)
                                           : 0.0;
  const double strength = (mirrored + kScattered * c) / kBoard;
  const double per_range = kBoardRange_m / std::max(distance_m, 1e-3);
  return strength * per_range * per_range;
}

}  // namespace

double water_return_probability(double cos_incidence, double distance_m) {
  return -std::expm1(-return_strength(cos_incidence, distance_m));
}

RayHit WaterSight::see(const RayScene& scene, const WaterSurface& water, const Ray& ray,
                       const RayHit& behind, std::uint64_t scan, std::uint32_t channel) const {
  if (ray.p_world_origin.z() > water.highest_m()) {
    const double limit = behind.is_hit() ? behind.distance_m : ray.t_max_m;
    const WaterReach reach = water.reach(ray);
    if (!(reach.first <= limit)) return behind;
    // For most beams that come down to the water chance decides that nothing comes back, wherever
    // that is: they need not be followed to the very place.
    if (reach.last <= limit && returns_ != WaterReturns::kOn) {
      if (returns_ == WaterReturns::kOff) return {};
      const double chance = stream_.uniform(scan, channel);
      const auto beyond_chance = [&](double cos_most) {
        constexpr double kSlack = 1e-9;
        return chance >= return_strength(cos_most * (1.0 + kSlack), reach.first * (1.0 - kSlack));
      };
      if (beyond_chance(water.cos_most(ray))) return {};
      if (beyond_chance(water.cos_most(ray, reach))) return {};
    }
  }
  RayHit hit = behind;
  scene.add_surface(water, {&ray, 1}, {&hit, 1});
  return reports(water, scene.surface_shape(), ray, hit, scan, channel) ? hit : RayHit{};
}

bool WaterSight::reports(const WaterSurface& water, std::uint32_t water_shape, const Ray& ray,
                         const RayHit& hit, std::uint64_t scan, std::uint32_t channel) const {
  if (!hit.is_hit()) return true;
  const bool is_water = hit.shape == water_shape;
  if (returns_ != WaterReturns::kAuto) return !is_water || returns_ == WaterReturns::kOn;
  if (!is_water) {
    const Eigen::Vector3d& p = ray.p_world_origin;
    return p.z() > water.highest_m() || p.z() > water.height_m(p.head<2>());
  }
  if (hit.normal_world.z() < 0.0) return false;  // from below
  const double cosine = -hit.normal_world.dot(ray.direction_world);
  const double chance = stream_.uniform(scan, channel);
  const double strength = return_strength(cosine, hit.distance_m);
  return chance < strength && chance < -std::expm1(-strength);
}

}  // namespace trident::sim
