// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/ray_scene.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ray_content.h"
#include "sea_rays/water_tiles.h"
#include "trident_base/error.h"
#include "trident_base/worker_pool.h"

namespace trident::sim {
namespace {

void check_room(const char* what, std::size_t rays, std::size_t results) {
  if (results >= rays) return;
  throw Error(std::string(what) + ": room for " + std::to_string(results) + " results of " +
              std::to_string(rays) + " rays");
}

}  // namespace

RayScene::RayScene(const World& world, RayGeometry geometry, const RayScene* other)
    : content_(std::make_unique<Content>(
          world, geometry,
          other != nullptr ? other->content_->tiles() : std::make_shared<WaterTiles>(world))) {}

RayScene::~RayScene() = default;

void RayScene::refresh() { content_->refresh(); }

std::shared_ptr<const WaterSurface> RayScene::refresh_water(const Eigen::Vector3d& p_world_viewer) {
  return content_->refresh_water(p_world_viewer);
}
double RayScene::water_ceiling_m() { return content_->water_ceiling_m(); }

const WaterSurface* RayScene::water() const { return content_->water(); }

std::uint32_t RayScene::water_shape() const { return content_->water_shape; }

void RayScene::cast(Span<const Ray> rays, Span<RayHit> hits, const RayFilter& filter) const {
  cast(rays, hits, water(), filter);
}

void RayScene::cast(Span<const Ray> rays, Span<RayHit> hits, const WaterSurface* water,
                    const RayFilter& filter) const {
  check_room("cast", rays.size(), hits.size());
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    content_->cast_packet(rays.data() + first, hits.data() + first,
                          std::min(kPacket, rays.size() - first), filter);
  }
  if (water != nullptr) content_->add_water(*water, rays, hits);
}

void RayScene::add_water(const WaterSurface& water, Span<const Ray> rays, Span<RayHit> hits) const {
  check_room("add_water", rays.size(), hits.size());
  content_->add_water(water, rays, hits);
}

void RayScene::occluded(Span<const Ray> rays, Span<bool> result, const RayFilter& filter) const {
  check_room("occluded", rays.size(), result.size());
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    content_->occlude_packet(rays.data() + first, result.data() + first,
                             std::min(kPacket, rays.size() - first), filter);
  }
}

void RayScene::put_off(RayWork& work) { content_->put_off.push_back(&work); }
void RayScene::forget_put_off() { content_->put_off.clear(); }

void RayScene::do_put_off(Span<RayScene* const> scenes, WorkerPool& workers) {
  if (scenes.empty()) return;
  // Memory of the first scene's serves all.
  std::vector<RayWork*>& works = scenes.front()->content_->works;
  std::vector<std::pair<RayWork*, std::size_t>>& parts = scenes.front()->content_->put_off_parts;
  works.clear();
  parts.clear();
  for (RayScene* const scene : scenes) {
    if (scene->content_->put_off.empty()) continue;
    scene->refresh();
    works.insert(works.end(), scene->content_->put_off.begin(), scene->content_->put_off.end());
    scene->forget_put_off();
  }
  if (works.empty()) return;
  std::vector<Eigen::Vector2d>& viewers = scenes.front()->content_->viewers;
  viewers.clear();
  for (const RayWork* const work : works) viewers.push_back(work->viewer());
  scenes.front()->content_->tiles()->prepare(viewers, workers);
  for (RayWork* const work : works) {
    const std::size_t count = work->begin();
    for (std::size_t part = 0; part < count; ++part) parts.emplace_back(work, part);
  }
  workers.share(parts.size(),
                [&parts](std::size_t i, std::size_t) { parts[i].first->do_part(parts[i].second); });
  for (RayWork* const work : works) work->finish();
}

void RayScene::use_textures() { content_->use_textures(); }

Eigen::Vector3d RayScene::albedo(const RayHit& hit) const { return content_->albedo(hit); }

void RayScene::meet(const RayPacket& rays, PacketHits& hits, std::uint32_t mask) const {
  content_->meet_packet(rays, hits, mask);
}

std::uint32_t RayScene::shaded(const RayPacket& rays, std::uint32_t mask) const {
  return content_->shaded_lanes(rays, mask);
}

SurfaceLook RayScene::look(std::uint32_t shape, std::uint32_t primitive) const {
  return content_->look(shape, primitive);
}

SurfacePoint RayScene::look_at(std::uint32_t shape, std::uint32_t primitive, const Ray& ray,
                               double t) const {
  return content_->look_at(shape, primitive, ray, t);
}

double RayScene::intensity(const RayHit& hit) const { return content_->intensity(hit); }

RayGeometry RayScene::geometry() const { return content_->geometry; }
const std::vector<RayShape>& RayScene::shapes() const { return content_->shapes; }
const std::vector<Material>& RayScene::materials() const { return content_->materials; }
RayScene::Commits RayScene::commits() const { return content_->commits; }

}  // namespace trident::sim
