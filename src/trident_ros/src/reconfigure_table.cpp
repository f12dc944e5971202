// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/reconfigure_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "trident_base/string_util.h"

namespace trident::ros_utils {
namespace {

using dynamic_reconfigure::Config;
using Kind = ConfigField::Kind;

const char* const kRestore = "restore_defaults";
const char* const kGroup = "Default";

ConfigNode empty_map() {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kMap;
  return node;
}

ConfigNode scalar_node(const std::string& text, bool is_quoted) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kScalar;
  node.scalar = text;
  node.quoted = is_quoted;
  return node;
}

/// The place of a key; one past the end where the map does not have it.
std::size_t index_of(const ConfigNode& map, const std::string& key) {
  return static_cast<std::size_t>(std::find(map.keys.begin(), map.keys.end(), key) -
                                  map.keys.begin());
}

/// The value of a name with slashes; nullptr where the map does not have it.
const ConfigNode* find_value(const ConfigNode& map, const std::string& name) {
  const std::size_t slash = name.find('/');
  const ConfigNode* const value = map.find(name.substr(0, slash));
  if (slash == std::string::npos || value == nullptr) return value;
  return find_value(*value, name.substr(slash + 1));
}

void set_value(ConfigNode* map, const std::string& name, ConfigNode value) {
  const std::size_t slash = name.find('/');
  const std::string key = name.substr(0, slash);
  const std::size_t at = index_of(*map, key);
  if (at == map->keys.size()) {
    map->keys.push_back(key);
    map->key_lines.push_back(0);
    map->items.push_back(empty_map());
  }
  ConfigNode& item = map->items[at];
  if (slash == std::string::npos) {
    item = std::move(value);
  } else {
    if (item.kind != ConfigNode::Kind::kMap) item = empty_map();
    set_value(&item, name.substr(slash + 1), std::move(value));
  }
}

void erase_value(ConfigNode* map, const std::string& name) {
  const std::size_t slash = name.find('/');
  const std::size_t at = index_of(*map, name.substr(0, slash));
  if (at == map->keys.size()) return;
  if (slash != std::string::npos) {
    erase_value(&map->items[at], name.substr(slash + 1));
    return;
  }
  const auto offset = static_cast<std::ptrdiff_t>(at);
  map->keys.erase(map->keys.begin() + offset);
  map->key_lines.erase(map->key_lines.begin() + offset);
  map->items.erase(map->items.begin() + offset);
}

double number_of(const std::string& text) {
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::strtod(text.c_str(), nullptr);
}

bool is_true(const std::string& text) {
  return text == "true" || text == "True" || text == "TRUE" || text == "1";
}

bool is_whole_number(const std::string& text) {
  char* end = nullptr;
  std::strtol(text.c_str(), &end, 10);
  return !text.empty() && *end == '\0';
}

/// A flag as the text of a parameter.
const char* flag_text(bool flag) { return flag ? "true" : "false"; }

bool wants_first_values(const Config& request) {
  return std::any_of(request.bools.begin(), request.bools.end(), [](const auto& flag) {
    return flag.name == kRestore && static_cast<bool>(flag.value);
  });
}

template <class Parameter, class Value>
Parameter named(const std::string& name, const Value& value) {
  Parameter result;
  result.name = name;
  result.value = value;
  return result;
}

std::int32_t whole(double value) {
  using Limits = std::numeric_limits<std::int32_t>;
  const double lo = Limits::min(), hi = Limits::max();
  return static_cast<std::int32_t>(std::isnan(value) ? 0.0 : std::clamp(value, lo, hi));
}

dynamic_reconfigure::GroupState default_group() {
  dynamic_reconfigure::GroupState group;
  group.name = kGroup;
  group.state = static_cast<std::uint8_t>(true);
  return group;
}

/// A choice as rqt_reconfigure evaluates it: a Python dictionary.
std::string edit_method(const ConfigField& field, bool are_numbers) {
  if (field.kind != Kind::kChoice) return "";
  std::vector<std::string> items;
  for (const std::string& name : field.choices) {
    const std::string quoted = "'" + name + "'";
    items.push_back("{'name': " + quoted + ", 'value': " + (are_numbers ? name : quoted) +
                    ", 'type': " + (are_numbers ? "'int'" : "'str'") + ", 'description': ''}");
  }
  return "{'enum_description': '', 'enum': [" + join(items) + "]}";
}

const char* type_name(const ConfigField& field, bool is_whole) {
  if (field.kind == Kind::kBool) return "bool";
  if (is_whole) return "int";
  return field.kind == Kind::kNumber ? "double" : "str";
}

dynamic_reconfigure::ParamDescription described(const ConfigField& field, bool is_whole,
                                                bool is_number_of_choice) {
  dynamic_reconfigure::ParamDescription result;
  result.name = field.name;
  result.type = type_name(field, is_whole);
  result.description = field.doc;
  result.edit_method = edit_method(field, is_number_of_choice);
  return result;
}

/// The value or the end of the range next to it, with a note; an end that is not legal itself is no
/// value to fall back on.
double nearest_legal(const ConfigField& field, double value, std::vector<std::string>* notes) {
  const double legal = std::clamp(value, field.range.lo, field.range.hi);
  if (legal == value || !field.range.contains(legal)) return value;
  notes->push_back(field.name + " = " + number_text(value) + " has become " + number_text(legal) +
                   ", legal: " + field.range.text());
  return legal;
}

}  // namespace

