// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "surface_cache.h"

#include "../rays/textures/texture.h"

namespace trident::sim {

void SurfaceCache::begin_picture(const RayScene& scene, const Eigen::Vector3d& p_world_camera) {
  ++picture_;
  scene_ = &scene;
  p_world_camera_ = p_world_camera;
}

void SurfaceCache::fill(Slot& slot, std::uint32_t shape, std::uint32_t primitive) {
  slot.picture = picture_;
  slot.shape = shape;
  slot.primitive = primitive;
  SeenSurface& surface = slot.surface;
  surface.look = PacketRays(*scene_).look(shape, primitive);
  const Eigen::Vector3d& normal = surface.look.normal_world;
  surface.gap_m = surface.look.offset_m - normal.dot(p_world_camera_);
  surface.normal_world = normal.cast<float>();
  if (surface.look.texture != nullptr) {
    const Texture::Level& picture = surface.look.texture->levels.front();
    const Eigen::Vector2d size(picture.columns, picture.rows);
    surface.texels_per_meter =
        static_cast<float>((size.asDiagonal() * surface.look.uv_slope).rowwise().norm().maxCoeff());
  }
  const Material& material = scene_->materials()[surface.look.material];
  surface.ambient = material.ambient.head<3>().cast<float>();
  surface.diffuse = material.diffuse.head<3>().cast<float>();
  surface.emissive = material.emissive.head<3>().cast<float>();
}

}  // namespace trident::sim
