// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_base/config_node.h"

namespace trident::nav {

/// The archive that collects the names of a struct's keys.
struct KeyCollector {
  std::vector<std::string> names;

  template <class... Rest>
  void field(const char* name, Rest&&... /*rest*/) {
    names.emplace_back(name);
  }
};

template <class T>
std::vector<std::string> key_names() {
  KeyCollector collector;
  T value{};
  value.visit(collector);
  return collector.names;
}

/// An entry of a map node, which keeps its line.
void put_key(ConfigNode* map, const std::string& key, int line, ConfigNode value);

/// Takes out of a map the entries of these names.
ConfigNode take_keys(ConfigNode* map, const std::vector<std::string>& names);

/// The map with keys such as "PathDist.scale", the form of ROS 2 files, as entries of maps; keys
/// without a point stay where they are. Throws ConfigError where a key is given in both forms.
ConfigNode expand_dotted_keys(const ConfigNode& map, const std::string& label);

}  // namespace trident::nav
