// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The world's analytic surface among what rays hit.
#include <cmath>
#include <utility>

#include "analytic_surface.h"
#include "ray_content.h"

namespace trident::sim {

RayScene::Content::Content(const World& world, RayGeometry kind,
                           std::shared_ptr<AnalyticSurfaceSource> surface_source)
    : world_(world), geometry_(kind), surface_source_(std::move(surface_source)) {}
RayScene::Content::~Content() = default;

std::shared_ptr<const AnalyticSurface> RayScene::Content::refresh_surface(
    const Eigen::Vector3d& p_world_viewer) {
  surface_.reset();
  const bool exists = surface_source_ != nullptr && surface_source_->exists();
  if (exists) surface_ = surface_source_->surface_at(p_world_viewer);
  if (exists != has_surface_shape_) {
    has_surface_shape_ = exists;
    number();
    find_textures();
  }
  return surface_;
}

double RayScene::Content::surface_ceiling_m() {
  if (surface_source_ == nullptr) return -std::numeric_limits<double>::infinity();
  return surface_source_->ceiling_m();
}

/// After all models' shapes, so that those keep their numbers.
void RayScene::Content::number_surface(std::uint32_t models, std::uint32_t links) {
  surface_shape_ = RayHit::kNothing;
  if (!has_surface_shape_) return;
  const AnalyticSurfaceSpec& spec = surface_source_->spec();
  surface_shape_ = static_cast<std::uint32_t>(shapes_.size());
  shapes_.push_back(
      {spec.model, spec.link, spec.name, models, links, nullptr, nullptr, spec.laser_retro});
  if (geometry_ != RayGeometry::kVisual) return;
  surface_material_ = static_cast<std::uint32_t>(materials_.size());
  materials_.push_back(spec.material);
}

/// The surface hides what lies beyond it, also where it is nearer than the ray counts.
void RayScene::Content::add_surface(const AnalyticSurface& surface, Span<const Ray> rays,
                                    Span<RayHit> hits) const {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Ray ray = rays[i];
    RayHit& hit = hits[i];
    const double limit = hit.is_hit() ? hit.distance_m : ray.t_max_m;
    if (!std::isfinite(ray.p_world_origin.sum() + ray.direction_world.sum())) continue;
    if (!(ray.t_min_m <= ray.t_max_m)) continue;
    ray.t_min_m = 0.0;
    const AnalyticHit found = surface.intersect(ray, limit);
    if (!(found.t <= limit) || std::isinf(found.t)) continue;
    hit = {};
    if (found.t < rays[i].t_min_m) continue;
    hit.distance_m = found.t;
    hit.shape = surface_shape_;
    hit.material = geometry_ == RayGeometry::kVisual ? surface_material_ : RayHit::kNothing;
    hit.normal_world = found.normal_world;
  }
}

}  // namespace trident::sim
