// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lighting.h"
#include "water_slopes.h"

namespace trident::sim {

/// What the rays of a packet hit of the water.
struct WaterView {
  Eigen::Vector3d p_world_camera;
  alignas(64) PacketFloats d_x, d_y, d_z;         ///< directions, of any length
  std::array<WaterHit, kPacketLanes> water_hits;  ///< along them
  alignas(64)
      PacketFloats behind;  ///< distance to what lies beyond or in the water; infinite: deep
  bool is_needed = false;   ///< any lane hits water or begins in it
};

/// The colour of the sea. From above: the sky's reflection by Fresnel's law, with what the slopes
/// that a pixel does not resolve make of it (Bruneton, Neyret and Holzschuch 2010); lamps of
/// type directional as they glitter on slopes that are normal about the mean one (Cox and Munk
/// 1954); and what comes out of the water, the colour of deep water in which what lies below fades
/// (Beer and Lambert; rays are not bent). The sky is the scene's background, darker and bluer
/// towards the zenith. From below: the sky within the circle that light comes in through, all
/// through the water's colour. Objects are not mirrored.
class WaterPainter {
 public:
  /// `scene` sees water. Both must outlive the picture.
  void begin_picture(const World& world, const RayScene& scene, float pixel_angle_rad);
  /// What is farther away in the water cannot be seen [m].
  static constexpr float kMurk_m = 40.0F;
  /// Turns `color`, what lies behind the water, into what is seen through it.
  void paint(const WaterView& view, PacketColor& color) const;

 private:
  struct Sun {
    Eigen::Vector3f to_sun, color;
    bool casts_shadows;
  };
  struct Facet;
  Eigen::Vector3f sky(float up) const;
  Facet facet_of(const WaterView& view, std::size_t lane) const;
  Eigen::Vector3f from_above(const Facet& facet, const Eigen::Vector3f& body) const;
  Eigen::Vector3f from_below(const Facet& facet) const;
  Eigen::Vector3f through_water(const Eigen::Vector3f& color, float path_m) const;
  void add_glitter(const Sun& sun, const std::array<Facet, kPacketLanes>& facets,
                   PacketColor& color) const;

  const RayScene* scene_ = nullptr;
  const WaterSurface* water_ = nullptr;
  WaterSlopes slopes_;
  float pixel_angle_ = 0.0F;
  float ripple_strength_ = 0.0F;
  Eigen::Vector3f background_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f deep_ = Eigen::Vector3f::Zero();  ///< what comes out of deep water
  std::vector<Sun> suns_;
};

}  // namespace trident::sim
