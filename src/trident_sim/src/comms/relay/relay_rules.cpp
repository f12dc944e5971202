// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/relay/relay_rules.h"

#include <algorithm>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

using Kind = ConfigNode::Kind;

/// `from: all` is a list of one name.
void make_list(ConfigNode* rule, const std::string& key) {
  for (std::size_t i = 0; i < rule->keys.size(); ++i) {
    ConfigNode& value = rule->items[i];
    if (rule->keys[i] != key || value.kind != Kind::kScalar) continue;
    ConfigNode list;
    list.kind = Kind::kSequence;
    list.line = value.line;
    list.items.push_back(std::move(value));
    value = std::move(list);
  }
}

void make_lists(ConfigNode* file) {
  for (std::size_t i = 0; i < file->keys.size(); ++i) {
    if (file->keys[i] != "rules") continue;
    for (ConfigNode& rule : file->items[i].items) {
      make_list(&rule, "from");
      make_list(&rule, "to");
    }
  }
}

void check_names(const char* key, const std::vector<std::string>& names) {
  const bool is_all = std::find(names.begin(), names.end(), Radio::kAll) != names.end();
  const bool is_empty = std::find(names.begin(), names.end(), "") != names.end();
  if (!names.empty() && !is_empty && (!is_all || names.size() == 1)) return;
  throw Error(std::string(key) + " is '" + join(names) + "', legal: names of robots, or all alone");
}

bool overlap(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  if (a.front() == Radio::kAll || b.front() == Radio::kAll) return true;
  return std::any_of(a.begin(), a.end(), [&b](const std::string& name) {
    return std::find(b.begin(), b.end(), name) != b.end();
  });
}

}  // namespace

bool RelayRule::includes(const std::vector<std::string>& names, const std::string& robot) {
  if (names.front() == Radio::kAll) return true;
  return std::find(names.begin(), names.end(), robot) != names.end();
}

std::string RelayRule::text(std::size_t index) const {
  return "rule " + std::to_string(index + 1) + " (" + name() + ")";
}

void RelayRule::validate() const {
  check_names("from", from);
  check_names("to", to);
  const std::string what = is_service() ? "service" : "topic";
  if (name().empty() || name().front() == '/' || name().back() == '/') {
    throw Error(what + " is '" + name() + "', legal: a name without outer slashes");
  }
  // A to B to A would never come to its end.
  const std::string by_radio = is_service() ? "to/" : "from/";
  if (starts_with(name(), by_radio)) {
    throw Error(what + " is '" + name() + "', which a robot has by radio; legal: one of its own");
  }
  if (is_service() && delay_s >= deadline_s) {
    throw Error("delay is " + number_text(delay_s) + ", legal: less than deadline, " +
                number_text(deadline_s));
  }
}

void RelayFile::validate() const {
  for (std::size_t i = 0; i < rules.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const RelayRule &a = rules[j], &b = rules[i];
      const bool is_one = a.topic == b.topic && a.service == b.service;
      if (!is_one || !overlap(a.from, b.from) || !overlap(a.to, b.to)) continue;
      throw Error(a.text(j) + " and " + b.text(i) + " relay one " +
                  (a.is_service() ? "service" : "topic") +
                  " between the same robots, legal: one rule");
    }
  }
}

RelayFile parse_relay_file(const std::string& text, const std::string& file_label) {
  ConfigNode node = parse_yaml(text, file_label);
  make_lists(&node);
  return load_config_node<RelayFile>(node, file_label);
}

RelayFile load_relay_file(const std::string& path) {
  return parse_relay_file(read_config_file(path), path);
}

}  // namespace trident::sim
