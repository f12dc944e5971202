// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "trident_sim/ray_scene.h"

namespace trident::sim {

struct Texture;

constexpr std::size_t kPacketLanes = RayScene::kPacket;
using PacketFloats = std::array<float, kPacketLanes>;

/// Rays component by component, in the world. Directions may have any length but zero; distances
/// count in it. Rays of one packet may begin anywhere. Lanes that do not count hold numbers, too.
struct RayPacket {
  alignas(64) PacketFloats origin_x, origin_y, origin_z;
  alignas(64) PacketFloats direction_x, direction_y, direction_z;
  alignas(64) PacketFloats t_min, t_max;
  alignas(64) std::array<int, kPacketLanes> valid;  ///< -1: counts, 0: does not
};

/// What the rays of a packet hit. Lanes that did not count are as if they hit nothing.
struct PacketHits {
  alignas(64) PacketFloats t;
  alignas(64) std::array<std::uint32_t, kPacketLanes> shape;  ///< RayHit::kNothing: nothing
  alignas(64) std::array<std::uint32_t, kPacketLanes> primitive;
};

/// What holds of a whole surface, a triangle, a box's face or a round shape.
struct SurfaceLook {
  bool is_flat = false;    ///< else what follows up to the texture is given by look_at() only
  bool is_smooth = false;  ///< flat, but its normal, for light, is given by look_at()
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();  ///< outward
  double offset_m = 0.0;                                   ///< normal . p of its points
  /// Texture coordinates of a point of it: slope * p_world + base
  Eigen::Matrix<double, 2, 3> uv_slope = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Vector2d uv_base = Eigen::Vector2d::Zero();
  const Texture* texture = nullptr;           ///< nullptr: the material's colours
  std::uint32_t material = RayHit::kNothing;  ///< index into RayScene::materials()
};

/// What holds of one point of a surface.
struct SurfacePoint {
  double t = 0.0;                                          ///< along the ray, exact
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();  ///< outward, of unit length
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
};

/// A scene as pictures see it, whose neighbouring rays hit the same surfaces. The analytic surface
/// is left out. Any number of threads may ask at the same time.
class PacketRays {
 public:
  /// `scene` must outlive it.
  explicit PacketRays(const RayScene& scene) : scene_(&scene) {}

  /// What each ray of a packet hits first, in float.
  void intersect(const RayPacket& rays, PacketHits& hits, std::uint32_t mask = 0xffffffff) const;
  /// Which rays of a packet anything that casts shadows lies on, bit by bit.
  std::uint32_t shaded(const RayPacket& rays, std::uint32_t mask = 0xffffffff) const;
  /// What the surface is like that a ray of a packet hit.
  SurfaceLook look(std::uint32_t shape, std::uint32_t primitive) const;
  /// The same at the point that a ray hits near distance `t`.
  SurfacePoint look_at(std::uint32_t shape, std::uint32_t primitive, const Ray& ray,
                       double t) const;

 private:
  const RayScene* scene_;
};

}  // namespace trident::sim
