// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "embree.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "box_rays.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

const TracedShape& shape_of(const void* user_data) {
  return *static_cast<const TracedShape*>(user_data);
}

bool counts(const TracedShape& shape, const RTCIntersectContext* embree) {
  const auto& context = *reinterpret_cast<const CastContext*>(embree);
  return shape.seen_by(*context.filter) && (shape.casts_shadows || !context.shadows_only);
}

/// Asked for each triangle that a ray is about to hit.
void filter_triangles(const RTCFilterFunctionNArguments* args) {
  if (counts(shape_of(args->geometryUserPtr), args->context)) return;
  std::fill_n(args->valid, args->N, 0);
}

/// The extents of a box or a round shape in its scene.
void bound(const RTCBoundsFunctionArguments* args) {
  const TracedShape& shape = shape_of(args->geometryUserPtr);
  const Eigen::Vector3d half =
      shape.R_scene_shape.cwiseAbs() * (shape.is_round() ? round_bounds(shape) : shape.half_size);
  // Floats have 24 bits: a little more than half a unit in the last place, also of those in which
  // Embree counts from where a ray begins.
  const double slack = 1e-4 + 1e-6 * (shape.p_scene_shape.cwiseAbs() + half).maxCoeff();
  const Eigen::Vector3d lower = shape.p_scene_shape - half, upper = shape.p_scene_shape + half;
  RTCBounds& bounds = *args->bounds_o;
  bounds.lower_x = static_cast<float>(lower.x() - slack);
  bounds.lower_y = static_cast<float>(lower.y() - slack);
  bounds.lower_z = static_cast<float>(lower.z() - slack);
  bounds.upper_x = static_cast<float>(upper.x() + slack);
  bounds.upper_y = static_cast<float>(upper.y() + slack);
  bounds.upper_z = static_cast<float>(upper.z() + slack);
}

/// Whether a ray, whose direction may be of any length, comes near the ball around a round shape.
/// Embree asks of every ray for a shape that is alone in its scene, and most rays miss it.
bool may_hit(const TracedShape& shape, const Eigen::Vector3d& origin,
             const Eigen::Vector3d& direction, double t_min, double t_max) {
  const Eigen::Vector3d to_middle = shape.p_scene_shape - origin;
  const double squared = direction.squaredNorm();
  const double length = std::sqrt(squared), along = to_middle.dot(direction) / length;
  // Floats have 24 bits.
  const double reach = shape.reach_m * (1.0 + 1e-5) + 1e-5 * std::abs(along);
  return along + reach >= t_min * length && along - reach <= t_max * length &&
         to_middle.cross(direction).squaredNorm() <= reach * reach * squared;
}

/// Where ray `i` of a packet hits a round shape, in the scene that the shape lies in.
std::optional<double> distance_to_round(const TracedShape& shape, RTCRayN* ray, unsigned n,
                                        unsigned i) {
  const Eigen::Vector3d origin(RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i),
                               RTCRayN_org_z(ray, n, i));
  const Eigen::Vector3d direction(RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i),
                                  RTCRayN_dir_z(ray, n, i));
  const double t_min = RTCRayN_tnear(ray, n, i), t_max = RTCRayN_tfar(ray, n, i);
  if (!may_hit(shape, origin, direction, t_min, t_max)) return std::nullopt;
  const auto& R = shape.R_scene_shape;
  return first_intersection(shape, {R.transpose() * (origin - shape.p_scene_shape),
                                    R.transpose() * direction, t_min, t_max});
}

void intersect_round(const RTCIntersectFunctionNArguments* args) {
  const TracedShape& shape = shape_of(args->geometryUserPtr);
  if (!counts(shape, args->context)) return;
  const unsigned n = args->N;
  RTCRayN* const ray = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* const hit = RTCRayHitN_HitN(args->rayhit, n);
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const auto distance = distance_to_round(shape, ray, n, i);
    if (!distance) continue;
    RTCRayN_tfar(ray, n, i) = static_cast<float>(*distance);
    RTCHitN_geomID(hit, n, i) = args->geomID;
    RTCHitN_primID(hit, n, i) = args->primID;
    RTCHitN_instID(hit, n, i, 0) = args->context->instID[0];
  }
}

void occlude_round(const RTCOccludedFunctionNArguments* args) {
  const TracedShape& shape = shape_of(args->geometryUserPtr);
  if (!counts(shape, args->context)) return;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0 || !distance_to_round(shape, args->ray, args->N, i)) continue;
    // Embree's sign of an occluded ray.
    RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

