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
    : world_(world), geometry_(kind) {
  surface_.source = std::move(surface_source);
}
RayScene::Content::~Content() = default;

std::shared_ptr<const AnalyticSurface> RayScene::Content::refresh_surface(
    const Eigen::Vector3d& p_world_viewer) {
  surface_.now.reset();
  const bool exists = surface_.source != nullptr && surface_.source->exists();
  if (exists) surface_.now = surface_.source->surface_at(p_world_viewer);
  // A sea that has come or gone changes the tables of shapes and materials.
  if (exists != surface_.has_shape) {
    surface_.has_shape = exists;
    number();
    find_textures();
  }
  return surface_.now;
}

double RayScene::Content::surface_ceiling_m() {
  if (surface_.source == nullptr) return -std::numeric_limits<double>::infinity();
  return surface_.source->ceiling_m();
}

/// After all models' shapes, so that those keep their numbers.
void RayScene::Content::number_surface(std::uint32_t models, std::uint32_t links) {
  surface_.shape = RayHit::kNothing;
  if (!surface_.has_shape) return;
  const AnalyticSurfaceSpec& spec = surface_.source->spec();
  surface_.shape = static_cast<std::uint32_t>(tables_.shapes.size());
  tables_.shapes.push_back(
      {spec.model, spec.link, spec.name, models, links, nullptr, nullptr, spec.laser_retro});
  if (geometry_ != RayGeometry::kVisual) return;
  surface_.material = static_cast<std::uint32_t>(tables_.materials.size());
  tables_.materials.push_back(spec.material);
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
    hit.shape = surface_.shape;
    hit.material = geometry_ == RayGeometry::kVisual ? surface_.material : RayHit::kNothing;
    hit.normal_world = found.normal_world;
  }
}

}  // namespace trident::sim
