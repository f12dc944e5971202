// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/plugin_registry.h"

#include <dlfcn.h>

#include <utility>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr char kRegisterSymbol[] = "trident_register_plugins";

/// Our own library's symbols are made visible first: in Python it was loaded for its module alone,
/// and a plugin need not have been linked to it.
void* open_now(const std::string& path) {
  Dl_info self{};
  if (dladdr(kRegisterSymbol, &self) != 0) {
    dlopen(self.dli_fname, RTLD_LAZY | RTLD_GLOBAL | RTLD_NOLOAD);
  }
  return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
}

/// One that lacks a symbol can be ours, too: opening it lazily shows that.
bool is_ours(const std::string& path) {
  void* library = open_now(path);
  if (library == nullptr) library = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) return false;
  const bool exports = dlsym(library, kRegisterSymbol) != nullptr;
  dlclose(library);
  return exports;
}

/// Of the registrars that have run. Made by the first of them, whichever that is.
std::vector<std::pair<const char*, PluginFactory>>& builtin_plugins() {
  static std::vector<std::pair<const char*, PluginFactory>> plugins;
  return plugins;
}

}  // namespace

PluginRegistrar::PluginRegistrar(const char* filename, PluginFactory factory) {
  builtin_plugins().emplace_back(filename, std::move(factory));
}

PluginRegistrar::PluginRegistrar(const char* filename, PluginFactory factory,
                                 PluginExample example) {
  factory.example = std::move(example);
  builtin_plugins().emplace_back(filename, std::move(factory));
}

void register_builtin_plugins(PluginRegistry& registry) {
  for (const auto& [filename, factory] : builtin_plugins()) registry.add(filename, factory);
}

std::string PluginRegistry::key(const std::string& filename) {
  std::string name = filename.substr(filename.rfind('/') + 1);
  if (name.rfind("lib", 0) == 0) name = name.substr(3);
  if (name.size() > 3 && name.substr(name.size() - 3) == ".so") name.resize(name.size() - 3);
  return name;
}

/// Under the name without folder, "lib" and ".so": all forms of a file name are one plugin.
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

/// Known names first: a file on the path cannot replace a plugin that ships with the simulator.
const PluginFactory* PluginRegistry::find_or_load(const std::string& filename,
                                                  const Resources& resources) {
  if (const PluginFactory* known = find(filename)) return known;
  const std::string file = "lib" + key(filename) + ".so";
  std::vector<std::string> paths = resources.plugin_folders();
  for (std::string& path : paths) path.append("/").append(file);
  paths.push_back(file);
  for (const std::string& path : paths) {
    if (!is_ours(path)) continue;
    load_shared_object(path);
    if (const PluginFactory* found = find(filename)) return found;
  }
  return nullptr;
}

/// All symbols are resolved at once, so that one that is missing fails the load and not the run.
/// All symbols are resolved at once, so that one that is missing fails the load and not the run.
void PluginRegistry::load_shared_object(const std::string& path) {
  void* library = open_now(path);
  if (library == nullptr)
    throw Error("plugin library '" + path + "' cannot be loaded: " + dlerror());
  using Register = void (*)(PluginRegistry&);
  auto* function = reinterpret_cast<Register>(dlsym(library, kRegisterSymbol));
  if (function == nullptr) {
    throw Error("plugin library '" + path + "' does not export " + kRegisterSymbol);
  }
  function(*this);  // the library stays loaded: its factories live in the registry
}

}  // namespace trident::sim
