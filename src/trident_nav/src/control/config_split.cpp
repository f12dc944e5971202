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

struct DottedKey {
  std::string head, tail;  ///< Before and after the first point.
  bool is_dotted = false;
};

DottedKey split_dotted(const std::string& key) {
  const auto cut = key.find('.');
  if (cut == std::string::npos) return {key, "", false};
  return {key.substr(0, cut), key.substr(cut + 1), true};
}

/// Whether a value that is known already leaves room for another key within it.
bool can_hold(const ConfigNode& known, const std::string& key) {
  return !key.empty() && known.find(key) == nullptr && known.kind != ConfigNode::Kind::kScalar &&
         known.kind != ConfigNode::Kind::kSequence;
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
    const DottedKey key = split_dotted(map.keys[i]);
    const int line = map.key_lines[i];
    ConfigNode* known = find_key(&result, key.head);
    if (known == nullptr) {
      put_key(&result, key.head, line, key.is_dotted ? ConfigNode{} : map.items[i]);
      if (!key.is_dotted) continue;
      known = &result.items.back();
    }
    if (!can_hold(*known, key.tail)) {
      throw ConfigError(label, line, map.keys[i],
                        "the key is given twice, with a point and as a map");
    }
    put_key(known, key.tail, line, map.items[i]);
  }
  return result;
}

}  // namespace trident::nav
