// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "submerged_shape.h"

#include <array>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::sim {
namespace {

/// Facets of round shapes; their volume is scaled to the exact one.
constexpr int kRoundSides = 24, kBelts = 12;

std::vector<Eigen::Vector3d> circle(double radius, double z) {
  std::vector<Eigen::Vector3d> ring;
  for (int i = 0; i < kRoundSides; ++i) {
    const double angle = 2.0 * kPi * i / kRoundSides;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return ring;
}

/// The volume below z = 0 by tetrahedra from an apex in that plane, which the waterplane, as it
/// holds the apex, adds nothing to.
class Tetrahedra {
 public:
  explicit Tetrahedra(const Eigen::Vector3d& apex) : apex_(apex) {}

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    // Signed: faces are counterclockwise from outside, and tetrahedra outside of the body cancel.
    const double volume = (a - apex_).dot((b - apex_).cross(c - apex_)) / 6.0;
    volume_ += volume;
    moment_ += volume * (a + b + c + apex_) / 4.0;
  }
  /// What of a triangle is below z = 0.
  void add_clipped(const std::array<Eigen::Vector3d, 3>& corners) {
    std::array<Eigen::Vector3d, 4> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d &from = corners[i], &to = corners[(i + 1) % corners.size()];
      if (from.z() <= 0.0) kept[count++] = from;
      if ((from.z() <= 0.0) != (to.z() <= 0.0)) {
        kept[count++] = from + (to - from) * (from.z() / (from.z() - to.z()));
      }
    }
    for (std::size_t i = 2; i < count; ++i) add(kept[0], kept[i - 1], kept[i]);
  }

  double volume() const { return volume_; }
  Eigen::Vector3d centroid() const { return moment_ / volume_; }

 private:
  Eigen::Vector3d apex_, moment_ = Eigen::Vector3d::Zero();
  double volume_ = 0.0;
};

}  // namespace

FloatingShape::FloatingShape(const std::vector<Ring>& rings, double volume_m3)
    : volume_m3_(volume_m3) {
  const std::size_t sides = rings.front().size();
  for (std::size_t i = 0; i < sides; ++i) {
    const std::size_t next = (i + 1) % sides;
    if (i + 2 < sides) {
      const Ring &bottom = rings.front(), &top = rings.back();
      triangles_.push_back({bottom[0], bottom[i + 2], bottom[i + 1]});
      triangles_.push_back({top[0], top[i + 1], top[i + 2]});
    }
    for (std::size_t belt = 0; belt + 1 < rings.size(); ++belt) {
      const Ring &low = rings[belt], &high = rings[belt + 1];
      triangles_.push_back({low[i], low[next], high[next]});
      triangles_.push_back({low[i], high[next], high[i]});
    }
  }
  Tetrahedra whole(Eigen::Vector3d::Zero());
  for (const Triangle& t : triangles_) whole.add(t.a, t.b, t.c);
  const double scale = std::cbrt(volume_m3_ / whole.volume());
  for (Triangle& t : triangles_) t = {scale * t.a, scale * t.b, scale * t.c};
}

FloatingShape FloatingShape::box(const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d h = 0.5 * size_m;
  const auto ring = [&h](double z) {
    return Ring{{-h.x(), -h.y(), z}, {h.x(), -h.y(), z}, {h.x(), h.y(), z}, {-h.x(), h.y(), z}};
  };
  return {{ring(-h.z()), ring(h.z())}, size_m.prod()};
}

FloatingShape FloatingShape::cylinder(double radius_m, double length_m) {
  return {{circle(radius_m, -0.5 * length_m), circle(radius_m, 0.5 * length_m)},
          kPi * radius_m * radius_m * length_m};
}

FloatingShape FloatingShape::sphere(double radius_m) {
  std::vector<Ring> rings;
  for (int belt = 1; belt < kBelts; ++belt) {
    const double angle = kPi * (static_cast<double>(belt) / kBelts - 0.5);
    rings.push_back(circle(radius_m * std::cos(angle), radius_m * std::sin(angle)));
  }
  return {rings, 4.0 / 3.0 * kPi * radius_m * radius_m * radius_m};
}

Submerged FloatingShape::below(double level_m, const SE3& T_world_shape) const {
  const Eigen::Matrix3d R = T_world_shape.R.toRotationMatrix();
  // The apex is vertically in line with the shape's origin, so that far places cost no digits.
  const Eigen::Vector3d p(0.0, 0.0, T_world_shape.p.z() - level_m);
  Tetrahedra wet(Eigen::Vector3d::Zero());
  for (const Triangle& t : triangles_) wet.add_clipped({R * t.a + p, R * t.b + p, R * t.c + p});
  if (!(wet.volume() > 0.0)) return {};
  return {wet.volume(), wet.centroid() - p + T_world_shape.p};
}

}  // namespace trident::sim
