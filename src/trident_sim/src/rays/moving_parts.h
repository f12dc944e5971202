// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "embree.h"
#include "packet_bounds.h"

namespace trident::sim {

/// Scenes that move as a whole, one per moving link. While they are few, rays are taken into each
/// that they may hit; what is more than a few lies as instances in a scene of Embree's, the commit
/// of which, each time something has moved, costs more than rays that need to look at a few boxes.
class MovingParts {
 public:
  using Lanes = std::array<int, RayScene::kPacket>;  ///< -1: counts, 0: does not

  void clear();
  bool empty() const { return parts_.empty(); }
  /// `scene`, committed, must outlive its part. Parts are numbered from 0.
  std::size_t add(RTCScene scene, const SE3& T_world_link);
  void place(std::size_t part, const SE3& T_world_link);
  /// To be called once parts came or were placed, before rays are cast.
  void commit(RTCDevice device);

  /// As rtcIntersect16; hit.instID is the part. The context's flags are set.
  void intersect(const Lanes& valid, RTCRayHit16& rays, CastContext& context) const;
  /// As rtcOccluded16.
  void occlude(const Lanes& valid, RTCRay16& rays, CastContext& context) const;

 private:
  struct Part {
    RTCScene scene;
    PacketBounds bounds_link, bounds_world;
    Eigen::Matrix3f R_link_world;
    Eigen::Vector3f p_link_world;
    EmbreeGeometry instance;  ///< nullptr: while they are few
  };
  static void set_place(Part& part, const SE3& T_world_link);
  static void turn_into(const Part& part, const RTCRay16& rays, RTCRay16& turned);

  static constexpr std::size_t kFew = 8;
  std::vector<Part> parts_;
  std::vector<SE3> places_;
  EmbreeScene scene_;  ///< nullptr: they are few
  PacketBounds bounds_;
};

}  // namespace trident::sim