void intersect_one_box(const RTCIntersectFunctionNArguments* args) {
  const TracedShape& shape = shape_of(args->geometryUserPtr);
  if (counts(shape, args->context)) intersect_box(shape, *args);
}

void occlude_one_box(const RTCOccludedFunctionNArguments* args) {
  const TracedShape& shape = shape_of(args->geometryUserPtr);
  if (counts(shape, args->context)) occlude_box(shape, *args);
}

/// A box or a round shape, for which Embree asks us.
EmbreeGeometry make_own(RTCDevice device, const TracedShape& shape) {
  EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
  rtcSetGeometryBoundsFunction(
      geometry.get(), [](const RTCBoundsFunctionArguments* args) { bound(args); }, nullptr);
  const bool is_round = shape.is_round();
  rtcSetGeometryIntersectFunction(geometry.get(), is_round ? intersect_round : intersect_one_box);
  rtcSetGeometryOccludedFunction(geometry.get(), is_round ? occlude_round : occlude_one_box);
  return geometry;
}

EmbreeGeometry make_triangles(RTCDevice device, const TracedShape& shape,
                              const TriangleMesh& mesh) {
  EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertex_count()));
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const float* const p = &mesh.vertices[3 * v];
    const Eigen::Vector3d placed =
        shape.R_scene_shape * Eigen::Vector3d(p[0], p[1], p[2]) + shape.p_scene_shape;
    for (int i = 0; i < 3; ++i) *vertices++ = static_cast<float>(placed[i]);
  }
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangle_count()));
  std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
  return geometry;
}

EmbreeGeometry make_geometry(RTCDevice device, const TracedShape& shape, BoxForm boxes) {
  if (shape.kind == SurfaceKind::kMesh) return make_triangles(device, shape, *shape.mesh);
  if (shape.kind == SurfaceKind::kBox && boxes == BoxForm::kTriangles) {
    return make_triangles(device, shape, box_triangles(shape.half_size));
  }
  return make_own(device, shape);
}

}  // namespace

CastContext make_context(const RayFilter& filter, bool shadows_only, bool some_cast_no_shadow) {
  CastContext context{{}, &filter, shadows_only};
  rtcInitIntersectContext(&context.embree);
  if (filter.excludes() || (shadows_only && some_cast_no_shadow)) {
    context.embree.filter = filter_triangles;
  }
  return context;
}

EmbreeDevice make_device() {
  // Scenes are built in the thread that commits them;
  // others would compete with the world's workers.
  std::string config = "threads=1,set_affinity=0";
  // For tests: the kernels of processors with narrower instructions ("isa=avx2").
  if (const char* more = std::getenv("TRIDENT_EMBREE")) config += std::string(",") + more;
  EmbreeDevice device(rtcNewDevice(config.c_str()));
  if (device == nullptr) {
    throw Error("rays: Embree has no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
  }
  return device;
}

EmbreeScene make_scene(RTCDevice device, SceneUse use) {
  EmbreeScene scene(rtcNewScene(device));
  // Robust: without it rays slip through the edges between triangles.
  RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
  if (use == SceneUse::kMoving) flags = flags | RTC_SCENE_FLAG_DYNAMIC;
  rtcSetSceneFlags(scene.get(), flags);
  return scene;
}

void attach_shape(RTCDevice device, RTCScene scene, const TracedShape& shape, BoxForm boxes) {
  const EmbreeGeometry geometry = make_geometry(device, shape, boxes);
  rtcSetGeometryUserData(geometry.get(), const_cast<TracedShape*>(&shape));
  rtcSetGeometryMask(geometry.get(), shape.mask);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene, geometry.get());
}

EmbreeGeometry attach_instance(RTCDevice device, RTCScene scene, RTCScene part, const SE3& T) {
  EmbreeGeometry instance(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(instance.get(), part);
  rtcSetGeometryTimeStepCount(instance.get(), 1);
  place_instance(instance.get(), T);
  rtcAttachGeometry(scene, instance.get());
  return instance;
}

void place_instance(RTCGeometry instance, const SE3& T_world_link) {
  Eigen::Matrix<float, 3, 4> T;
  T << T_world_link.R.toRotationMatrix().cast<float>(), T_world_link.p.cast<float>();
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, T.data());
  rtcCommitGeometry(instance);
}

}  // namespace trident::sim
