// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>

#include "bindings.h"
#include "trident_base/error.h"

namespace py = pybind11;

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled part of trident_sim; import trident_sim instead.";
  auto& error = py::register_exception<trident::Error>(module, "Error", PyExc_ValueError);
  error.attr("__module__") = "trident_sim";
  error.attr("__doc__") =
      "Bad input: a file, a field, a name or a value. The text names it and what is legal.";
  trident::sim::bind_measurements(module);
  trident::sim::bind_cameras(module);
  trident::sim::bind_commands(module);
  trident::sim::bind_model(module);
  trident::sim::bind_session(module);
  trident::sim::bind_physics(module);
  trident::sim::bind_radio(module);
  trident::sim::bind_rays(module);
  trident::sim::bind_environment(module);
  trident::sim::bind_sea(module);
  trident::sim::bind_rollout(module);
}
