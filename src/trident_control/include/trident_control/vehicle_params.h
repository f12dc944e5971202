// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace trident::control {

/// Upper bound on the rotors of one vehicle; keeps the control path free of heap memory.
inline constexpr std::size_t kMaxRotors = 16;

/// One rotor as the controller sees it. Body frame: x forward, y left, z up.
struct RotorConfig {
  double angle = 0.0;       ///< azimuth of the arm about body z [rad], 0 = forward, ccw positive
  double arm_length = 0.0;  ///< distance from the centre of mass [m]
  double force_constant = 0.0;   ///< k_f in F = k_f speed^2 [N s^2/rad^2]
  double moment_constant = 0.0;  ///< k_m, drag torque per thrust [m]
  int direction = 1;             ///< +1 ccw, -1 cw, seen from above
  Eigen::Vector3d thrust_axis_body = Eigen::Vector3d::UnitZ();  ///< unit vector; tilted if canted
};

/// What a multirotor controller must know of its vehicle. Defaults: the AscTec Firefly of RotorS.
struct VehicleParams {
  double mass = 1.56779;  ///< [kg]
  double gravity = 9.81;  ///< [m/s^2], along -z of the world
  Eigen::Matrix3d inertia =
      Eigen::Vector3d(0.0347563, 0.0458929, 0.0977).asDiagonal();  ///< [kg m^2], body
  /// In the order of the motor speeds; 4 to kMaxRotors.
  std::vector<RotorConfig> rotors = firefly_rotors();

  /// Six rotors, as RotorS' firefly.yaml has them.
  static std::vector<RotorConfig> firefly_rotors();

  /// Throws trident::Error naming the field, its value and the legal range.
  void validate() const;
};

/// 4 x n: squared rotor speeds [rad^2/s^2] -> (torque about body x, y, z [N m]; thrust along body z
/// [N]).
using AllocationMatrix = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, kMaxRotors>;
/// n x 4: the minimum-norm right inverse of AllocationMatrix.
using AllocationInverse = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::ColMajor, kMaxRotors, 4>;

/// Column i = k_f [ p x z ; z_z ] - [ dir k_f k_m z ; 0 ], with p the rotor's place and z its axis.
/// For an upright rotor: [ l sin(a) k_f, -l cos(a) k_f, -dir k_f k_m, k_f ]. Throws trident::Error
/// for invalid parameters and for a rank below 4 (an axis that no rotor can turn).
AllocationMatrix allocation_matrix(const VehicleParams& vehicle);

/// A' (A A')^-1.
AllocationInverse allocation_inverse(const AllocationMatrix& allocation);

}  // namespace trident::control
