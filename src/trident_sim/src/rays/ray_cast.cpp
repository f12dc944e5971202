// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Casting packets of rays, and what is told of the surfaces that they meet.
#include <algorithm>
#include <array>
#include <cmath>

#include "ray_content.h"

namespace trident {
namespace {

constexpr std::size_t kLanes = RayScene::kPacket;

/// A packet as Embree takes it: which lanes count, and rays and hits lane by lane.
struct Packet {
  alignas(64) std::array<int, kLanes> valid{};
  RTCRayHit16 embree;
};

bool usable(const Ray& ray) {
  return ray.p_world_origin.allFinite() && ray.direction_world.allFinite() &&
         ray.t_min_m <= ray.t_max_m;
}

/// Whether a component of a direction is about zero, or changes its sign among the rays. Embree
/// 3.13.5 loses whole coherent packets with such: those of a lidar that is all but level.
bool near_an_axis_plane(const Ray* rays, std::size_t count) {
  constexpr double kAboutZero = 1e-4;
  Eigen::Array3d lowest = rays[0].direction_world.array(), highest = lowest;
  for (std::size_t i = 1; i < count; ++i) {
    lowest = lowest.min(rays[i].direction_world.array());
    highest = highest.max(rays[i].direction_world.array());
  }
  return (lowest < kAboutZero && highest > -kAboutZero).any();
}

/// Rays that go about the same way through about the same place are best cast as one.
bool coherent(const Ray* rays, std::size_t count) {
  if (near_an_axis_plane(rays, count)) return false;
  constexpr double kMaxSpread = 0.8;  ///< of directions, about [rad]; of origins [m]
  for (std::size_t i = 1; i < count; ++i) {
    const double turn = (rays[i].direction_world - rays[0].direction_world).squaredNorm();
    const double shift = (rays[i].p_world_origin - rays[0].p_world_origin).squaredNorm();
    if (!(std::max(turn, shift) <= kMaxSpread * kMaxSpread)) return false;
  }
  return true;
}

/// The surface at t_max must not get lost by rounding; it is measured again anyway.
float beyond(double t) { return static_cast<float>(t * (1.0 + 1e-6)); }

template <class Rays>
void set_ray(Rays& rays, std::size_t lane, const Ray& ray, float t_max, std::uint32_t mask) {
  rays.org_x[lane] = static_cast<float>(ray.p_world_origin.x());
  rays.org_y[lane] = static_cast<float>(ray.p_world_origin.y());
  rays.org_z[lane] = static_cast<float>(ray.p_world_origin.z());
  rays.dir_x[lane] = static_cast<float>(ray.direction_world.x());
  rays.dir_y[lane] = static_cast<float>(ray.direction_world.y());
  rays.dir_z[lane] = static_cast<float>(ray.direction_world.z());
  rays.tnear[lane] = static_cast<float>(ray.t_min_m);
  rays.tfar[lane] = t_max;
  rays.time[lane] = 0.0F;
  rays.mask[lane] = mask;
  rays.id[lane] = 0;
  rays.flags[lane] = 0;
}

}  // namespace

/// The nearest plane that the ray meets, and its distance in `t`; nullptr: none.
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

const TracedShape& RayScene::Content::shape_met(std::uint32_t instance,
                                                std::uint32_t geometry_number) const {
  return instance == RTC_INVALID_GEOMETRY_ID ? *fixed_shapes_[geometry_number]
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

/// What is met at a distance that Embree or a plane found, measured again in double.
RayHit RayScene::Content::describe(const Ray& ray, const TracedShape& shape,
                                   std::uint32_t primitive, double t) const {
  RayHit hit;
  hit.shape = shape.index;
  hit.distance_m = t;
  if (shape.is_round()) {
    const LocalRay local = shape.to_local(ray);
    hit.distance_m = first_meeting(shape, local).value_or(t);
    hit.normal_world = shape.R_world_shape * round_normal(shape, local.at(hit.distance_m));
  } else {
    const FlatSurface surface = flat_surface(shape, primitive);
    hit.normal_world = surface.normal_world;
    if (const double exact = surface.distance(ray); std::isfinite(exact)) hit.distance_m = exact;
  }
  // A surface on which the ray begins may be measured a trace behind it.
  hit.distance_m = std::max(hit.distance_m, ray.t_min_m);
  if (geometry == RayGeometry::kVisual) add_look(ray, shape, primitive, hit);
  if (hit.normal_world.dot(ray.direction_world) > 0.0) hit.normal_world = -hit.normal_world;
  return hit;
}

void RayScene::Content::cast_packet(const Ray* rays, RayHit* hits, std::size_t count,
                                    const RayFilter& filter) const {
  Packet packet;
  std::array<const TracedShape*, kLanes> planes{};
  std::array<double, kLanes> limits{};
  RTCHit16& met = packet.embree.hit;
  for (std::size_t lane = 0; lane < count; ++lane) {
    met.geomID[lane] = met.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    hits[lane] = {};
    if (!usable(rays[lane])) continue;
    packet.valid[lane] = -1;
    planes[lane] = nearest_plane(rays[lane], filter, false, limits[lane]);
    set_ray(packet.embree.ray, lane, rays[lane], beyond(limits[lane]), filter.mask);
  }
  CastContext context = make_context(filter, false, some_cast_no_shadow_);
  if (fixed_ != nullptr) {
    if (coherent(rays, count)) context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(packet.valid.data(), fixed_.get(), &context.embree, &packet.embree);
  }
  if (moving_ != nullptr) {
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    rtcIntersect16(packet.valid.data(), moving_.get(), &context.embree, &packet.embree);
  }
  for (std::size_t lane = 0; lane < count; ++lane) {
    const Ray& ray = rays[lane];
    if (met.geomID[lane] != RTC_INVALID_GEOMETRY_ID) {
      const TracedShape& shape = shape_met(met.instID[0][lane], met.geomID[lane]);
      hits[lane] = describe(ray, shape, met.primID[lane], packet.embree.ray.tfar[lane]);
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
  for (std::size_t lane = 0; lane < count; ++lane) {
    result[lane] = false;
    if (!usable(rays[lane])) continue;
    double t = 0.0;
    result[lane] = nearest_plane(rays[lane], filter, true, t) != nullptr;
    if (result[lane]) continue;
    valid[lane] = -1;
    set_ray(packet, lane, rays[lane], static_cast<float>(rays[lane].t_max_m), filter.mask);
  }
  // Never with the flag for coherent rays: with instances Embree 3.13.5 does not come back then.
  CastContext context = make_context(filter, true, some_cast_no_shadow_);
  for (RTCScene scene : {fixed_.get(), moving_.get()}) {
    if (scene == nullptr) continue;
    rtcOccluded16(valid.data(), scene, &context.embree, &packet);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (valid[lane] == 0 || packet.tfar[lane] >= 0.0F) continue;
      result[lane] = true;
      valid[lane] = 0;
    }
  }
}

}  // namespace trident
