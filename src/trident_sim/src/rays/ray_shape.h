// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/geometry/mesh.h"
#include "trident_base/se3.h"
#include "trident_sim/ray_scene.h"

namespace trident::sim {

/// A ray in the frame of a shape.
struct LocalRay {
  Eigen::Vector3d origin, direction;
  double t_min_m, t_max_m;

  Eigen::Vector3d at(double t) const { return origin + t * direction; }
};

/// The plane n . p = offset, in the world.
struct FlatSurface {
  Eigen::Vector3d normal_world;  ///< outward, of unit length
  double offset_m;

  /// Along a ray; not finite when that lies within the plane.
  double distance(const Ray& ray) const {
    return (offset_m - normal_world.dot(ray.p_world_origin)) /
           normal_world.dot(ray.direction_world);
  }
};

enum class SurfaceKind { kBox, kSphere, kCylinder, kCapsule, kPlane, kMesh };

/// One collision or visual as rays know it. Meshes are intersected by Embree as triangles, planes
/// by RayScene, boxes as BoxForm says, the others by the functions below.
struct TracedShape {
  SurfaceKind kind = SurfaceKind::kBox;
  Eigen::Vector3d half_size = Eigen::Vector3d::Zero();  ///< of a box [m]
  double radius_m = 0.0, half_length_m = 0.0;           ///< of round shapes
  double reach_m = 0.0;  ///< of a round shape's points, from its middle
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of a plane
  std::shared_ptr<const TriangleMesh> mesh;

  SE3 T_link_shape;
  /// Of the shape in the Embree scene that it lies in: the world, or its link
  Eigen::Matrix3d R_scene_shape = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_scene_shape = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_world_shape = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_world_shape = Eigen::Vector3d::Zero();

  std::string name;
  const VisualSpec* visual = nullptr;         ///< of visuals; lives as long as the model
  const Model* model = nullptr;               ///< never looked into: it may be gone
  const Link* link = nullptr;                 ///< never looked into: it may be gone
  std::uint32_t index = 0;                    ///< into RayScene::shapes()
  std::uint32_t material = RayHit::kNothing;  ///< into RayScene::materials()
  bool has_mesh_materials = false;            ///< `material` is the first of the mesh's own
  std::uint32_t mask = 0xffffffff;
  bool casts_shadows = true;
  std::optional<double> laser_retro;

  bool is_round() const {
    return kind == SurfaceKind::kSphere || kind == SurfaceKind::kCylinder ||
           kind == SurfaceKind::kCapsule;
  }
  bool seen_by(const RayFilter& filter) const {
    return (mask & filter.mask) != 0 && model != filter.exclude_model &&
           link != filter.exclude_link;
  }
  LocalRay to_local(const Ray& ray) const {
    return {R_world_shape.transpose() * (ray.p_world_origin - p_world_shape),
            R_world_shape.transpose() * ray.direction_world, ray.t_min_m, ray.t_max_m};
  }
};

/// A shape of its kind and sizes, unplaced. `mesh`: of a mesh or heightmap.
TracedShape make_traced_shape(const Shape& shape, std::shared_ptr<const TriangleMesh> mesh);

/// First distance in [t_min, t_max] at which the ray hits the surface of a round shape.
std::optional<double> first_intersection(const TracedShape& shape, const LocalRay& ray);
/// Outward normal of a round shape in its own frame, at a point of its surface.
Eigen::Vector3d round_normal(const TracedShape& shape, const Eigen::Vector3d& p);

/// Where triangle `primitive` of a mesh lies, face `primitive` / 2 of a box, or a plane.
FlatSurface flat_surface(const TracedShape& shape, std::uint32_t primitive);

/// Weights of a triangle's corners at a point `p` of its plane (frame of the shape); they add to 1.
Eigen::Vector3d triangle_weights(const TriangleMesh& mesh, std::uint32_t primitive,
                                 const Eigen::Vector3d& p);
/// Texture coordinates of point `p` (frame of the shape) of triangle `primitive`.
Eigen::Vector2f texture_at(const TracedShape& shape, std::uint32_t primitive,
                           const Eigen::Vector3d& p);
/// A mesh's own normal at point `p` of triangle `primitive`, in its frame; zero: it has none there.
Eigen::Vector3d smooth_normal(const TriangleMesh& mesh, std::uint32_t primitive,
                              const Eigen::Vector3d& p);

/// Half the extents of the box around a round shape, in its own frame [m].
Eigen::Vector3d round_bounds(const TracedShape& shape);

/// The triangles of a box: the two of face f (-x, +x, -y, +y, -z, +z) are 2f and 2f + 1.
TriangleMesh box_triangles(const Eigen::Vector3d& half_size);

}  // namespace trident::sim
