// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The water among what rays meet.
#include <algorithm>
#include <cmath>

#include "rays/ray_content.h"
#include "trident_sim/world.h"
#include "water_surface.h"

namespace trident::sim {
namespace {

/// How strongly a lidar sees it, where it sees it at all: what water reflects straight back.
constexpr double kReflectedPercent = 2.0;

}  // namespace

RayScene::Content::Content(const World& world, RayGeometry kind, std::shared_ptr<WaterTiles> tiles)
    : geometry(kind), world_(world), tiles_(std::move(tiles)) {}
RayScene::Content::~Content() = default;

std::shared_ptr<const WaterSurface> RayScene::Content::refresh_water(
    const Eigen::Vector3d& p_world_viewer) {
  const bool has_sea = tiles_->find_sea() != nullptr;
  water_.reset();
  if (has_sea) {
    auto free = std::find_if(surfaces_.begin(), surfaces_.end(),
                             [](const auto& surface) { return surface.use_count() == 1; });
    if (free == surfaces_.end()) {
      free = surfaces_.insert(free, std::make_shared<WaterSurface>(tiles_));
    }
    (*free)->follow(p_world_viewer);
    water_ = *free;
  }
  if (has_sea != has_water_shape_) {
    has_water_shape_ = has_sea;
    number();
    find_textures();
  }
  return water_;
}

double RayScene::Content::water_ceiling_m() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::shared_ptr<const Sea> sea = tiles_->find_sea();
  if (sea == nullptr) return -kInfinity;
  const auto* const waves = dynamic_cast<const WaveField*>(&sea->water());
  if (waves == nullptr) return kInfinity;
  tiles_->follow(*waves);
  return waves->level_m(world_.time().seconds()) + tiles_->amplitudes_m();
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
void RayScene::Content::add_water(const WaterSurface& water, Span<const Ray> rays,
                                  Span<RayHit> hits) const {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Ray ray = rays[i];
    RayHit& hit = hits[i];
    const double limit = hit.met() ? hit.distance_m : ray.t_max_m;
    if (!std::isfinite(ray.p_world_origin.sum() + ray.direction_world.sum())) continue;
    if (!(ray.t_min_m <= ray.t_max_m)) continue;
    ray.t_min_m = 0.0;
    const WaterMeeting met = water.meet(ray, limit);
    if (!(met.t <= limit) || std::isinf(met.t)) continue;
    hit = {};
    if (met.t < rays[i].t_min_m) continue;
    hit.distance_m = met.t;
    hit.shape = water_shape;
    hit.material = geometry == RayGeometry::kVisual ? water_material_ : RayHit::kNothing;
    const Eigen::Vector3d p = ray.p_world_origin + met.t * ray.direction_world;
    const Eigen::Vector2d slope = met.is_far ? water.slope(p.head<2>()) : met.slope;
    hit.normal_world = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
    if (met.begins_below) hit.normal_world = -hit.normal_world;
  }
}

}  // namespace trident::sim
