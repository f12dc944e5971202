// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/vehicle_params.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <sstream>
#include <string>

#include "trident_base/error.h"

namespace trident::control {
namespace {

// Rows are scaled to length 1 before the rank is taken, so this is free of units.
constexpr double kRankTolerance = 1e-9;

std::string text_of(double value) {
  std::ostringstream out;
  out.precision(10);
  out << value;
  return out.str();
}

[[noreturn]] void refuse(const std::string& field, const std::string& value,
                         const std::string& range) {
  throw Error("vehicle parameter '" + field + "' is " + value + ": it must be " + range);
}

void require_positive(const std::string& field, double value) {
  if (!(std::isfinite(value) && value > 0.0)) refuse(field, text_of(value), "a finite number > 0");
}

void require_not_negative(const std::string& field, double value) {
  if (!(std::isfinite(value) && value >= 0.0)) {
    refuse(field, text_of(value), "a finite number >= 0");
  }
}

void validate_inertia(const Eigen::Matrix3d& inertia) {
  std::ostringstream text;
  text << "[xx " << inertia(0, 0) << ", xy " << inertia(0, 1) << ", xz " << inertia(0, 2) << ", yy "
       << inertia(1, 1) << ", yz " << inertia(1, 2) << ", zz " << inertia(2, 2) << "]";
  const std::string range = "symmetric and positive definite [kg m^2]";
  if (!inertia.allFinite() || !inertia.isApprox(inertia.transpose(), 1e-12)) {
    refuse("inertia", text.str(), range);
  }
  // Only a positive definite matrix has a Cholesky factorization.
  if (inertia.llt().info() != Eigen::Success) refuse("inertia", text.str(), range);
}

void validate_rotor(const RotorConfig& rotor, std::size_t index) {
  const std::string prefix = "rotor_configuration/" + std::to_string(index) + "/";
  if (!std::isfinite(rotor.angle)) refuse(prefix + "angle", text_of(rotor.angle), "finite [rad]");
  require_positive(prefix + "arm_length", rotor.arm_length);
  require_positive(prefix + "rotor_force_constant", rotor.force_constant);
  require_not_negative(prefix + "rotor_moment_constant", rotor.moment_constant);
  if (rotor.direction != 1 && rotor.direction != -1) {
    refuse(prefix + "direction", std::to_string(rotor.direction), "1 (ccw) or -1 (cw)");
  }
  const double axis_length = rotor.thrust_axis_body.norm();
  if (!(std::abs(axis_length - 1.0) < 1e-6)) {
    refuse(prefix + "thrust_axis_body", "of length " + text_of(axis_length), "a unit vector");
  }
}

// Rows are moments and a force and differ by their units and levers, hence the scaling.
void require_full_rank(const AllocationMatrix& allocation) {
  Eigen::Matrix<double, 4, Eigen::Dynamic> scaled = allocation;
  for (int row = 0; row < 4; ++row) {
    const double length = scaled.row(row).norm();
    if (length > 0.0) scaled.row(row) /= length;
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled);
  svd.setThreshold(kRankTolerance);
  if (svd.rank() < 4) {
    throw Error("vehicle parameter 'rotor_configuration' of " + std::to_string(allocation.cols()) +
                " rotors gives an allocation matrix of rank " + std::to_string(svd.rank()) +
                ": it must be 4 (roll, pitch, yaw and thrust independent of each other)");
  }
}

}  // namespace

std::vector<RotorConfig> VehicleParams::firefly_rotors() {
  constexpr double kSixth = 0.52359877559;  // pi / 6 as the RotorS parameter files round it [rad]
  constexpr double kHalf = 1.57079632679;
  constexpr double kFiveSixths = 2.61799387799;
  std::vector<RotorConfig> rotors;
  int direction = 1;
  for (const double angle : {kSixth, kHalf, kFiveSixths, -kFiveSixths, -kHalf, -kSixth}) {
    rotors.push_back({angle, 0.215, 8.54858e-6, 1.6e-2, direction});
    direction = -direction;
  }
  return rotors;
}

void VehicleParams::validate() const {
  require_positive("mass", mass);
  if (!(std::isfinite(gravity) && gravity >= 0.0)) {
    refuse("gravity", text_of(gravity), "a finite number >= 0 [m/s^2]");
  }
  validate_inertia(inertia);
  if (rotors.size() < 4 || rotors.size() > kMaxRotors) {
    refuse("rotor_configuration", "a list of " + std::to_string(rotors.size()) + " rotors",
           "4 to " + std::to_string(kMaxRotors) + " rotors");
  }
  for (std::size_t i = 0; i < rotors.size(); ++i) validate_rotor(rotors[i], i);
}

AllocationMatrix allocation_matrix(const VehicleParams& vehicle) {
  vehicle.validate();
  AllocationMatrix allocation(4, static_cast<Eigen::Index>(vehicle.rotors.size()));
  for (std::size_t i = 0; i < vehicle.rotors.size(); ++i) {
    const RotorConfig& rotor = vehicle.rotors[i];
    const Eigen::Vector3d p_body =
        rotor.arm_length * Eigen::Vector3d(std::cos(rotor.angle), std::sin(rotor.angle), 0.0);
    const Eigen::Vector3d& axis = rotor.thrust_axis_body;
    // The air's reaction on the body acts against the rotor's sense: a ccw rotor turns it cw.
    const double drag = rotor.direction * rotor.moment_constant;
    const auto column = static_cast<Eigen::Index>(i);
    allocation.block<3, 1>(0, column) = rotor.force_constant * (p_body.cross(axis) - drag * axis);
    allocation(3, column) = rotor.force_constant * axis.z();
  }
  require_full_rank(allocation);
  return allocation;
}

AllocationInverse allocation_inverse(const AllocationMatrix& allocation) {
  // The gram matrix is invertible, as the rank is 4.
  const Eigen::Matrix4d gram = allocation * allocation.transpose();
  return allocation.transpose() * gram.inverse();
}

}  // namespace trident::control
