// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace trident::sim {

// Parts of the module _core; module.cpp calls each once.
void bind_measurements(pybind11::module_& module);
void bind_cameras(pybind11::module_& module);
void bind_commands(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_physics(pybind11::module_& module);
void bind_radio(pybind11::module_& module);
void bind_rays(pybind11::module_& module);
void bind_rollout(pybind11::module_& module);
void bind_environment(pybind11::module_& module);
void bind_sea(pybind11::module_& module);
void bind_session(pybind11::module_& module);

}  // namespace trident::sim
