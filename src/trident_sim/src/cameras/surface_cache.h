// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "../rays/ray_packet.h"

namespace trident::sim {

/// A surface as one picture sees it.
struct SeenSurface {
  SurfaceLook look;
  double gap_m = 0.0;            ///< of a flat surface, from the camera, along its normal
  Eigen::Vector3f normal_world;  ///< of a flat surface, towards the camera
  Eigen::Vector3f ambient, diffuse, emissive;
  float texels_per_meter = 0.0F;  ///< of a flat surface with a texture

  /// Of a flat surface: it is seen from behind.
  bool is_turned_away() const { return gap_m >= 0.0; }
};

/// Surfaces of one picture, looked up as its rays hit them: neighbouring pixels hit the same.
class SurfaceCache {
 public:
  SurfaceCache() : slots_(kSlots) {}
  /// Forgets all. `scene` must have been refreshed, and must outlive what is looked up.
  void begin_picture(const RayScene& scene, const Eigen::Vector3d& p_world_camera);
  /// Good until the next call.
  const SeenSurface& find(std::uint32_t shape, std::uint32_t primitive) {
    Slot& slot = slots_[(shape * 0x9E3779B1U + primitive * 0x85EBCA6BU) >> (32 - kSlotBits)];
    if (slot.picture != picture_ || slot.shape != shape || slot.primitive != primitive) {
      fill(slot, shape, primitive);
    }
    return slot.surface;
  }

 private:
  static constexpr unsigned kSlotBits = 10;
  static constexpr std::size_t kSlots = std::size_t{1} << kSlotBits;
  struct Slot {
    std::uint64_t picture = 0;
    std::uint32_t shape = 0, primitive = 0;
    SeenSurface surface;
  };
  void fill(Slot& slot, std::uint32_t shape, std::uint32_t primitive);

  std::vector<Slot> slots_;
  std::uint64_t picture_ = 0;
  const RayScene* scene_ = nullptr;
  Eigen::Vector3d p_world_camera_ = Eigen::Vector3d::Zero();
};

}  // namespace trident::sim
