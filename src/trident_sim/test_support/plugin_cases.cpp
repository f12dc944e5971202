// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "plugin_cases.h"

namespace trident::sim {

std::vector<PluginCase> builtin_plugin_cases() {
  PluginRegistry registry;
  register_builtin_plugins(registry);
  std::vector<PluginCase> cases;
  for (const std::string& name : registry.names()) {
    const auto& example = registry.find(name)->example;
    if (example) cases.push_back(case_of("lib" + name + ".so", *example));
  }
  return cases;
}

}  // namespace trident::sim
