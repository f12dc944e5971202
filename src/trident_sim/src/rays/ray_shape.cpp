// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ray_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trident::sim {
namespace {

/// By which parts of a shape overlap, lest a ray slips through the seam by rounding [m].
constexpr double kSeam = 1e-9;

/// The smaller, then the larger root of a t^2 + 2 b t + c, without loss of digits; none: no root.
std::optional<std::array<double, 2>> roots(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0.0) || !(a > 0.0)) return std::nullopt;
  // The root without cancellation first; the other one by Vieta's formula, t0 t1 = c / a.
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0.0) return std::array<double, 2>{0.0, 0.0};
  const double t0 = q / a, t1 = c / q;
  return std::array<double, 2>{std::min(t0, t1), std::max(t0, t1)};
}

/// Keeps the least of the distances offered to it that the ray allows.
class Nearest {
 public:
  explicit Nearest(const LocalRay& ray) : ray_(ray) {}
  void offer(double t) {
    if (t >= ray_.t_min_m && t <= ray_.t_max_m && !(t >= best_)) best_ = t;
  }
  std::optional<double> best() const {
    return std::isnan(best_) ? std::nullopt : std::optional<double>(best_);
  }

 private:
  const LocalRay& ray_;
  double best_ = std::numeric_limits<double>::quiet_NaN();
};

void offer_sphere(const LocalRay& ray, double radius, double center_z, Nearest& nearest,
                  double from_z, double to_z) {
  const Eigen::Vector3d o = ray.origin - Eigen::Vector3d(0.0, 0.0, center_z);
  // From the point nearest to the centre, lest far origins cost digits.
  const double a = ray.direction.squaredNorm(), middle = -o.dot(ray.direction) / a;
  const Eigen::Vector3d m = o + middle * ray.direction;
  const auto t = roots(a, m.dot(ray.direction), m.squaredNorm() - radius * radius);
  if (!t) return;
  for (const double offset : *t) {
    const double z = m.z() + offset * ray.direction.z();
    if (z >= from_z && z <= to_z) nearest.offer(middle + offset);
  }
}

void offer_tube(const LocalRay& ray, double radius, double half_length, Nearest& nearest) {
  const Eigen::Vector2d o = ray.origin.head<2>(), d = ray.direction.head<2>();
  const double a = d.squaredNorm();
  if (!(a > 0.0)) return;
  const double middle = -o.dot(d) / a;
  const Eigen::Vector2d m = o + middle * d;
  const auto t = roots(a, m.dot(d), m.squaredNorm() - radius * radius);
  if (!t) return;
  for (const double offset : *t) {
    if (std::abs(ray.at(middle + offset).z()) <= half_length + kSeam)
      nearest.offer(middle + offset);
  }
}

void offer_discs(const LocalRay& ray, double radius, double half_length, Nearest& nearest) {
  if (ray.direction.z() == 0.0) return;
  for (const double z : {-half_length, half_length}) {
    const double t = (z - ray.origin.z()) / ray.direction.z();
    if (ray.at(t).head<2>().squaredNorm() <= radius * radius) nearest.offer(t);
  }
}

struct Maker {
  TracedShape& made;
  void operator()(const BoxShape& s) const { made.half_size = 0.5 * s.size; }
  void operator()(const SphereShape& s) const {
    made.kind = SurfaceKind::kSphere;
    made.radius_m = s.radius;
  }
  void operator()(const CylinderShape& s) const {
    made.kind = SurfaceKind::kCylinder;
    made.radius_m = s.radius;
    made.half_length_m = 0.5 * s.length;
  }
  void operator()(const CapsuleShape& s) const {
    made.kind = SurfaceKind::kCapsule;
    made.radius_m = s.radius;
    made.half_length_m = 0.5 * s.length;
  }
  void operator()(const PlaneShape& s) const {
    made.kind = SurfaceKind::kPlane;
    made.normal = s.normal.normalized();
  }
  void operator()(const MeshShape&) const { made.kind = SurfaceKind::kMesh; }
  void operator()(const HeightmapShape&) const { made.kind = SurfaceKind::kMesh; }
};

}  // namespace

TracedShape make_traced_shape(const Shape& shape, std::shared_ptr<const TriangleMesh> mesh) {
  TracedShape made;
  std::visit(Maker{made}, shape);
  made.mesh = std::move(mesh);
  made.reach_m = round_bounds(made).norm();
  return made;
}

std::optional<double> first_intersection(const TracedShape& shape, const LocalRay& ray) {
  constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  const double r = shape.radius_m, h = shape.half_length_m;
  Nearest nearest(ray);
  switch (shape.kind) {
    case SurfaceKind::kSphere:
      offer_sphere(ray, r, 0.0, nearest, -kEverywhere, kEverywhere);
      break;
    case SurfaceKind::kCylinder:
      offer_tube(ray, r, h, nearest);
      offer_discs(ray, r, h, nearest);
      break;
    case SurfaceKind::kCapsule:
      offer_tube(ray, r, h, nearest);
      offer_sphere(ray, r, h, nearest, -kSeam, kEverywhere);
      offer_sphere(ray, r, -h, nearest, -kEverywhere, kSeam);
      break;
    default:
      break;
  }
  return nearest.best();
}

Eigen::Vector3d round_normal(const TracedShape& shape, const Eigen::Vector3d& p) {
  const double r = shape.radius_m, h = shape.half_length_m;
  if (shape.kind == SurfaceKind::kSphere) return p.normalized();
  if (shape.kind == SurfaceKind::kCapsule) {
    return (p - Eigen::Vector3d(0.0, 0.0, std::min(h, std::max(-h, p.z())))).normalized();
  }
  const double radial = p.head<2>().norm();
  // At the edge the face counts where the point is farther beyond it than beyond the side.
  if (std::abs(p.z()) - h > radial - r) return {0.0, 0.0, std::copysign(1.0, p.z())};
  return {p.x() / radial, p.y() / radial, 0.0};
}

Eigen::Vector3d round_bounds(const TracedShape& shape) {
  const double caps = shape.kind == SurfaceKind::kCylinder ? 0.0 : shape.radius_m;
  return {shape.radius_m, shape.radius_m, shape.half_length_m + caps};
}

TriangleMesh box_triangles(const Eigen::Vector3d& half_size) {
  TriangleMesh mesh;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      // Bit i of a corner's number says on which side of axis i it is.
      const double side = (corner >> axis) % 2 == 0 ? -1.0 : 1.0;
      mesh.vertices.push_back(static_cast<float>(side * half_size[axis]));
    }
  }
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t along = 1U << ((axis + 1) % 3), across = 1U << ((axis + 2) % 3);
    // Faces in the order -x, +x, -y, ...: flat_surface() finds a face by its triangles' numbers.
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t first = side << axis;
      const std::uint32_t last = first + along + across;
      mesh.indices.insert(mesh.indices.end(), {first, first + along, last});
      mesh.indices.insert(mesh.indices.end(), {first, last, first + across});
    }
  }
  return mesh;
}

}  // namespace trident::sim
