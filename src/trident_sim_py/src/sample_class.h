// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include "convert.h"
#include "trident_sim/samples.h"

namespace trident::sim {

namespace py = pybind11;

/// A class with the time of the sample, as seconds and as exact nanoseconds.
template <class Sample>
py::class_<Sample> stamped(py::module_& module, const char* name, const char* doc) {
  py::class_<Sample> result(module, name, doc);
  result.attr("__module__") = "trident_sim";
  result.def_property_readonly(
      "stamp", [](const Sample& s) { return static_cast<double>(s.stamp.ns) / 1e9; },
      "Simulated time of the sample [s].");
  result.def_property_readonly(
      "stamp_ns", [](const Sample& s) { return s.stamp.ns; },
      "Simulated time of the sample, exact [ns].");
  return result;
}

/// Position and orientation of `T`, a member.
template <class Sample>
void add_pose(py::class_<Sample>& sample, SE3 Sample::*T) {
  sample.def_property_readonly(
      "position", [T](const Sample& s) { return (s.*T).p; }, "Position [m], shape (3,).");
  sample.def_property_readonly(
      "orientation", [T](const Sample& s) { return xyzw((s.*T).R); },
      "Unit quaternion x y z w, shape (4,).");
}

inline py::array_t<double> to_numpy(Span<const double> values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

}  // namespace trident::sim
