// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Geometry>
#include <string>

#include "trident_base/se3.h"
#include "trident_base/sim_time.h"

namespace trident::sim {

using Matrix6RowMajor = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Matrix3RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using NumpyArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// Python values -> ours. Each throws Error naming `what`, its shape or value, and what is legal.

/// Finite numbers of `dimensions` dimensions.
NumpyArray to_array(const pybind11::handle& value, const std::string& what, int dimensions);
/// Three finite numbers.
Eigen::Vector3d to_vector3(const pybind11::handle& value, const std::string& what);
/// (x, y, z), (x, y, z, roll, pitch, yaw) or (x, y, z, qx, qy, qz, qw); [m], [rad].
SE3 to_pose(const pybind11::handle& value, const std::string& what);
/// Nine decimal digits of seconds are nanoseconds that an integer of 64 bits holds.
constexpr double kMaxSeconds = 9e9;
/// Seconds, 0 to kMaxSeconds.
SimTime to_time(double seconds, const std::string& what);

/// (x, y, z, w), as ROS orders them.
inline Eigen::Vector4d xyzw(const Eigen::Quaterniond& R) { return R.coeffs(); }

}  // namespace trident::sim
