// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/plugin_registry.h"

#include <dlfcn.h>

#include <cstdlib>
#include <sstream>

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

const PluginFactory* PluginRegistry::find_or_load(const std::string& filename) {
  if (const PluginFactory* known = find(filename)) return known;
  const std::string file = "lib" + key(filename) + ".so";
  std::vector<std::string> paths;
  if (const char* list = std::getenv("GAZEBO_PLUGIN_PATH")) {
    std::istringstream folders(list);
    for (std::string folder; std::getline(folders, folder, ':');) {
      if (!folder.empty()) paths.push_back(folder.append("/").append(file));
    }
  }
  paths.push_back(file);
  for (const std::string& path : paths) {
    void* library = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) continue;
    const bool is_ours = dlsym(library, "trident_register_plugins") != nullptr;
    if (is_ours) load_shared_object(path);
    dlclose(library);
    if (const PluginFactory* found = find(filename)) return found;
  }
  return nullptr;
}

void PluginRegistry::load_shared_object(const std::string& path) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw Error("plugin library '" + path + "' cannot be loaded: " + dlerror());
  using Register = void (*)(PluginRegistry&);
  auto* function = reinterpret_cast<Register>(dlsym(library, "trident_register_plugins"));
  if (function == nullptr) {
    throw Error("plugin library '" + path + "' does not export trident_register_plugins");
  }
  function(*this);  // the library stays loaded: its factories live in the registry
}

}  // namespace trident
