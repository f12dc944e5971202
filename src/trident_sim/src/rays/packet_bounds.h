// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "trident_sim/ray_scene.h"

namespace trident::sim {

/// A box around all of a scene, a trace larger than Embree's, as floats are.
struct PacketBounds {
  std::array<float, 3> low{}, high{};
};

inline PacketBounds with_slack(PacketBounds bounds) {
  for (std::size_t i = 0; i < 3; ++i) {
    const float slack =
        1e-5F * (1.0F + std::max(std::abs(bounds.low[i]), std::abs(bounds.high[i])));
    bounds.low[i] -= slack;
    bounds.high[i] += slack;
  }
  return bounds;
}

inline PacketBounds bounds_of(RTCScene scene) {
  RTCBounds box;
  rtcGetSceneBounds(scene, &box);
  return with_slack(
      {{box.lower_x, box.lower_y, box.lower_z}, {box.upper_x, box.upper_y, box.upper_z}});
}

/// What the rays of a packet bring to every box that they are held against.
struct PacketSlopes {
  using Lanes = std::array<float, RayScene::kPacket>;
  alignas(64) std::array<Lanes, 3> inverse;  ///< of the components of the directions

  template <class Rays>
  explicit PacketSlopes(const Rays& rays) {
    const std::array<const float*, 3> direction = {rays.dir_x, rays.dir_y, rays.dir_z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < RayScene::kPacket; ++i) {
        inverse[axis][i] = 1.0F / direction[axis][i];
      }
    }
  }
};

/// Whether all rays of a packet, also those that do not count, begin beyond the box on one side and
/// do not turn back: most of a planar lidar's do, whose robot lies below it.
template <class Rays>
bool all_leave(const PacketBounds& bounds, const Rays& rays) {
  const std::array<const float*, 3> origin = {rays.org_x, rays.org_y, rays.org_z};
  const std::array<const float*, 3> direction = {rays.dir_x, rays.dir_y, rays.dir_z};
  constexpr std::size_t kLanes = RayScene::kPacket;
  int forward = 0;
  for (std::size_t i = 0; i < kLanes; ++i) forward |= rays.tnear[i] >= 0.0F ? 0 : -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low = bounds.low[axis], high = bounds.high[axis];
    const float *const o = origin[axis], *const d = direction[axis];
    int above = forward, below = forward;  // -1: of some ray it is not known
    for (std::size_t i = 0; i < kLanes; ++i) {
      above |= (o[i] > high ? 0 : -1) | (d[i] >= 0.0F ? 0 : -1);
      below |= (o[i] < low ? 0 : -1) | (d[i] <= 0.0F ? 0 : -1);
    }
    if (above == 0 || below == 0) return true;
  }
  return false;
}

/// Takes from `valid` the lanes whose rays miss the box for certain; returns whether any is left.
/// Most rays miss the few things that move, and Embree takes those through its tree one by one.
template <class Rays>
bool keep_lanes_that_hit(const PacketBounds& bounds, const Rays& rays, const PacketSlopes& slopes,
                         std::array<int, RayScene::kPacket>& valid) {
  const std::array<const float*, 3> origin = {rays.org_x, rays.org_y, rays.org_z};
  constexpr std::size_t kLanes = RayScene::kPacket;
  alignas(64) std::array<float, kLanes> enter, leave;
  for (std::size_t i = 0; i < kLanes; ++i) {
    enter[i] = rays.tnear[i];
    leave[i] = rays.tfar[i];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low = bounds.low[axis], high = bounds.high[axis];
    const float *const from = origin[axis], *const inverse = slopes.inverse[axis].data();
    for (std::size_t i = 0; i < kLanes; ++i) {
      // A ray along a side of the box: infinite, and not a number on the very edge, which is off.
      const float a = (low - from[i]) * inverse[i], b = (high - from[i]) * inverse[i];
      const float first = a < b ? a : b, last = a < b ? b : a;
      enter[i] = first > enter[i] ? first : enter[i];
      leave[i] = last < leave[i] ? last : leave[i];
    }
  }
  constexpr float kRounding = 1.0F + 1e-5F;
  int any = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    valid[i] &= enter[i] <= leave[i] * kRounding ? -1 : 0;
    any |= valid[i];
  }
  return any != 0;
}

}  // namespace trident::sim
