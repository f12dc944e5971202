// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hull_params.h"
#include "marine/environment/water.h"
#include "trident_base/se3.h"

namespace trident::sim {

/// Buoyancy as VRX' plugin applies it, for comparisons: one force per section, straight up,
///
///   F = A(h) L rho 9.815,  h = surface - keel at the section's middle, cut to [0, R],
///
/// with the area A of a circle's segment of height h; the section's heel and the slope of the water
/// do not count. As Gazebo takes it, the lever is the keel's place in the link counted from the
/// centre of gravity.
class VrxHull {
 public:
  VrxHull(const HullParams& params, double water_density);

  /// Force and torque about the centre of gravity, world axes. `T_link_co` says where the sections
  /// are in the link.
  Vector6d wrench(const SE3& T_world_link, const SE3& T_link_co, const Water& water,
                  double time_s) const;

 private:
  struct Point {
    HullSection section;
    Eigen::Vector3d p_co_keel;
    double highest_m;  ///< that a section may be immersed
  };
  std::vector<Point> points_;
  double density_;
};

}  // namespace trident::sim
