// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "trident_base/vehicle/rudder_params.h"
#include "trident_base/vehicle/thruster_params.h"

namespace trident::control {

/// Surge force, sway force [N] and yaw moment [N m] about CO, body axes (x forward, y left, z up).
using PlanarForce = Eigen::Vector3d;

/// How a vessel moves in the horizontal plane. Heading and course are angles from x towards y.
struct VesselState {
  Eigen::Vector2d p_world = Eigen::Vector2d::Zero();  ///< [m]
  double heading = 0.0;                               ///< [rad]
  double u = 0.0, v = 0.0;                            ///< over ground, along and to the left [m/s]
  double r = 0.0;                                     ///< [rad/s]
};

/// What a controller wants to know of a vessel: surge, sway and yaw without their coupling, and
/// the actuators, in axes FLU.
struct VesselModel {
  std::string name;                                ///< as in the file; names the vessel in errors
  Eigen::Vector3d mass = Eigen::Vector3d::Ones();  ///< with added mass, about CO
  double munk_mass = 0.0;  ///< added mass of sway less that of surge; 0: no Munk moment [kg]
  Eigen::Vector3d linear_damping = Eigen::Vector3d::Zero();     ///< [N s/m, N m s]
  Eigen::Vector3d quadratic_damping = Eigen::Vector3d::Zero();  ///< [N s^2/m^2, N m s^2]
  double water_density = 1025.0;                                ///< [kg/m^3]
  std::vector<ThrusterParams> thrusters;                        ///< at least one; positions from CO
  std::vector<RudderParams> rudders;                            ///< may be empty

  /// The force that keeps up the velocity `nu` of one axis (0 surge, 1 sway, 2 yaw) in still water.
  double drag(int axis, double nu) const {
    return (linear_damping[axis] + quadratic_damping[axis] * std::abs(nu)) * nu;
  }
};

/// Reads those parts of a config/vessels/*.yaml. The others are the simulator's to judge. Throws
/// ConfigError; Error for a vessel without a thruster or with a thrust curve that falls.
VesselModel load_vessel_model(const std::string& path);

}  // namespace trident::control
