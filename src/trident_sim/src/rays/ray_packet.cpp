// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Packets as pictures cast them: Embree and planes in float, the exact surface on request.
#include "ray_packet.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ray_content.h"

namespace trident::sim {
namespace {

constexpr std::size_t kLanes = kPacketLanes;

PacketFloats all_traceable(const PacketFloats& components) {
  PacketFloats result;
  for (std::size_t i = 0; i < kLanes; ++i) result[i] = traceable(components[i]);
  return result;
}

void copy_rays(const RayPacket& from, const PacketFloats& t_max, std::uint32_t mask, RTCRay16& to) {
  std::memcpy(to.org_x, from.origin_x.data(), sizeof(to.org_x));
  std::memcpy(to.org_y, from.origin_y.data(), sizeof(to.org_y));
  std::memcpy(to.org_z, from.origin_z.data(), sizeof(to.org_z));
  std::memcpy(to.dir_x, all_traceable(from.direction_x).data(), sizeof(to.dir_x));
  std::memcpy(to.dir_y, all_traceable(from.direction_y).data(), sizeof(to.dir_y));
  std::memcpy(to.dir_z, all_traceable(from.direction_z).data(), sizeof(to.dir_z));
  std::memcpy(to.tnear, from.t_min.data(), sizeof(to.tnear));
  std::memcpy(to.tfar, t_max.data(), sizeof(to.tfar));
  std::fill_n(to.time, kLanes, 0.0F);
  std::fill_n(to.mask, kLanes, mask);
  std::fill_n(to.id, kLanes, 0U);
  std::fill_n(to.flags, kLanes, 0U);
}

/// Makes the lanes that do not count look like one that does: where packets are narrower than
/// ours, Embree looks at all of them, and ends the process at one that is not finite.
void fill_other_lanes(const RayPacket& from, RTCRay16& to) {
  const auto some = std::find(from.valid.begin(), from.valid.end(), -1);
  if (some == from.valid.end()) return;
  const auto model = some - from.valid.begin();
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (from.valid[i] != 0) continue;
    for (float* component :
         {to.org_x, to.org_y, to.org_z, to.dir_x, to.dir_y, to.dir_z, to.tnear}) {
      component[i] = component[model];
    }
    to.tfar[i] = 0.0F;
  }
}

/// Distances to a plane, lane by lane; not finite along the plane.
PacketFloats plane_distances(const FlatSurface& plane, const RayPacket& rays) {
  const Eigen::Vector3f n = plane.normal_world.cast<float>();
  const auto offset = static_cast<float>(plane.offset_m);
  PacketFloats t;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float height =
        n.x() * rays.origin_x[i] + n.y() * rays.origin_y[i] + n.z() * rays.origin_z[i] - offset;
    const float sinking =
        n.x() * rays.direction_x[i] + n.y() * rays.direction_y[i] + n.z() * rays.direction_z[i];
    // A ray along the plane divides by zero: infinity or NaN fails the comparisons with its limits.
    t[i] = -height / sinking;
  }
  return t;
}

}  // namespace

void RayScene::Content::intersect_packet(const RayPacket& rays, PacketHits& hits,
                                         std::uint32_t mask) const {
  hits.t = rays.t_max;
  hits.shape.fill(RayHit::kNothing);
  hits.primitive.fill(0);
  const RayFilter filter{mask, nullptr, nullptr};
  for (const PlacedPlane& plane : planes_) {
    if (!plane.shape->seen_by(filter)) continue;
    const PacketFloats t = plane_distances(plane.surface, rays);
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (rays.valid[i] == 0 || !(t[i] >= rays.t_min[i] && t[i] <= hits.t[i])) continue;
      hits.t[i] = t[i];
      hits.shape[i] = plane.shape->index;
    }
  }
  if (fixed_.scene == nullptr && moving_.empty()) return;
  alignas(64) RTCRayHit16 embree;
  copy_rays(rays, hits.t, mask, embree.ray);
  fill_other_lanes(rays, embree.ray);
  std::fill_n(embree.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(embree.hit.instID[0], kLanes, RTC_INVALID_GEOMETRY_ID);
  CastContext context = make_context(filter, false, tables_.some_cast_no_shadow);
  if (fixed_.scene != nullptr) {
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(rays.valid.data(), fixed_.scene.get(), &context.embree, &embree);
  }
  moving_.intersect(rays.valid, embree, context);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (rays.valid[i] == 0 || embree.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    hits.t[i] = embree.ray.tfar[i];
    hits.shape[i] = shape_hit(embree.hit.instID[0][i], embree.hit.geomID[i]).index;
    hits.primitive[i] = embree.hit.primID[i];
  }
}

