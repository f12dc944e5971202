// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "trident_base/config_fields.h"
#include "trident_base/registry.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/costmap/layer.h"

namespace trident::nav {

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

/// The archive that turns 1 and 0 into true and false where a struct has a flag: roslaunch and
/// rosparam write both.
class FlagReader {
 public:
  explicit FlagReader(ConfigNode& map) : map_(map) {}
  template <class T, class... Args>
  void field(const char* name, const T& value, Args&&... /*args*/) {
    for (std::size_t i = 0; i < map_.keys.size(); ++i) {
      if (map_.keys[i] == name) read(map_.items[i], value);
    }
  }
  template <class T, class... Args>
  void required(const char* name, const T& value, Args&&... /*args*/) {
    field(name, value);
  }

 private:
  static void read(ConfigNode& node, bool /*flag*/) {
    if (node.kind != ConfigNode::Kind::kScalar || node.quoted) return;
    if (node.scalar == "1") node.scalar = "true";
    if (node.scalar == "0") node.scalar = "false";
  }
  static void read(ConfigNode& node, const std::optional<bool>& /*flag*/) { read(node, false); }
  template <class T>
  static void read(ConfigNode& node, const std::map<std::string, T>& /*value*/) {
    for (ConfigNode& item : node.items) {
      FlagReader below(item);
      T value{};
      value.visit(below);
    }
  }
  template <class T>
  static void read(ConfigNode& /*node*/, const T& /*value*/) {}

  ConfigNode& map_;
};

template <class Params>
std::vector<std::string> field_names() {
  FieldNames archive;
  Params params;
  params.visit(archive);
  return archive.names;
}

}  // namespace layer_detail

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
  Params params() const {
    Params result{};
    ConfigNode own = config;
    layer_detail::FlagReader flags(own);
    result.visit(flags);
    config_detail::ConfigReader::read_struct(own, source, path, result);
    return result;
  }
};

using LayerFactory = std::function<std::unique_ptr<Layer>(const LayerSetup& setup)>;

/// A type of layers with the names of its parameters (of nested ones the first part), and those
/// that may be changed while a costmap runs.
struct LayerType {
  LayerFactory make;
  std::vector<std::string> parameters;
  std::vector<ConfigField> live_fields;
  /// Gives a layer of this type the parameters of a setup. Throws ConfigError, and changes nothing.
  std::function<void(Layer& layer, const LayerSetup& setup)> change;
};

namespace layer_detail {

template <class Type, class = void>
struct FixedKeys {
  static bool contains(const std::string& /*name*/) { return false; }
};
template <class Type>
struct FixedKeys<Type, std::void_t<decltype(Type::kFixedKeys)>> {
  static bool contains(const std::string& name) {
    return std::find(std::begin(Type::kFixedKeys), std::end(Type::kFixedKeys), name) !=
           std::end(Type::kFixedKeys);
  }
};

template <class Type>
LayerType layer_type() {
  LayerType type;
  type.make = [](const LayerSetup& setup) { return std::make_unique<Type>(setup); };
  type.parameters = field_names<typename Type::Params>();
  for (ConfigField& field : config_fields<typename Type::Params>()) {
    if (!FixedKeys<Type>::contains(field.name)) type.live_fields.push_back(std::move(field));
  }
  type.change = [](Layer& layer, const LayerSetup& setup) {
    dynamic_cast<Type&>(layer).set_params(setup.params<typename Type::Params>());
  };
  return type;
}

}  // namespace layer_detail

/// Adds all layers that this library has, under their class names: "StaticLayer".
void register_builtin_layers(Registry<LayerType>& registry);

/// The part of a plugin's name that says which it is: "StaticLayer" of "costmap_2d::StaticLayer"
/// and of "nav2_costmap_2d/StaticLayer".
std::string plugin_class(const std::string& plugin_name);

/// Makes a layer by the name of its plugin. Throws Error that lists the known ones for an unknown
/// name, ConfigError for parameters that are not legal.
std::unique_ptr<Layer> make_layer(const Registry<LayerType>& registry,
                                  const std::string& plugin_name, const LayerSetup& setup);

/// Ends the source of a layer: `Type` is made from (LayerSetup) and has `Type::Params` and
/// `set_params`; if it has `Type::kFixedKeys`, an array of names, those are read at the start
/// alone.
#define TRIDENT_COSTMAP_LAYER(function, name, Type)       \
  void add_##function(Registry<LayerType>& registry) {    \
    registry.add(name, layer_detail::layer_type<Type>()); \
  }

}  // namespace trident::nav
