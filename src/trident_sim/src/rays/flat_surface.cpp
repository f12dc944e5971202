// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>

#include "ray_shape.h"

namespace trident::sim {
namespace {

struct Triangle {
  Eigen::Vector3d a, b, c;

  Triangle(const TriangleMesh& mesh, std::uint32_t primitive)
      : a(vertex(mesh, primitive, 0)),
        b(vertex(mesh, primitive, 1)),
        c(vertex(mesh, primitive, 2)) {}

  Eigen::Vector3d normal() const { return (b - a).cross(c - a); }  ///< as long as twice the area

 private:
  static Eigen::Vector3d vertex(const TriangleMesh& mesh, std::uint32_t primitive, int corner) {
    const std::size_t first = 3 * std::size_t{mesh.indices[3 * std::size_t{primitive} + corner]};
    return {mesh.vertices[first], mesh.vertices[first + 1], mesh.vertices[first + 2]};
  }
};

}  // namespace

FlatSurface flat_surface(const TracedShape& shape, std::uint32_t primitive) {
  if (shape.kind == SurfaceKind::kBox) {
    // Two triangles a face, in the order of box_triangles().
    const int face = static_cast<int>(primitive / 2), axis = face / 2;
    const double sign = face % 2 == 0 ? -1.0 : 1.0;
    const Eigen::Vector3d normal = sign * shape.R_world_shape.col(axis);
    return {normal, normal.dot(shape.p_world_shape) + shape.half_size[axis]};
  }
  if (shape.kind == SurfaceKind::kPlane) {
    const Eigen::Vector3d normal = shape.R_world_shape * shape.normal;
    return {normal, normal.dot(shape.p_world_shape)};
  }
  const Triangle corners(*shape.mesh, primitive);
  const Eigen::Vector3d normal = shape.R_world_shape * corners.normal().normalized();
  return {normal, normal.dot(shape.R_world_shape * corners.a + shape.p_world_shape)};
}

Eigen::Vector3d triangle_weights(const TriangleMesh& mesh, std::uint32_t primitive,
                                 const Eigen::Vector3d& p) {
  const Triangle t(mesh, primitive);
  const Eigen::Vector3d n = t.normal();
  const double area = n.squaredNorm();
  // Barycentric coordinates, the parts of the areas opposite to the corners.
  const double b = (p - t.a).cross(t.c - t.a).dot(n) / area;
  const double c = (t.b - t.a).cross(p - t.a).dot(n) / area;
  return {1.0 - b - c, b, c};
}

Eigen::Vector3d smooth_normal(const TriangleMesh& mesh, std::uint32_t primitive,
                              const Eigen::Vector3d& p) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  if (mesh.normals.empty()) return normal;
  const Eigen::Vector3d weights = triangle_weights(mesh, primitive, p);
  for (int i = 0; i < 3; ++i) {
    const float* const n = &mesh.normals[3 * std::size_t{mesh.indices[3 * primitive + i]}];
    normal += weights[i] * Eigen::Vector3d(n[0], n[1], n[2]);
  }
  const double length = normal.norm();
  return length > 1e-6 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d(normal.setZero());
}

}  // namespace trident::sim