std::uint32_t RayScene::Content::shaded_lanes(const RayPacket& rays, std::uint32_t mask) const {
  std::uint32_t shaded = 0, wanted = 0;
  for (std::size_t i = 0; i < kLanes; ++i) wanted |= rays.valid[i] != 0 ? 1U << i : 0U;
  const RayFilter filter{mask, nullptr, nullptr};
  for (const PlacedPlane& plane : planes_) {
    if (!plane.shape->seen_by(filter) || !plane.shape->casts_shadows) continue;
    const PacketFloats t = plane_distances(plane.surface, rays);
    for (std::size_t i = 0; i < kLanes; ++i) {
      shaded |= t[i] >= rays.t_min[i] && t[i] <= rays.t_max[i] ? 1U << i : 0U;
    }
  }
  alignas(64) RTCRay16 embree;
  copy_rays(rays, rays.t_max, mask, embree);
  fill_other_lanes(rays, embree);
  // Never with the flag for coherent rays: with instances Embree 3.13.5 does not come back then.
  CastContext context = make_context(filter, true, tables_.some_cast_no_shadow);
  // Lanes that are in shadow already are not cast again.
  const auto left = [&] {
    MovingParts::Lanes valid;
    for (std::size_t i = 0; i < kLanes; ++i) {
      valid[i] = ((wanted & ~shaded) >> i & 1U) != 0 ? -1 : 0;
    }
    return valid;
  };
  const auto note = [&](const MovingParts::Lanes& valid) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      shaded |= valid[i] != 0 && embree.tfar[i] < 0.0F ? 1U << i : 0U;
    }
  };
  if (fixed_.scene != nullptr && (wanted & ~shaded) != 0) {
    alignas(64) const MovingParts::Lanes valid = left();
    rtcOccluded16(valid.data(), fixed_.scene.get(), &context.embree, &embree);
    note(valid);
  }
  if (!moving_.empty() && (wanted & ~shaded) != 0) {
    const MovingParts::Lanes valid = left();
    moving_.occlude(valid, embree, context);
    note(valid);
  }
  return shaded & wanted;
}

SurfaceLook RayScene::Content::look(std::uint32_t shape_index, std::uint32_t primitive) const {
  const TracedShape& shape = *tables_.traced[shape_index];
  SurfaceLook look;
  look.material = shape.material;
  if (shape.has_mesh_materials) look.material += shape.mesh->triangle_materials[primitive];
  if (look.material < textures_.by_material.size())
    look.texture = textures_.by_material[look.material];
  look.is_flat = !shape.is_round();
  if (!look.is_flat) return look;
  look.is_smooth = shape.kind == SurfaceKind::kMesh && !shape.mesh->normals.empty();
  const FlatSurface surface = flat_surface(shape, primitive);
  look.normal_world = surface.normal_world;
  look.offset_m = surface.offset_m;
  // Texture coordinates are linear in the place; the shape's own axes give their slopes.
  const Eigen::Vector2d base = texture_at(shape, primitive, Eigen::Vector3d::Zero()).cast<double>();
  Eigen::Matrix<double, 2, 3> slope;
  for (int axis = 0; axis < 3; ++axis) {
    slope.col(axis) =
        texture_at(shape, primitive, Eigen::Vector3d::Unit(axis)).cast<double>() - base;
  }
  look.uv_slope = slope * shape.R_world_shape.transpose();
  look.uv_base = base - look.uv_slope * shape.p_world_shape;
  return look;
}

SurfacePoint RayScene::Content::look_at(std::uint32_t shape_index, std::uint32_t primitive,
                                        const Ray& ray, double t) const {
  const TracedShape& shape = *tables_.traced[shape_index];
  const LocalRay local = shape.to_local(ray);
  SurfacePoint point;
  point.t = t;
  if (shape.is_round()) {
    point.t = first_intersection(shape, local).value_or(t);
    point.normal_world = shape.R_world_shape * round_normal(shape, local.at(point.t));
  } else {
    const FlatSurface surface = flat_surface(shape, primitive);
    point.normal_world = surface.normal_world;
    if (const double exact = surface.distance(ray); std::isfinite(exact)) point.t = exact;
    if (shape.kind == SurfaceKind::kMesh) {
      const Eigen::Vector3d smooth = smooth_normal(*shape.mesh, primitive, local.at(point.t));
      if (!smooth.isZero(0.0)) point.normal_world = shape.R_world_shape * smooth;
    }
  }
  point.uv = texture_at(shape, primitive, local.at(point.t)).cast<double>();
  return point;
}

}  // namespace trident::sim
