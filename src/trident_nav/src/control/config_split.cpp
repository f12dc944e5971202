// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "config_split.h"

#include <algorithm>
#include <utility>

namespace trident::nav {
namespace {

ConfigNode* find_key(ConfigNode* map, const std::string& key) {
  const auto at = std::find(map->keys.begin(), map->keys.end(), key);
  return at == map->keys.end() ? nullptr
                               : &map->items[static_cast<std::size_t>(at - map->keys.begin())];
}

}  // namespace

void put_key(ConfigNode* map, const std::string& key, int line, ConfigNode value) {
  map->kind = ConfigNode::Kind::kMap;
  map->keys.push_back(key);
  map->key_lines.push_back(line);
  map->items.push_back(std::move(value));
}

ConfigNode take_keys(ConfigNode* map, const std::vector<std::string>& names) {
  ConfigNode taken;
  ConfigNode rest;
  taken.kind = rest.kind = ConfigNode::Kind::kMap;
  taken.line = rest.line = map->line;
  for (std::size_t i = 0; i < map->keys.size(); ++i) {
    const bool is_named = std::find(names.begin(), names.end(), map->keys[i]) != names.end();
    put_key(is_named ? &taken : &rest, map->keys[i], map->key_lines[i], std::move(map->items[i]));
  }
  *map = std::move(rest);
  return taken;
}

ConfigNode expand_dotted_keys(const ConfigNode& map, const std::string& label) {
  ConfigNode result;
  result.kind = ConfigNode::Kind::kMap;
  result.line = map.line;
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const std::string& key = map.keys[i];
    const int line = map.key_lines[i];
    const auto cut = key.find('.');
    const std::string head = key.substr(0, cut);
    ConfigNode* known = find_key(&result, head);
    if (known == nullptr) {
      put_key(&result, head, line, {});
      known = &result.items.back();
      *known = cut == std::string::npos ? map.items[i] : ConfigNode{};
      if (cut == std::string::npos) continue;
    }
    const std::string tail = cut == std::string::npos ? "" : key.substr(cut + 1);
    if (tail.empty() || known->find(tail) != nullptr || known->kind == ConfigNode::Kind::kScalar ||
        known->kind == ConfigNode::Kind::kSequence) {
      throw ConfigError(label, line, key, "the key is given twice, with a point and as a map");
    }
    put_key(known, tail, line, map.items[i]);
  }
  return result;
}

}  // namespace trident::nav
