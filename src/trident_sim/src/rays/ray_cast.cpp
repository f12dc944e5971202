// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Casting packets of rays, and what is known of the surfaces that they hit.
#include <algorithm>
#include <array>
#include <cmath>

#include "ray_content.h"

namespace trident::sim {
namespace {

constexpr std::size_t kLanes = RayScene::kPacket;

/// A packet as Embree takes it: which lanes count, and rays and hits lane by lane.
struct Packet {
  alignas(64) std::array<int, kLanes> valid{};
  RTCRayHit16 embree;
};

/// Embree ends the process at a component beyond the root of the largest float.
bool usable(const Ray& ray) {
  constexpr double kMaxSum = 1e18;
  const double sum = ray.p_world_origin.lpNorm<1>() + ray.direction_world.lpNorm<1>();
  return sum <= kMaxSum && ray.t_min_m <= ray.t_max_m;  // false for NaN
}

struct Extent {
  float low, high;
};
Extent extent_of(const float* lanes) {
  const Eigen::Map<const Eigen::Array<float, kLanes, 1>, Eigen::Aligned64> values(lanes);
  return {values.minCoeff(), values.maxCoeff()};
}

/// Rays of about the same direction through about the same place are best cast as one.
bool coherent(const RTCRay16& rays) {
  constexpr float kMaxSpread = 0.8F;  ///< of directions, about [rad]; of origins [m]
  float turn = 0.0F, shift = 0.0F;
  for (const float* component : {rays.dir_x, rays.dir_y, rays.dir_z}) {
    const Extent extent = extent_of(component);
    turn += (extent.high - extent.low) * (extent.high - extent.low);
  }
  for (const float* component : {rays.org_x, rays.org_y, rays.org_z}) {
    const Extent extent = extent_of(component);
    shift += (extent.high - extent.low) * (extent.high - extent.low);
  }
  return std::max(turn, shift) <= kMaxSpread * kMaxSpread;
}

/// The surface at t_max must not get lost by rounding; it is measured again anyway.
float beyond(double t) { return static_cast<float>(t * (1.0 + 1e-6)); }

/// What all rays of a packet have in common.
template <class Rays>
void set_common(Rays& rays, std::uint32_t mask) {
  std::fill_n(rays.time, kLanes, 0.0F);
  std::fill_n(rays.mask, kLanes, mask);
  std::fill_n(rays.id, kLanes, 0U);
  std::fill_n(rays.flags, kLanes, 0U);
}

template <class Rays>
void set_ray(Rays& rays, std::size_t lane, const Ray& ray, float t_max) {
  rays.org_x[lane] = static_cast<float>(ray.p_world_origin.x());
  rays.org_y[lane] = static_cast<float>(ray.p_world_origin.y());
  rays.org_z[lane] = static_cast<float>(ray.p_world_origin.z());
  rays.dir_x[lane] = traceable(static_cast<float>(ray.direction_world.x()));
  rays.dir_y[lane] = traceable(static_cast<float>(ray.direction_world.y()));
  rays.dir_z[lane] = traceable(static_cast<float>(ray.direction_world.z()));
  rays.tnear[lane] = static_cast<float>(ray.t_min_m);
  rays.tfar[lane] = t_max;
}

/// Makes the lanes that do not count look like one that does: where packets are narrower than
/// ours, Embree looks at all of them. Returns whether any lane counts.
template <class Rays>
bool fill_other_lanes(Rays& packet, const std::array<int, kLanes>& valid, const Ray* rays) {
  const auto some = std::find(valid.begin(), valid.end(), -1);
  if (some == valid.end()) return false;
  const Ray& model = rays[some - valid.begin()];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (valid[lane] == 0) set_ray(packet, lane, model, 0.0F);
  }
  return true;
}

}  // namespace

/// The nearest plane that the ray hits, and its distance in `t`; nullptr: none.
const TracedShape* RayScene::Content::nearest_plane(const Ray& ray, const RayFilter& filter,
                                                    bool shadows_only, double& t) const {
  const TracedShape* nearest = nullptr;
  t = ray.t_max_m;
  for (const PlacedPlane& plane : planes_) {
    const double distance = plane.surface.distance(ray);
    if (!(distance >= ray.t_min_m && distance <= t)) continue;
    if (!plane.shape->seen_by(filter) || (shadows_only && !plane.shape->casts_shadows)) continue;
    nearest = plane.shape;
    t = distance;
  }
  return nearest;
}

const TracedShape& RayScene::Content::shape_hit(std::uint32_t instance,
                                                std::uint32_t geometry_number) const {
  return instance == RTC_INVALID_GEOMETRY_ID ? *fixed_.shapes[geometry_number]
                                             : *part_shapes_[instance][geometry_number];
}

