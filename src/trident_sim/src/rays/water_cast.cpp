// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The water among what rays meet.
#include <cmath>

#include "ray_content.h"
#include "water_surface.h"

namespace trident {
namespace {

/// How strongly a lidar sees it, where it sees it at all: what water reflects straight back.
constexpr double kReflectedPercent = 2.0;

}  // namespace

RayScene::Content::Content(const World& world, RayGeometry kind) : geometry(kind), world_(world) {}
RayScene::Content::~Content() = default;

void RayScene::Content::refresh_water(const Eigen::Vector3d& p_world_viewer) {
  if (water_surface_ == nullptr) water_surface_ = std::make_unique<WaterSurface>(world_);
  sees_water_ = water_surface_->follow(p_world_viewer);
  if (sees_water_ == has_water_shape_) return;
  has_water_shape_ = sees_water_;
  number();
  find_textures();
}

double RayScene::Content::water_ceiling_m() {
  if (water_surface_ == nullptr) water_surface_ = std::make_unique<WaterSurface>(world_);
  return water_surface_->ceiling_m();
}

/// After all models' shapes, so that those keep their numbers.
void RayScene::Content::number_water(std::uint32_t models, std::uint32_t links) {
  water_shape = RayHit::kNothing;
  if (!has_water_shape_) return;
  water_shape = static_cast<std::uint32_t>(shapes.size());
  shapes.push_back(
      {"water", "water", "surface", models, links, nullptr, nullptr, kReflectedPercent});
  if (geometry != RayGeometry::kVisual) return;
  Material deep;
  deep.ambient = deep.diffuse = {0.02, 0.09, 0.12, 1.0};
  water_material_ = static_cast<std::uint32_t>(materials.size());
  materials.push_back(deep);
}

/// Water hides what lies beyond it, also where it is nearer than the ray counts.
void RayScene::Content::add_water(const Ray* rays, RayHit* hits, std::size_t count) const {
  for (std::size_t lane = 0; lane < count; ++lane) {
    Ray ray = rays[lane];
    RayHit& hit = hits[lane];
    const double limit = hit.met() ? hit.distance_m : ray.t_max_m;
    if (!std::isfinite(ray.p_world_origin.sum() + ray.direction_world.sum())) continue;
    if (!(ray.t_min_m <= ray.t_max_m)) continue;
    ray.t_min_m = 0.0;
    const WaterMeeting water = water_surface_->meet(ray, limit);
    if (!(water.t <= limit) || std::isinf(water.t)) continue;
    hit = {};
    if (water.t < rays[lane].t_min_m) continue;
    hit.distance_m = water.t;
    hit.shape = water_shape;
    hit.material = geometry == RayGeometry::kVisual ? water_material_ : RayHit::kNothing;
    const Eigen::Vector3d p = ray.p_world_origin + water.t * ray.direction_world;
    hit.normal_world = water_surface_->normal(p.head<2>());
    if (water.begins_below) hit.normal_world = -hit.normal_world;
  }
}

}  // namespace trident
