// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

namespace trident::sim {

/// Of a particle of water, world frame.
struct WaterMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< [m/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< [m/s^2]
};

/// The water in one vertical, world frame.
struct WaterColumn {
  double elevation_m = 0.0;                         ///< z of the surface
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< of the surface along x and y
  std::array<WaterMotion, 2> motion;                ///< at the two depths that were asked for
};

/// Water as a hull feels it. Implementations are pure functions of place and time, so that it does
/// not matter who asks, how often and in which order.
class Water {
 public:
  virtual ~Water() = default;
  /// `depths_m` are below the surface there, not below z = 0 (Wheeler's stretching); >= 0.
  virtual WaterColumn column(const Eigen::Vector2d& p_world, const std::array<double, 2>& depths_m,
                             double time_s) const = 0;
};

/// Flat and at rest.
class StillWater : public Water {
 public:
  explicit StillWater(double level_m = 0.0) : level_m_(level_m) {}
  WaterColumn column(const Eigen::Vector2d&, const std::array<double, 2>&, double) const override {
    WaterColumn result;
    result.elevation_m = level_m_;
    return result;
  }

 private:
  double level_m_;
};

}  // namespace trident::sim
