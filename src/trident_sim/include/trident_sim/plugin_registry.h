// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trident_sim/model_spec.h"
#include "trident_sim/plugin.h"
#include "trident_sim/resources.h"

namespace trident::sim {

/// What the conformance suite runs a plugin with, on a quadrotor with the links base_link and
/// rotor_0 to rotor_3 and the joints rotor_0_joint to rotor_3_joint.
struct PluginExample {
  std::string elements;  ///< SDF within `<plugin>`: valid, complete, without children
  std::vector<std::string>
      required;                      ///< without one of these elements the plugin throws, naming it
  std::vector<std::string> numbers;  ///< these throw for what is not a finite number
  /// Of a sensor's plugin: the `<sensor>` that it belongs to, without its `<plugin>`; else "".
  std::string sensor = "";
};

/// How a plugin is made from its SDF element.
struct PluginFactory {
  /// Throws Error for bad parameters. May return nullptr: then the element has no effect.
  std::function<std::unique_ptr<Plugin>(const PluginContext&)> create;
  /// Name of the joint whose child this plugin spins as a rotor (see Model), or "".
  std::function<std::string(const PluginParams&)> rotor_joint;
  /// Of a plugin that the conformance suite runs.
  std::optional<PluginExample> example = std::nullopt;
};

/// Factory of a plugin class that is constructed from its context alone.
template <class PluginClass>
PluginFactory factory_of(std::function<std::string(const PluginParams&)> rotor_joint = {}) {
  return {[](const PluginContext& context) { return std::make_unique<PluginClass>(context); },
          std::move(rotor_joint)};
}

/// Plugin file name -> factory. Lookup ignores folders, a leading
/// "lib" and a trailing ".so", so "librotors_gazebo_motor_model.so" and "rotors_gazebo_motor_model"
/// are one name.
class PluginRegistry {
 public:
  /// The one name of all forms of a file name: without folder, "lib" and ".so".
  static std::string key(const std::string& filename);
  /// Throws Error when the name is taken.
  void add(const std::string& filename, PluginFactory factory);
  /// nullptr when it is not registered. Valid as long as the registry: nothing is ever removed.
  const PluginFactory* find(const std::string& filename) const;
  /// In alphabetical order, without folder, "lib" and ".so".
  std::vector<std::string> names() const;

  /// find(), and for a name that is not there yet the shared object of that name, from the plugin
  /// folders of `resources` or the loader's own path, if it is one of ours (see
  /// load_shared_object).
  const PluginFactory* find_or_load(const std::string& filename, const Resources& resources);

  /// Loads a shared object that exports `extern "C" void
  /// trident_register_plugins(PluginRegistry&)`. Throws Error when it cannot be loaded or does not.
  void load_shared_object(const std::string& path);

 private:
  std::map<std::string, PluginFactory> factories_;
};

/// At namespace scope in a plugin's .cpp, makes it one of those that ship with the simulator. The
/// order in which registrars run does not matter.
class PluginRegistrar {
 public:
  /// Only notes the factory: a name that is taken shows in register_builtin_plugins().
  PluginRegistrar(const char* filename, PluginFactory factory);
  /// The same with what the conformance suite runs the plugin with.
  PluginRegistrar(const char* filename, PluginFactory factory, PluginExample example);
};

/// Adds everything that ships with the simulator, under the names RotorS and gazebo_ros use.
void register_builtin_plugins(PluginRegistry& registry);

}  // namespace trident::sim
