// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "../rays/ray_packet.h"
#include "trident_sim/world.h"

namespace trident::sim {

using PacketColor = std::array<PacketFloats, 3>;  ///< red, green, blue; [0, 1] is what is shown

/// What the rays of a packet hit, as light falls on it.
struct LitPoints {
  alignas(64) PacketFloats p_x, p_y, p_z;  ///< in the world [m]
  alignas(64) PacketFloats n_x, n_y, n_z;  ///< unit normal, towards who looks
  alignas(64) PacketColor ambient, diffuse, emissive;
  alignas(64) std::array<int, kPacketLanes> valid;  ///< -1: there is something, 0: there is not
};

/// Light of a world as Gazebo's renderer has it, without gloss: emission + ambient colour times the
/// scene's + diffuse colour times the light that falls on it (Lambert), which what casts shadows
/// may keep away.
class Lighting {
 public:
  /// Both must outlive this.
  Lighting(const World& world, const RayScene& scene) : scene_(&scene) { add_lights(world); }
  /// Light that comes from lanes that are valid; the others are left alone.
  void shade(const LitPoints& points, PacketColor& color) const;

 private:
  struct Lamp {
    LightType type;
    Eigen::Vector3f p_world, direction_world;  ///< where it is, in which direction it shines
    Eigen::Vector3f color;
    bool casts_shadows;
    float range_m, constant, linear, quadratic;  ///< of its attenuation
    float cos_inner, cos_outer, falloff;         ///< of a spot
  };
  void add_lights(const World& world);
  void add(const Lamp& lamp, const LitPoints& points, PacketColor& color) const;
  static float strength(const Lamp& lamp, float distance, const Eigen::Vector3f& to_lamp);

  const RayScene* scene_;
  Eigen::Vector3f ambient_ = Eigen::Vector3f::Zero();
  std::vector<Lamp> lamps_;
};

}  // namespace trident::sim
