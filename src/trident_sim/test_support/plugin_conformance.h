// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {

/// What every plugin must do. A plugin of this package is tested by its example (case_of());
/// the test of another one is one of these and one call.
struct PluginCase {
  std::string filename;
  ParamList params;                   ///< valid and complete
  std::vector<std::string> required;  ///< without one of these it refuses, naming it
  std::vector<std::string> numbers;   ///< these refuse what is not a finite number
  /// Of a sensor's plugin: the sensor, which is put on base_link
  std::optional<SensorSpec> sensor = std::nullopt;
};

/// The case of a plugin's own example, in the namespace "ns". Throws Error where the example is no
/// legal SDF.
PluginCase case_of(const std::string& filename, const PluginExample& example);

/// Expects, of the plugin alone on the links of make_quad(): it constructs; refuses a missing
/// required element and a bad number with the element's name; runs; after a reset gives the outputs
/// of its first run; continues from a snapshot as it did; and takes its ports with it when its
/// model is deleted.
void expect_plugin_conforms(const PluginCase& plugin,
                            void (*register_plugins)(PluginRegistry&) = nullptr);

}  // namespace trident::sim
