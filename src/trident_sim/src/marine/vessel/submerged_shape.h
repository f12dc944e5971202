// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trident_base/se3.h"

namespace trident::sim {

/// What of a shape is below a level.
struct Submerged {
  double volume_m3 = 0.0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< world frame; 0 without volume
};

/// A solid whose surface is triangles, for what the water displaces: box, upright cylinder (z) and
/// sphere, the latter two as polyhedra of exactly their volume.
class FloatingShape {
 public:
  static FloatingShape box(const Eigen::Vector3d& size_m);
  static FloatingShape cylinder(double radius_m, double length_m);
  static FloatingShape sphere(double radius_m);

  double volume_m3() const { return volume_m3_; }
  /// `level_m`: z of the water's surface, which is flat over the shape.
  Submerged below(double level_m, const SE3& T_world_shape) const;

 private:
  using Ring = std::vector<Eigen::Vector3d>;
  /// Closed by the first and the last ring; each turns counterclockwise about +z, from below up.
  FloatingShape(const std::vector<Ring>& rings, double volume_m3);

  struct Triangle {
    Eigen::Vector3d a, b, c;  ///< counterclockwise from outside
  };
  std::vector<Triangle> triangles_;
  double volume_m3_;
};

}  // namespace trident::sim
