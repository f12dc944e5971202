// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/layer_factory.h"

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::nav {

std::string plugin_class(const std::string& plugin_name) {
  const std::size_t end = plugin_name.find_last_of(":/");
  return end == std::string::npos ? plugin_name : plugin_name.substr(end + 1);
}

std::unique_ptr<Layer> make_layer(const Registry<LayerType>& registry,
                                  const std::string& plugin_name, const LayerSetup& setup) {
  const LayerType* type = registry.find(plugin_class(plugin_name));
  if (type == nullptr) {
    throw ConfigError(
        setup.source, 0, setup.path,
        "no layer plugin is called '" + plugin_name + "'; known: " + join(registry.names()));
  }
  return type->make(setup);
}

}  // namespace trident::nav