void RayScene::Content::add_look(const Ray& ray, const TracedShape& shape, std::uint32_t primitive,
                                 RayHit& hit) const {
  const LocalRay local = shape.to_local(ray);
  const Eigen::Vector3d p = local.at(hit.distance_m);
  hit.uv = texture_at(shape, primitive, p);
  hit.material = shape.material;
  if (shape.has_mesh_materials) hit.material += shape.mesh->triangle_materials[primitive];
  if (shape.kind != SurfaceKind::kMesh) return;
  const Eigen::Vector3d smooth = smooth_normal(*shape.mesh, primitive, p);
  if (!smooth.isZero(0.0)) hit.normal_world = shape.R_world_shape * smooth;
}

/// What is hit at a distance that Embree or a plane found, measured again in double.
RayHit RayScene::Content::describe(const Ray& ray, const TracedShape& shape,
                                   std::uint32_t primitive, double t) const {
  RayHit hit;
  hit.shape = shape.index;
  hit.distance_m = t;
  if (shape.is_round()) {
    const LocalRay local = shape.to_local(ray);
    hit.distance_m = first_intersection(shape, local).value_or(t);
    hit.normal_world = shape.R_world_shape * round_normal(shape, local.at(hit.distance_m));
  } else {
    const FlatSurface surface = flat_surface(shape, primitive);
    hit.normal_world = surface.normal_world;
    if (const double exact = surface.distance(ray); std::isfinite(exact)) hit.distance_m = exact;
  }
  // A surface on which the ray begins may be measured a trace behind it.
  hit.distance_m = std::max(hit.distance_m, ray.t_min_m);
  if (geometry_ == RayGeometry::kVisual) add_look(ray, shape, primitive, hit);
  if (hit.normal_world.dot(ray.direction_world) > 0.0) hit.normal_world = -hit.normal_world;
  return hit;
}

void RayScene::Content::cast_packet(const Ray* rays, RayHit* hits, std::size_t count,
                                    const RayFilter& filter) const {
  Packet packet;
  std::array<const TracedShape*, kLanes> planes{};
  std::array<double, kLanes> limits{};
  RTCHit16& embree_hit = packet.embree.hit;
  std::fill_n(embree_hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(embree_hit.instID[0], kLanes, RTC_INVALID_GEOMETRY_ID);
  set_common(packet.embree.ray, filter.mask);
  for (std::size_t lane = 0; lane < count; ++lane) {
    hits[lane] = {};
    if (!usable(rays[lane])) continue;
    packet.valid[lane] = -1;
    // The nearest plane bounds the ray before Embree sees it.
    planes[lane] = nearest_plane(rays[lane], filter, false, limits[lane]);
    set_ray(packet.embree.ray, lane, rays[lane], beyond(limits[lane]));
  }
  if (!fill_other_lanes(packet.embree.ray, packet.valid, rays)) return;
  CastContext context = make_context(filter, false, tables_.some_cast_no_shadow);
  if (fixed_.scene != nullptr) {
    // It is the triangles that Embree intersects faster so.
    if (fixed_.has_triangles && coherent(packet.embree.ray))
      context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(packet.valid.data(), fixed_.scene.get(), &context.embree, &packet.embree);
  }
  moving_.intersect(packet.valid, packet.embree, context);
  for (std::size_t lane = 0; lane < count; ++lane) {
    const Ray& ray = rays[lane];
    if (embree_hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID) {
      const TracedShape& shape = shape_hit(embree_hit.instID[0][lane], embree_hit.geomID[lane]);
      hits[lane] = describe(ray, shape, embree_hit.primID[lane], packet.embree.ray.tfar[lane]);
      // Measured in double it may lie behind the plane after all.
      if (hits[lane].distance_m <= limits[lane]) continue;
      hits[lane] = {};
    }
    if (planes[lane] != nullptr) hits[lane] = describe(ray, *planes[lane], 0, limits[lane]);
  }
}

void RayScene::Content::occlude_packet(const Ray* rays, bool* result, std::size_t count,
                                       const RayFilter& filter) const {
  alignas(64) std::array<int, kLanes> valid{};
  RTCRay16 packet;
  set_common(packet, filter.mask);
  for (std::size_t lane = 0; lane < count; ++lane) {
    result[lane] = false;
    if (!usable(rays[lane])) continue;
    double t = 0.0;
    result[lane] = nearest_plane(rays[lane], filter, true, t) != nullptr;
    if (result[lane]) continue;
    valid[lane] = -1;
    set_ray(packet, lane, rays[lane], static_cast<float>(rays[lane].t_max_m));
  }
  if (!fill_other_lanes(packet, valid, rays)) return;
  // Never with the flag for coherent rays: with instances Embree 3.13.5 does not come back then.
  CastContext context = make_context(filter, true, tables_.some_cast_no_shadow);
  if (fixed_.scene != nullptr)
    rtcOccluded16(valid.data(), fixed_.scene.get(), &context.embree, &packet);
  const auto note = [&] {
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (valid[lane] == 0 || packet.tfar[lane] >= 0.0F) continue;
      result[lane] = true;
      valid[lane] = 0;
    }
  };
  note();
  moving_.occlude(valid, packet, context);
  note();
}

}  // namespace trident::sim
