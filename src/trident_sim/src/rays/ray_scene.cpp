// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/ray_scene.h"

#include <algorithm>
#include <string>
#include <utility>

#include "analytic_surface.h"
#include "ray_content.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

void check_room(const char* what, std::size_t rays, std::size_t results) {
  if (results >= rays) return;
  throw Error(std::string(what) + ": room for " + std::to_string(results) + " results of " +
              std::to_string(rays) + " rays");
}

}  // namespace

RayScene::RayScene(const World& world, RayGeometry geometry,
                   std::shared_ptr<AnalyticSurfaceSource> surface_source)
    : content_(std::make_unique<Content>(world, geometry, std::move(surface_source))) {}

RayScene::~RayScene() = default;

void RayScene::refresh() { content_->refresh(); }

std::shared_ptr<const AnalyticSurface> RayScene::refresh_surface(
    const Eigen::Vector3d& p_world_viewer) {
  return content_->refresh_surface(p_world_viewer);
}
double RayScene::surface_ceiling_m() { return content_->surface_ceiling_m(); }

const AnalyticSurface* RayScene::surface() const { return content_->surface(); }

std::uint32_t RayScene::surface_shape() const { return content_->surface_shape(); }

void RayScene::cast(Span<const Ray> rays, Span<RayHit> hits, const RayFilter& filter) const {
  cast(rays, hits, surface(), filter);
}

void RayScene::cast(Span<const Ray> rays, Span<RayHit> hits, const AnalyticSurface* surface,
                    const RayFilter& filter) const {
  check_room("cast", rays.size(), hits.size());
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    content_->cast_packet(rays.data() + first, hits.data() + first,
                          std::min(kPacket, rays.size() - first), filter);
  }
  if (surface != nullptr) content_->add_surface(*surface, rays, hits);
}

void RayScene::add_surface(const AnalyticSurface& surface, Span<const Ray> rays,
                           Span<RayHit> hits) const {
  check_room("add_surface", rays.size(), hits.size());
  content_->add_surface(surface, rays, hits);
}

void RayScene::occluded(Span<const Ray> rays, Span<bool> result, const RayFilter& filter) const {
  check_room("occluded", rays.size(), result.size());
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    content_->occlude_packet(rays.data() + first, result.data() + first,
                             std::min(kPacket, rays.size() - first), filter);
  }
}

void RayScene::use_textures() { content_->use_textures(); }

Eigen::Vector3d RayScene::albedo(const RayHit& hit) const { return content_->albedo(hit); }

void PacketRays::intersect(const RayPacket& rays, PacketHits& hits, std::uint32_t mask) const {
  scene_->content_->intersect_packet(rays, hits, mask);
}

std::uint32_t PacketRays::shaded(const RayPacket& rays, std::uint32_t mask) const {
  return scene_->content_->shaded_lanes(rays, mask);
}

SurfaceLook PacketRays::look(std::uint32_t shape, std::uint32_t primitive) const {
  return scene_->content_->look(shape, primitive);
}

SurfacePoint PacketRays::look_at(std::uint32_t shape, std::uint32_t primitive, const Ray& ray,
                                 double t) const {
  return scene_->content_->look_at(shape, primitive, ray, t);
}

double RayScene::intensity(const RayHit& hit) const { return content_->intensity(hit); }

RayGeometry RayScene::geometry() const { return content_->geometry(); }
const std::vector<RayShape>& RayScene::shapes() const { return content_->shapes(); }
const std::vector<Material>& RayScene::materials() const { return content_->materials(); }
RayScene::Commits RayScene::commits() const { return content_->commits(); }

}  // namespace trident::sim
