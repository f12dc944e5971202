// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Where on its picture a point of a surface lies.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "rays/ray_shape.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

/// Side walls have v upwards and u to the right as seen from outside; top and bottom y upwards.
Eigen::Vector2d on_box(const TracedShape& shape, std::uint32_t primitive,
                       const Eigen::Vector3d& p) {
  const int face = static_cast<int>(primitive / 2), axis = face / 2;
  const double sign = face % 2 == 0 ? -1.0 : 1.0;
  const Eigen::Vector3d q = p.cwiseQuotient(2.0 * shape.half_size);
  const double u = axis == 0 ? q.y() : axis == 1 ? -q.x() : q.x();
  return {sign * u + 0.5, (axis == 2 ? q.y() : q.z()) + 0.5};
}

/// u around the axis, from -x over -y; v upwards.
Eigen::Vector2d on_round(const TracedShape& shape, const Eigen::Vector3d& p) {
  const double u = std::atan2(p.y(), p.x()) / (2.0 * kPi) + 0.5;
  const double r = shape.radius_m, h = shape.half_length_m;
  if (shape.kind == SurfaceKind::kSphere) {
    return {u, std::asin(std::clamp(p.z() / r, -1.0, 1.0)) / kPi + 0.5};
  }
  if (shape.kind == SurfaceKind::kCapsule) return {u, (p.z() + h + r) / (2.0 * (h + r))};
  if (round_normal(shape, p).z() != 0.0) return p.head<2>() / (2.0 * r) + Eigen::Vector2d(0.5, 0.5);
  return {u, (p.z() + h) / (2.0 * h)};
}

Eigen::Vector2d on_mesh(const TriangleMesh& mesh, std::uint32_t primitive,
                        const Eigen::Vector3d& p) {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  if (mesh.uvs.empty()) return uv;
  const Eigen::Vector3d weights = triangle_weights(mesh, primitive, p);
  for (int i = 0; i < 3; ++i) {
    const float* const corner = &mesh.uvs[2 * std::size_t{mesh.indices[3 * primitive + i]}];
    uv += weights[i] * Eigen::Vector2d(corner[0], corner[1]);
  }
  return uv;
}

}  // namespace

Eigen::Vector2f texture_at(const TracedShape& shape, std::uint32_t primitive,
                           const Eigen::Vector3d& p) {
  if (shape.kind == SurfaceKind::kBox) return on_box(shape, primitive, p).cast<float>();
  if (shape.kind == SurfaceKind::kMesh) return on_mesh(*shape.mesh, primitive, p).cast<float>();
  if (shape.is_round()) return on_round(shape, p).cast<float>();
  const auto level = Eigen::Quaterniond::FromTwoVectors(shape.normal, Eigen::Vector3d::UnitZ());
  return (level * p).head<2>().cast<float>();
}

}  // namespace trident::sim
