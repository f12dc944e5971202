// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "trident_base/config_types.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Of the motion model Vessel.
struct VesselConstraintsParams {
  std::string vessel_file;
  std::array<double, 2> current{0.0, 0.0};

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("vessel_file", vessel_file, "as config/vessels/*.yaml: masses, damping, thrusters");
    ar.field("current", current, Range::any(), "velocity of the water in the costmap's axes [m/s]");
  }
};

/// How a vessel answers to forces in surge (0), sway (1) and yaw (2), in axes x forward, y left, z
/// up. Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control" (2021), section 6.5,
/// without the coupling of sway and yaw in the matrices, but with the Munk moment of the hull and
/// what rudders can do at each speed.
struct VesselMotion {
  std::array<double, 3> mass{1.0, 1.0, 1.0};       ///< With added mass [kg, kg, kg m^2].
  std::array<double, 3> linear_damping{};          ///< [N s/m, N m s]
  std::array<double, 3> quadratic_damping{};       ///< [N s^2/m^2, N m s^2]
  std::array<double, 3> force_min{}, force_max{};  ///< Of all thrusters, each axis alone [N, N m].
  double munk_mass = 0.0;  ///< Of the moment -munk_mass u v that turns a drifting hull abeam [kg].
  /// Rudders' greatest side force over the square of the speed through water, and its moment.
  double rudder_force = 0.0, rudder_moment = 0.0;  ///< [N s^2/m^2, N s^2/m]
  Point2 current;                                  ///< Of the water, in the costmap's axes [m/s].
};

/// The vessel of a file. Throws ConfigError, or Error where no file is named or it has no thruster.
VesselMotion load_vessel_motion(const VesselConstraintsParams& params);

}  // namespace trident::nav
