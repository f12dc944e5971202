// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The sea of a world, for many places and times at once.
#include "bindings.h"
#include "convert.h"
#include "marine/environment/water.h"
#include "session.h"
#include "trident_base/error.h"
#include "trident_sim/sea.h"

namespace py = pybind11;

namespace trident::sim {
namespace {

/// z of the surface, one per row; without a sea the surface lies at 0, as for vessels.
NumpyArray sea_elevation(Session& session, const py::object& places, const py::object& times) {
  const NumpyArray place_rows = to_array(places, "places", 2);
  const NumpyArray time_rows = to_array(times, "times", 1);
  if (place_rows.shape(1) != 2 || place_rows.shape(0) != time_rows.shape(0)) {
    throw Error("places has shape (" + std::to_string(place_rows.shape(0)) + ", " +
                std::to_string(place_rows.shape(1)) + "), legal: (" +
                std::to_string(time_rows.shape(0)) + ", 2), a row per time");
  }
  const auto place = place_rows.unchecked<2>();
  const auto time = time_rows.unchecked<1>();
  const auto sea = find_sea(session.world());
  NumpyArray result(time_rows.shape(0));
  auto elevation = result.mutable_unchecked<1>();
  for (py::ssize_t i = 0; i < time.shape(0); ++i) {
    const Eigen::Vector2d p(place(i, 0), place(i, 1));
    elevation(i) = sea == nullptr ? 0.0 : sea->water().column(p, {0.0, 0.0}, time(i)).elevation_m;
  }
  return result;
}

}  // namespace

void bind_sea(py::module_& module) {
  module.def("sea_elevation", &sea_elevation, py::arg("session"), py::arg("places"),
             py::arg("times"), "z of the sea's surface [m]; see World.sea_elevation.");
}

}  // namespace trident::sim
