// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// The registry of SLAM methods. A new method is a header, a source that ends with
/// TRIDENT_SLAM_2D_METHOD, and a line in the list of methods of CMakeLists.txt.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "trident_base/registry.h"
#include "trident_base/yaml_config.h"
#include "trident_slam/pose_graph_optimizer.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {

/// What a method is made from, whether it comes from a YAML file or from the parameters of a node.
struct Slam2dSetup {
  /// An empty map: every parameter has its default.
  Slam2dSetup() { config.kind = ConfigNode::Kind::kMap; }
  /// The keys of a YAML file; those of Slam2dSetup() when the path is empty. Throws ConfigError for
  /// text that is not YAML.
  explicit Slam2dSetup(const std::string& config_file);

  /// Sets a key of the configuration to the text of a number, a choice or a truth value.
  void set(const std::string& key, const std::string& text);
  /// Sets a key that has no value yet.
  void set_default(const std::string& key, const std::string& text) {
    if (config.find(key) == nullptr) set(key, text);
  }
  /// The parameters as a struct with visit(). Throws ConfigError naming source, key, value and
  /// range.
  template <class Params>
  Params params() const {
    Params result{};
    config_detail::ConfigReader::read_struct(config, source, path, result);
    return result;
  }

  ConfigNode config;            ///< A map.
  std::string source;           ///< How errors call where it comes from: a file, "parameter".
  std::string path;             ///< What errors put before a key: "", or the name of a node.
  PoseGraphSolverMaker solver;  ///< Optimizes pose graphs; empty: the method's own does.
};

/// One method of the registry.
struct Slam2dFactory {
  /// Throws Error naming source, key, value and range.
  std::function<std::unique_ptr<Slam2d>(const Slam2dSetup& setup)> make;
  std::vector<std::string> parameters;  ///< Keys of its configuration.
  bool maps_without_odometry = false;   ///< It is a Slam2dOdometryUse.
  bool has_sessions = false;            ///< It is a Slam2dSession.

  /// The algorithm, see `make`.
  std::unique_ptr<Slam2d> operator()(const Slam2dSetup& setup) const { return make(setup); }
};

namespace factory_detail {

/// An archive that lists the names of a struct's fields.
struct FieldNames {
  std::vector<std::string> names;  ///< in the order of visit()
  /// Takes the name alone, whatever follows it.
  template <class... Rest>
  void field(const char* name, const Rest&... /*rest*/) {
    names.emplace_back(name);
  }
  /// As field().
  template <class... Rest>
  void required(const char* name, const Rest&... /*rest*/) {
    names.emplace_back(name);
  }
};

}  // namespace factory_detail

/// The factory of a method that is made from its parameters alone, or from these and a solver of
/// pose graphs.
template <class Method, class Params>
Slam2dFactory slam_2d_factory() {
  Slam2dFactory factory;
  factory.make = [](const Slam2dSetup& setup) -> std::unique_ptr<Slam2d> {
    if constexpr (std::is_constructible_v<Method, Params, PoseGraphSolverMaker>) {
      return std::make_unique<Method>(setup.params<Params>(), setup.solver);
    } else {
      return std::make_unique<Method>(setup.params<Params>());
    }
  };
  factory_detail::FieldNames archive;
  Params defaults{};
  defaults.visit(archive);
  factory.parameters = std::move(archive.names);
  factory.maps_without_odometry = std::is_base_of_v<Slam2dOdometryUse, Method>;
  factory.has_sessions = std::is_base_of_v<Slam2dSession, Method>;
  return factory;
}

/// Registers a method. Stands in namespace trident::slam of its source, which CMakeLists.txt lists;
/// `file` is the name of that source without its ending.
#define TRIDENT_SLAM_2D_METHOD(file, name, Method, Params) \
  void add_##file(Registry<Slam2dFactory>& registry);      \
  void add_##file(Registry<Slam2dFactory>& registry) {     \
    registry.add(name, slam_2d_factory<Method, Params>()); \
  }

/// Adds the methods of this package; `Registry::names` lists their names, docs/howto/slam.md
/// describes each.
void register_builtin_slam_2d(Registry<Slam2dFactory>& registry);
/// A registry with the methods of this package.
Registry<Slam2dFactory> builtin_slam_2d();

}  // namespace trident::slam
