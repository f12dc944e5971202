// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/registry.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/costmap/layer.h"

namespace trident::nav {

/// What a layer is made from.
struct LayerSetup {
  std::string name;                  ///< As users call it: "obstacle_layer".
  ConfigNode config;                 ///< A map with the keys that the layer's parameters have.
  bool is_tracking_unknown = false;  ///< The costmap begins as unknown, not as free.
  std::string source = "parameter";  ///< How errors call where the keys come from.
  std::string path;                  ///< What errors put before a key.

  LayerSetup() { config.kind = ConfigNode::Kind::kMap; }

  /// The parameters as a struct with visit(). Throws ConfigError naming source, key, value, range.
  template <class Params>
  Params params(Params result = Params{}) const {
    config_detail::ConfigReader::read_struct(config, source, path, result);
    return result;
  }
};

using LayerFactory = std::function<std::unique_ptr<Layer>(const LayerSetup& setup)>;

/// A type of layers with the names of its parameters (of nested ones the first part).
struct LayerType {
  LayerFactory make;
  std::vector<std::string> parameters;
};

/// Adds all layers that this library has, under their class names: "StaticLayer".
void register_builtin_layers(Registry<LayerType>& registry);

/// The part of a plugin's name that says which it is: "StaticLayer" of "costmap_2d::StaticLayer"
/// and of "nav2_costmap_2d/StaticLayer".
std::string plugin_class(const std::string& plugin_name);

/// Makes a layer by the name of its plugin. Throws Error that lists the known ones for an unknown
/// name, ConfigError for parameters that are not legal.
std::unique_ptr<Layer> make_layer(const Registry<LayerType>& registry,
                                  const std::string& plugin_name, const LayerSetup& setup);

namespace layer_detail {

/// The archive that lists the names of a struct's fields.
class FieldNames {
 public:
  template <class... Args>
  void field(const char* name, Args&&... /*args*/) {
    names.emplace_back(name);
  }
  template <class... Args>
  void required(const char* name, Args&&... /*args*/) {
    names.emplace_back(name);
  }
  std::vector<std::string> names;
};

template <class Params>
std::vector<std::string> field_names() {
  FieldNames archive;
  Params params;
  params.visit(archive);
  return archive.names;
}

}  // namespace layer_detail

/// Ends the source of a layer: `Type` is made from (LayerSetup) and has `Type::Params`.
#define TRIDENT_COSTMAP_LAYER(function, name, Type)                             \
  void add_##function(Registry<LayerType>& registry) {                          \
    registry.add(name, {[](const LayerSetup& setup) -> std::unique_ptr<Layer> { \
                          return std::make_unique<Type>(setup);                 \
                        },                                                      \
                        layer_detail::field_names<Type::Params>()});            \
  }

}  // namespace trident::nav
