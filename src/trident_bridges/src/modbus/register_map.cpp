// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/register_map.h"

#include <algorithm>
#include <set>
#include <utility>

#include "map_checks.h"
#include "trident_base/yaml_config.h"

namespace trident::bridges::modbus {
namespace {

/// A file that is being read.
struct Reading {
  RegisterMap map;
  std::vector<ConfigError> errors;
};

/// Removes a key, and returns its value.
ConfigNode take(ConfigNode& node, const std::string& key) {
  const auto at = std::find(node.keys.begin(), node.keys.end(), key);
  if (at == node.keys.end()) return {};
  const auto index = at - node.keys.begin();
  ConfigNode value = std::move(node.items[static_cast<std::size_t>(index)]);
  node.keys.erase(at);
  node.items.erase(node.items.begin() + index);
  node.key_lines.erase(node.key_lines.begin() + index);
  return value;
}

void read_entry(Reading& reading, const ConfigNode& item, std::size_t index) {
  const EntrySource source{reading.map.file, item, "registers[" + std::to_string(index) + "]"};
  RegisterSpec spec;
  try {
    config_detail::ConfigReader::read_struct(item, source.file, source.path, spec);
    reading.map.entries.push_back(make_entry(spec, reading.map.spec, source));
  } catch (const ConfigError& error) {
    reading.errors.push_back(error);
  }
}

void check_names(Reading& reading) {
  std::set<std::string> names;
  for (const RegisterEntry& entry : reading.map.entries) {
    if (names.insert(entry.name).second) continue;
    reading.errors.emplace_back(reading.map.file, entry.line, "registers",
                                "name '" + entry.name + "' is used twice");
  }
}

std::vector<const RegisterEntry*> by_address(const RegisterMap& map) {
  std::vector<const RegisterEntry*> sorted;
  for (const RegisterEntry& entry : map.entries) sorted.push_back(&entry);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) {
    return std::make_pair(a->table, a->address) < std::make_pair(b->table, b->address);
  });
  return sorted;
}

/// At the later one of two lines.
void report_overlap(const RegisterEntry& a, const RegisterEntry& b, Reading& reading) {
  const auto [first, second] =
      std::minmax(a, b, [](const auto& one, const auto& other) { return one.line < other.line; });
  reading.errors.emplace_back(reading.map.file, second.line, "registers",
                              second.label() + " takes " + address_text(second) + ", of which " +
                                  first.label() + " of line " + std::to_string(first.line) +
                                  " has " + address_text(first));
}

void check_overlaps(Reading& reading) {
  const RegisterEntry* before = nullptr;
  for (const RegisterEntry* entry : by_address(reading.map)) {
    if (before == nullptr || before->table != entry->table) {
      before = entry;
      continue;
    }
    if (before->end() > entry->address) report_overlap(*before, *entry, reading);
    if (entry->end() > before->end()) before = entry;
  }
}

Reading read_map(const std::string& text, const std::string& file_label) {
  Reading reading;
  reading.map.file = file_label;
  try {
    ConfigNode node = parse_yaml(text, file_label);
    const ConfigNode registers = take(node, "registers");
    reading.map.spec = load_config_node<MapSpec>(node, file_label);
    if (registers.kind != ConfigNode::Kind::kSequence || registers.items.empty()) {
      throw ConfigError(file_label, std::max(registers.line, node.line), "registers",
                        registers.describe() + "; a list of registers is required");
    }
    for (std::size_t i = 0; i < registers.items.size(); ++i) {
      read_entry(reading, registers.items[i], i);
    }
    check_names(reading);
    check_overlaps(reading);
  } catch (const ConfigError& error) {
    reading.errors.push_back(error);
  }
  std::stable_sort(reading.errors.begin(), reading.errors.end(),
                   [](const auto& a, const auto& b) { return a.line() < b.line(); });
  return reading;
}

}  // namespace

std::string RegisterEntry::label() const {
  return "'" + name + "' (" + table_text(table) + " " + std::to_string(address) + ")";
}

void read_value(const RegisterEntry& entry, Bytes wire, Value& value) {
  if (entry.is_bit()) {
    value.text.clear();
    value.numbers.clear();
    for (const std::uint8_t bit : wire) value.numbers.emplace_back(std::uint64_t{bit});
    return;
  }
  read_raw(entry.layout, wire, value);
  if (entry.is_unscaled()) return;
  for (Number& number : value.numbers) number = as_double(number) * entry.scale + entry.offset;
}

Fit write_value(const RegisterEntry& entry, const Value& value, Span<std::uint8_t> wire) {
  if (entry.is_bit()) {
    for (std::size_t i = 0; i < std::min(wire.size(), value.numbers.size()); ++i) {
      wire[i] = as_double(value.numbers[i]) != 0.0 ? 1 : 0;
    }
    return Fit::kExact;
  }
  if (entry.is_unscaled()) return write_raw(entry.layout, value, wire);
  Value raw;
  for (const Number& number : value.numbers) {
    raw.numbers.emplace_back((as_double(number) - entry.offset) / entry.scale);
  }
  return write_raw(entry.layout, raw, wire);
}

std::optional<std::size_t> RegisterMap::find(const std::string& name) const {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].name == name) return i;
  }
  return std::nullopt;
}

RegisterMap load_register_map(const std::string& path) {
  return parse_register_map(read_config_file(path), path);
}

RegisterMap parse_register_map(const std::string& text, const std::string& file_label) {
  Reading reading = read_map(text, file_label);
  if (!reading.errors.empty()) throw reading.errors.front();
  return std::move(reading.map);
}

std::vector<ConfigError> errors_of_map(const std::string& text, const std::string& file_label) {
  return read_map(text, file_label).errors;
}

}  // namespace trident::bridges::modbus
