// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trident::sim {

struct Geom;

/// A point in which two collisions touched in the last step; world frame.
struct Contact {
  const Geom *geom1 = nullptr, *geom2 = nullptr;      ///< neither is nullptr in World::contacts()
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();  ///< of unit length, into geometry 1
  double depth_m = 0.0;                                    ///< how far one is within the other
  Eigen::Vector3d force_world = Eigen::Vector3d::Zero();   ///< on geometry 1, friction included [N]
  /// Where geometry 1 and 2 are pushed about: the centres of mass of their bodies, and the middle
  /// of a geometry that is part of the world.
  Eigen::Vector3d p_world_center1 = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_world_center2 = Eigen::Vector3d::Zero();  ///< see p_world_center1 [m]
};

}  // namespace trident::sim
