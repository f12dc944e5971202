// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/plugin_registry.h"

#include <dlfcn.h>

#include "trident_base/error.h"

namespace trident {

std::string PluginRegistry::key(const std::string& filename) {
  std::string name = filename.substr(filename.rfind('/') + 1);
  if (name.rfind("lib", 0) == 0) name = name.substr(3);
  if (name.size() > 3 && name.substr(name.size() - 3) == ".so") name.resize(name.size() - 3);
  return name;
}

void PluginRegistry::add(const std::string& filename, PluginFactory factory) {
  if (!factories_.emplace(key(filename), std::move(factory)).second) {
    throw Error("plugin '" + filename + "' is registered twice");
  }
}

const PluginFactory* PluginRegistry::find(const std::string& filename) const {
  const auto it = factories_.find(key(filename));
  return it == factories_.end() ? nullptr : &it->second;
}

std::vector<std::string> PluginRegistry::names() const {
  std::vector<std::string> result;
  for (const auto& [name, factory] : factories_) result.push_back(name);
  return result;
}

void PluginRegistry::load_shared_object(const std::string& path) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw Error("plugin library '" + path + "' cannot be loaded: " + dlerror());
  using Register = void (*)(PluginRegistry&);
  auto* function = reinterpret_cast<Register>(dlsym(library, "trident_register_plugins"));
  if (function == nullptr) {
    throw Error("plugin library '" + path + "' does not export trident_register_plugins");
  }
  function(*this);  // the library stays loaded: its factories live in the registry
}

}  // namespace trident