ReconfigureTable::ReconfigureTable(const std::vector<ConfigField>& fields, ConfigNode values)
    : first_(values), values_(std::move(values)) {
  for (const ConfigField& field : fields) {
    const bool is_shown = !field.is_optional || field.kind == Kind::kNumber ||
                          find_value(values_, field.name) != nullptr;
    if (is_shown) entries_.push_back(entry_of(field));
  }
  ConfigField restore;
  restore.name = kRestore;
  restore.kind = Kind::kBool;
  restore.default_text = "false";
  restore.doc = "true: all parameters get the values that they had at first";
  entries_.push_back(entry_of(restore));
}

ReconfigureTable::Entry ReconfigureTable::entry_of(const ConfigField& field) {
  Entry entry{field, false, field.range.lo, field.range.hi};
  if (field.kind == Kind::kChoice) {
    entry.is_number_of_choice =
        std::all_of(field.choices.begin(), field.choices.end(), is_whole_number);
  }
  return entry;
}

const ReconfigureTable::Entry* ReconfigureTable::find(const std::string& name,
                                                      std::vector<std::string>* notes) const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_) {
    if (entry.field.name == name) return &entry;
    names.push_back(entry.field.name);
  }
  const std::string nearest = closest_match(name, names);
  notes->push_back(name + " is not known" +
                   (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
  return nullptr;
}

std::string ReconfigureTable::text_of(const Entry& entry, const ConfigNode& values) const {
  const ConfigNode* const value = find_value(values, entry.field.name);
  return value != nullptr && value->kind == ConfigNode::Kind::kScalar ? value->scalar
                                                                      : entry.field.default_text;
}

void ReconfigureTable::put(const Entry& entry, const std::string& text, Config* config) const {
  const std::string& name = entry.field.name;
  if (entry.field.kind == Kind::kBool) {
    const auto flag = static_cast<std::uint8_t>(is_true(text));
    config->bools.push_back(named<dynamic_reconfigure::BoolParameter>(name, flag));
  } else if (entry.is_whole()) {
    const std::int32_t value = whole(number_of(text));
    config->ints.push_back(named<dynamic_reconfigure::IntParameter>(name, value));
  } else if (entry.field.kind == Kind::kNumber) {
    const double value = number_of(text);
    config->doubles.push_back(named<dynamic_reconfigure::DoubleParameter>(name, value));
  } else {
    config->strs.push_back(named<dynamic_reconfigure::StrParameter>(name, text));
  }
}

Config ReconfigureTable::config_of(const ConfigNode& values) const {
  Config config;
  for (const Entry& entry : entries_) put(entry, text_of(entry, values), &config);
  config.groups.push_back(default_group());
  return config;
}

dynamic_reconfigure::ConfigDescription ReconfigureTable::description() const {
  dynamic_reconfigure::ConfigDescription result;
  dynamic_reconfigure::Group group;
  group.name = kGroup;
  for (const Entry& entry : entries_) {
    const ConfigField& field = entry.field;
    const bool has_ends = entry.is_whole() || field.kind == Kind::kNumber;
    group.parameters.push_back(described(field, entry.is_whole(), entry.is_number_of_choice));
    put(entry, has_ends ? number_text(entry.lo) : "", &result.min);
    put(entry,
        has_ends                    ? number_text(entry.hi)
        : field.kind == Kind::kBool ? "true"
                                    : "",
        &result.max);
  }
  result.groups.push_back(group);
  result.dflt = config_of(first_);
  result.min.groups.push_back(default_group());
  result.max.groups.push_back(default_group());
  return result;
}

void ReconfigureTable::take_number(const std::string& name, double value, ConfigNode* values,
                                   std::vector<std::string>* notes) const {
  const Entry* const entry = find(name, notes);
  if (entry == nullptr) return;
  const ConfigField& field = entry->field;
  if (field.kind == Kind::kBool) return take_text(name, flag_text(value != 0.0), values, notes);
  if (std::isnan(value) && field.is_optional) return erase_value(values, name);
  const double legal = nearest_legal(field, value, notes);
  const std::string text = entry->is_whole() ? std::to_string(whole(legal)) : number_text(legal);
  set_value(values, name, scalar_node(text, false));
}

void ReconfigureTable::take_text(const std::string& name, const std::string& value,
                                 ConfigNode* values, std::vector<std::string>* notes) const {
  const Entry* const entry = find(name, notes);
  if (entry == nullptr || name == kRestore) return;
  set_value(values, name, scalar_node(value, entry->field.kind != Kind::kBool));
}

ConfigNode ReconfigureTable::changed(const Config& request, std::vector<std::string>* notes) const {
  if (wants_first_values(request)) return first_;
  ConfigNode result = values_;
  for (const auto& flag : request.bools) {
    take_text(flag.name, flag_text(static_cast<bool>(flag.value)), &result, notes);
  }
  for (const auto& number : request.ints) take_number(number.name, number.value, &result, notes);
  for (const auto& number : request.doubles) take_number(number.name, number.value, &result, notes);
  for (const auto& text : request.strs) take_text(text.name, text.value, &result, notes);
  return result;
}

}  // namespace trident::ros_utils
