// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "contact_margin.h"

#include <algorithm>
#include <variant>

namespace trident::sim {
namespace {

/// What falls for two steps of 10 ms comes 3 mm, for two of 1 ms 0.03 mm. A small shape stays what
/// it is: a part of its least extent.
constexpr double kMargin = 1e-3, kMaxPart = 0.01;

double least_extent(const BoxShape& box) { return box.size.minCoeff(); }
double least_extent(const SphereShape& sphere) { return 2.0 * sphere.radius; }
double least_extent(const CylinderShape& cylinder) {
  return std::min(2.0 * cylinder.radius, cylinder.length);
}
double least_extent(const CapsuleShape& capsule) { return 2.0 * capsule.radius; }
template <class Other>
double least_extent(const Other& /*shape*/) {
  return 0.0;
}

template <class Vector>
void clamp_length(Vector&& v, double most) {
  const double length = v.norm();
  if (length > most) v *= most / length;
}

/// The point of the shape without its margin that is nearest to `p`, in the shape's frame.
Eigen::Vector3d nearest_of_shape(const EngineGeom& geom, Eigen::Vector3d p) {
  dReal radius = 0.0, length = 0.0;
  dVector3 sides = {0.0, 0.0, 0.0};
  switch (dGeomGetClass(geom.id)) {
    case dBoxClass: {
      dGeomBoxGetLengths(geom.id, sides);
      const Eigen::Array3d half =
          0.5 * Eigen::Array3d(sides[0], sides[1], sides[2]) - geom.margin_m;
      return p.array().max(-half).min(half);
    }
    case dSphereClass:
      clamp_length(p, dGeomSphereGetRadius(geom.id) - geom.margin_m);
      return p;
    case dCylinderClass: {
      dGeomCylinderGetParams(geom.id, &radius, &length);
      const double half = 0.5 * length - geom.margin_m;
      clamp_length(p.head<2>(), radius - geom.margin_m);
      p.z() = std::clamp(p.z(), -half, half);
      return p;
    }
    case dCapsuleClass: {
      dGeomCapsuleGetParams(geom.id, &radius, &length);
      const Eigen::Vector3d on_axis(0.0, 0.0, std::clamp(p.z(), -0.5 * length, 0.5 * length));
      p -= on_axis;
      clamp_length(p, radius - geom.margin_m);
      return on_axis + p;
    }
    default:
      return p;
  }
}

Eigen::Vector3d nearest_of_shape_in_world(const EngineGeom& geom, const Eigen::Vector3d& p_world) {
  if (!(geom.margin_m > 0.0)) return p_world;
  using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const Eigen::Matrix3d R = Eigen::Map<const Rows>(dGeomGetRotation(geom.id)).leftCols<3>();
  const Eigen::Vector3d center = Eigen::Map<const Eigen::Vector3d>(dGeomGetPosition(geom.id));
  return center + R * nearest_of_shape(geom, R.transpose() * (p_world - center));
}

}  // namespace

double contact_margin(const Shape& shape) {
  const double extent =
      std::visit([](const auto& one_shape) { return least_extent(one_shape); }, shape);
  return std::min(kMargin, kMaxPart * extent);
}

void take_margins_off(dContactGeom& found, const EngineGeom& a, const EngineGeom& b) {
  const Eigen::Vector3d normal(found.normal[0], found.normal[1], found.normal[2]);  // into a
  const Eigen::Vector3d p(found.pos[0], found.pos[1], found.pos[2]);
  // A corner of a larger box is further out than its faces are.
  const Eigen::Vector3d on_a = nearest_of_shape_in_world(a, p);
  const Eigen::Vector3d on_both = nearest_of_shape_in_world(b, on_a);
  found.depth -= std::max(a.margin_m, normal.dot(on_a - p));
  found.depth -= std::max(b.margin_m, normal.dot(on_a - on_both));
  for (int i = 0; i < 3; ++i) found.pos[i] = on_both[i];
}

}  // namespace trident::sim
