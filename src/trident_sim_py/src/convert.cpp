// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "convert.h"

#include <cmath>

#include "trident_base/error.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

std::string shape_text(const NumpyArray& array) {
  return py::repr(py::cast<py::object>(array.attr("shape"))).cast<std::string>();
}

void check_finite(const NumpyArray& array, const std::string& what) {
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    if (std::isfinite(array.data()[i])) continue;
    throw Error(what + "[" + std::to_string(i) + "] is " + std::to_string(array.data()[i]) +
                ", legal: finite numbers");
  }
}

}  // namespace

NumpyArray to_array(const py::handle& value, const std::string& what, int dimensions) {
  NumpyArray array = NumpyArray::ensure(value);
  if (!array) {
    // numpy's error is replaced by one that names the argument.
    PyErr_Clear();
    throw Error(what + " is " + py::repr(value).cast<std::string>() + ", legal: numbers");
  }
  if (array.ndim() != dimensions) {
    throw Error(what + " has shape " + shape_text(array) +
                ", legal: " + std::to_string(dimensions) + " dimension(s)");
  }
  check_finite(array, what);
  return array;
}

Eigen::Vector3d to_vector3(const py::handle& value, const std::string& what) {
  const NumpyArray array = to_array(value, what, 1);
  if (array.size() != 3) throw Error(what + " has shape " + shape_text(array) + ", legal: (3,)");
  return Eigen::Vector3d(array.data());
}

SE3 to_pose(const py::handle& value, const std::string& what) {
  const NumpyArray array = to_array(value, what, 1);
  const double* x = array.data();
  if (array.size() == 3) return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x)};
  if (array.size() == 6) return SE3::from_xyz_rpy(Eigen::Vector3d(x), x[3], x[4], x[5]);
  if (array.size() != 7) {
    throw Error(what + " has shape " + shape_text(array) +
                ", legal: (3,) x y z, (6,) x y z roll pitch yaw, (7,) x y z qx qy qz qw");
  }
  // Eigen's constructor takes w first, the array has it last.
  const Eigen::Quaterniond R(x[6], x[3], x[4], x[5]);
  if (std::abs(R.norm() - 1.0) > 1e-3) {
    throw Error(what + ": quaternion of norm " + std::to_string(R.norm()) + ", legal: 1");
  }
  return {R.normalized(), Eigen::Vector3d(x)};
}

SimTime to_time(double seconds, const std::string& what) {
  if (!(seconds >= 0.0 && seconds <= kMaxSeconds)) {
    throw Error(what + " is " + std::to_string(seconds) + " s, legal: 0 to 9e9 s");
  }
  return SimTime::from_seconds(seconds);
}

}  // namespace trident::sim
