// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {

/// Name -> factory, filled by explicit `add` calls at start-up
/// (`register_builtin_plugins(registry)`); there is no static registration. Ordered by name, so
/// that iteration is the same in every run.
template <class Factory>
class Registry {
 public:
  /// `kind` says in error texts what is registered, e.g. "plugin".
  explicit Registry(std::string kind = "entry") : kind_(std::move(kind)) {}

  /// Throws Error when the name is empty or already taken.
  void add(std::string name, Factory factory) {
    if (name.empty()) throw Error("cannot register a " + kind_ + " without a name");
    const auto [it, inserted] = factories_.try_emplace(std::move(name), std::move(factory));
    if (!inserted) throw Error(kind_ + " '" + it->first + "' is registered twice");
  }

  /// nullptr when the name is unknown. The pointer stays valid while the registry lives.
  const Factory* find(std::string_view name) const {
    const auto it = factories_.find(name);
    return it == factories_.end() ? nullptr : &it->second;
  }

  /// As `find`, but an unknown name is an Error that suggests the nearest known one.
  const Factory& get(std::string_view name) const {
    if (const Factory* factory = find(name)) return *factory;
    throw Error("unknown " + kind_ + " " + unknown_name_text(name, names()));
  }

  /// Sorted.
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& [name, factory] : factories_) result.push_back(name);
    return result;
  }

 private:
  std::string kind_;
  std::map<std::string, Factory, std::less<>> factories_;
};

}  // namespace trident
