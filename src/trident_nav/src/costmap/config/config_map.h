// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// What a configuration's translation does to maps.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "trident_base/config_node.h"

namespace trident::nav {

inline ConfigNode empty_map() {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kMap;
  return node;
}

inline ConfigNode text_node(const std::string& text, bool quoted, int line = 0) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kScalar;
  node.scalar = text;
  node.quoted = quoted;
  node.line = line;
  return node;
}

/// Sets a key of a map, or replaces it.
inline void set_key(ConfigNode& map, const std::string& key, ConfigNode value) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i] != key) continue;
    map.items[i] = std::move(value);
    return;
  }
  map.keys.push_back(key);
  map.key_lines.push_back(value.line);
  map.items.push_back(std::move(value));
}

/// Removes a key from a map; nothing when it has none.
inline std::optional<ConfigNode> take_key(ConfigNode& map, const std::string& key) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i] != key) continue;
    const auto offset = static_cast<std::ptrdiff_t>(i);
    ConfigNode value = std::move(map.items[i]);
    map.keys.erase(map.keys.begin() + offset);
    map.items.erase(map.items.begin() + offset);
    if (i < map.key_lines.size()) map.key_lines.erase(map.key_lines.begin() + offset);
    return value;
  }
  return std::nullopt;
}

/// Moves a key to another map, unless that has it.
inline void move_key(ConfigNode& from, ConfigNode& to, const std::string& key) {
  std::optional<ConfigNode> value = take_key(from, key);
  if (value && to.find(key) == nullptr) set_key(to, key, std::move(*value));
}

/// True for a scalar that says so.
inline bool is_true(const ConfigNode* node) {
  return node != nullptr && node->kind == ConfigNode::Kind::kScalar &&
         (node->scalar == "true" || node->scalar == "True" || node->scalar == "1");
}

}  // namespace trident::nav
