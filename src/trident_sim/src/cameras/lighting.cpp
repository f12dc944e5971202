// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lighting.h"

#include <algorithm>
#include <cmath>

namespace trident::sim {
namespace {

constexpr std::size_t kLanes = kPacketLanes;
constexpr float kFar = 1e6F;

/// The direction of a lamp and how strongly it shines, lane by lane.
struct Incidence {
  alignas(64) PacketFloats l_x, l_y, l_z;  ///< unit, towards the lamp
  alignas(64) PacketFloats distance;       ///< [m]
  alignas(64) PacketFloats strength;
};

/// Of the light that leaves a lamp what falls on a surface, by Lambert; where none does the lane
/// counts no more.
void turn_to_surface(const LitPoints& points, Incidence& light) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float cosine =
        points.n_x[i] * light.l_x[i] + points.n_y[i] * light.l_y[i] + points.n_z[i] * light.l_z[i];
    light.strength[i] *= std::max(cosine, 0.0F);
  }
}

/// Rays to the lamp, begun so far off the surface that rounding does not shade it by itself.
RayPacket shadow_rays(const LitPoints& points, const Incidence& light) {
  RayPacket rays;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float reach =
        std::max({std::abs(points.p_x[i]), std::abs(points.p_y[i]), std::abs(points.p_z[i])});
    const float gap = 5e-4F + 2e-6F * reach;
    rays.origin_x[i] = points.p_x[i] + gap * points.n_x[i];
    rays.origin_y[i] = points.p_y[i] + gap * points.n_y[i];
    rays.origin_z[i] = points.p_z[i] + gap * points.n_z[i];
    rays.t_max[i] = light.distance[i];
    rays.valid[i] = points.valid[i] != 0 && light.strength[i] > 0.0F ? -1 : 0;
  }
  rays.direction_x = light.l_x;
  rays.direction_y = light.l_y;
  rays.direction_z = light.l_z;
  rays.t_min.fill(0.0F);
  return rays;
}

void darken(std::uint32_t shaded_lanes, Incidence& light) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    if ((shaded_lanes >> i & 1U) != 0) light.strength[i] = 0.0F;
  }
}

void add_diffuse(const Eigen::Vector3f& lamp_color, const LitPoints& points, const Incidence& light,
                 PacketColor& color) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const float of_lamp = lamp_color[static_cast<Eigen::Index>(channel)];
    for (std::size_t i = 0; i < kLanes; ++i) {
      color[channel][i] += of_lamp * light.strength[i] * points.diffuse[channel][i];
    }
  }
}

}  // namespace

void Lighting::add_lights(const World& world) {
  ambient_ = world.scene().ambient.head<3>().cast<float>();
  for (const LightSpec& light : world.lights()) {
    Lamp lamp{};
    lamp.type = light.type;
    lamp.p_world = light.T_world_light.p.cast<float>();
    lamp.direction_world = (light.T_world_light.R * light.direction_light).cast<float>();
    lamp.color = light.diffuse.head<3>().cast<float>();
    lamp.casts_shadows = light.casts_shadows && world.scene().shadows;
    lamp.range_m = static_cast<float>(light.range_m);
    lamp.constant = static_cast<float>(light.attenuation_constant);
    lamp.linear = static_cast<float>(light.attenuation_linear);
    lamp.quadratic = static_cast<float>(light.attenuation_quadratic);
    // SDF gives whole angles of the cones.
    lamp.cos_inner = static_cast<float>(std::cos(0.5 * light.spot_inner_rad));
    lamp.cos_outer = static_cast<float>(std::cos(0.5 * light.spot_outer_rad));
    lamp.falloff = static_cast<float>(light.spot_falloff);
    lamps_.push_back(lamp);
  }
}

/// OGRE's attenuation, 1 / (c + l d + q d^2) and nothing beyond the range; a spot fades between its
/// inner and its outer cone by the power `falloff` of the cosine's share.
float Lighting::strength(const Lamp& lamp, float distance, const Eigen::Vector3f& to_lamp) {
  if (distance > lamp.range_m) return 0.0F;
  const float faded = lamp.constant + distance * (lamp.linear + distance * lamp.quadratic);
  float strength = faded > 1e-6F ? 1.0F / faded : 1e6F;
  if (lamp.type == LightType::kSpot) {
    const float cosine = -to_lamp.dot(lamp.direction_world);
    const float wide = lamp.cos_inner - lamp.cos_outer;
    const float share =
        wide > 1e-6F ? (cosine - lamp.cos_outer) / wide : (cosine > lamp.cos_outer ? 1.0F : 0.0F);
    strength *= std::pow(std::clamp(share, 0.0F, 1.0F), lamp.falloff);
    if (cosine <= lamp.cos_outer) strength = 0.0F;
  }
  return strength;
}

void Lighting::add(const Lamp& lamp, const LitPoints& points, PacketColor& color) const {
  Incidence light;
  if (lamp.type == LightType::kDirectional) {
    light.l_x.fill(-lamp.direction_world.x());
    light.l_y.fill(-lamp.direction_world.y());
    light.l_z.fill(-lamp.direction_world.z());
    light.distance.fill(kFar);
    light.strength.fill(1.0F);
  } else {
    for (std::size_t i = 0; i < kLanes; ++i) {
      Eigen::Vector3f to_lamp =
          lamp.p_world - Eigen::Vector3f(points.p_x[i], points.p_y[i], points.p_z[i]);
      light.distance[i] = to_lamp.norm();
      to_lamp /= std::max(light.distance[i], 1e-6F);
      light.l_x[i] = to_lamp.x();
      light.l_y[i] = to_lamp.y();
      light.l_z[i] = to_lamp.z();
      light.strength[i] = strength(lamp, light.distance[i], to_lamp);
    }
  }
  turn_to_surface(points, light);
  const RayPacket rays = shadow_rays(points, light);
  // Lanes that are turned away from the lamp cast no shadow rays; if all are, it adds nothing.
  const bool is_dark =
      std::all_of(rays.valid.begin(), rays.valid.end(), [](int v) { return v == 0; });
  if (is_dark) return;
  if (lamp.casts_shadows) darken(PacketRays(*scene_).shaded(rays), light);
  add_diffuse(lamp.color, points, light, color);
}

void Lighting::shade(const LitPoints& points, PacketColor& color) const {
  PacketColor lit;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const float ambient = ambient_[static_cast<Eigen::Index>(channel)];
    for (std::size_t i = 0; i < kLanes; ++i) {
      lit[channel][i] = points.emissive[channel][i] + ambient * points.ambient[channel][i];
    }
  }
  for (const Lamp& lamp : lamps_) add(lamp, points, lit);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (points.valid[i] != 0) color[channel][i] = lit[channel][i];
    }
  }
}

}  // namespace trident::sim
