// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <random>
#include <vector>

#include "trident_control/lee_position_controller.h"

namespace trident::control::test {

/// Equation by equation in scalar loops and a Gauss-Jordan solve: shares nothing with the library
/// but its parameter structs. R is row-major.
std::vector<double> reference_lee_speeds(const LeeParams& params, const OdometryState& state,
                                         const TrajectoryPoint& reference);

/// Same for roll, pitch, yaw-rate, thrust.
std::vector<double> reference_attitude_speeds(const VehicleParams& vehicle,
                                              const AttitudeGains& gains,
                                              const AttitudeQuirks& quirks,
                                              const OdometryState& state,
                                              const AttitudeCommand& command);

/// Regular n-rotor at `arm_length`, alternating direction, first arm at `first_angle`; the other
/// parameters are the firefly's.
VehicleParams regular_multirotor(int rotor_count, double arm_length, double first_angle);

/// Uniform state within +-5 m, m/s, rad/s and any attitude.
OdometryState random_state(std::mt19937_64& random);
TrajectoryPoint random_point(std::mt19937_64& random);

/// Torque (body) and thrust that the rotors give at these speeds, summed rotor by rotor.
std::array<double, 4> wrench_of(const VehicleParams& vehicle, const std::vector<double>& speeds);

}  // namespace trident::control::test
