// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "trident_sim/model_spec.h"
#include "trident_sim/plugin.h"
#include "trident_sim/resources.h"

namespace trident::sim {

/// How a plugin is made from its SDF element.
struct PluginFactory {
  std::function<std::unique_ptr<Plugin>(const PluginContext&)> create;
  /// Name of the joint whose child this plugin spins as a rotor (see Model), or "".
  std::function<std::string(const PluginParams&)> spun_joint;
};

/// Plugin file name -> factory, filled by explicit calls only. Lookup ignores folders, a leading
/// "lib" and a trailing ".so", so "librotors_gazebo_motor_model.so" and "rotors_gazebo_motor_model"
/// are one name.
class PluginRegistry {
 public:
  void add(const std::string& filename, PluginFactory factory);
  const PluginFactory* find(const std::string& filename) const;
  std::vector<std::string> names() const;

  /// find(), and for a name that is not there yet the shared object of that name, from the plugin
  /// folders of `resources` or the loader's own path, if it is one of ours (see
  /// load_shared_object).
  const PluginFactory* find_or_load(const std::string& filename, const Resources& resources);

  /// Loads a shared object that exports `extern "C" void
  /// trident_register_plugins(PluginRegistry&)`. Throws Error when it cannot be loaded or does not.
  void load_shared_object(const std::string& path);

 private:
  static std::string key(const std::string& filename);
  std::map<std::string, PluginFactory> factories_;
};

/// Everything that ships with the simulator, under the names RotorS and gazebo_ros use.
void register_builtin_plugins(PluginRegistry& registry);

}  // namespace trident::sim
