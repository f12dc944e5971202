// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "models.h"

namespace trident::sim {

/// A plugin as a file may have it.
struct ReferenceCase {
  PluginSpec plugin;
  std::optional<SensorSpec> sensor = std::nullopt;  ///< that it belongs to
  bool is_of_world = false;
  bool needs_vehicle = false;  ///< it is put with the plugins of the quadrotor
};

/// All that ship, some of them several times: with each choice that makes them ask for elements
/// which they do not ask for otherwise.
std::vector<ReferenceCase> reference_cases();

/// The quadrotor of make_quad() with the plugin on it.
ModelSpec reference_model(const ReferenceCase& plugin);

}  // namespace trident::sim
