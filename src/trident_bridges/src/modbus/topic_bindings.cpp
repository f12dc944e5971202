// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/topic_bindings.h"

#include <map>
#include <utility>

#include "trident_bridges/modbus/message_fields.h"

namespace trident::bridges::modbus {
namespace {

/// Appends a value's topic, or those of its bits.
void add_bindings(const RegisterEntry& entry, std::size_t index, const std::string& suffix,
                  std::vector<TopicBinding>& bindings) {
  const std::string topic = entry.topic + suffix;
  const ValueType& type = entry.layout.type;
  if (type.kind != ValueKind::kBits || entry.message != "std_msgs/Bool") {
    bindings.push_back({index, TopicBinding::kWhole, topic, entry.message, entry.field});
    return;
  }
  for (std::size_t bit = 0; bit < type.bits.size(); ++bit) {
    if (type.bits[bit] == "-") continue;
    bindings.push_back({index, static_cast<int>(bit), entry.topic + "/" + type.bits[bit] + suffix,
                        entry.message, entry.field});
  }
}

/// Why a field cannot hold a value; "": it can.
std::string misfit(const RegisterEntry& entry, const FieldReader& reader) {
  const bool is_text = entry.layout.type.kind == ValueKind::kString;
  const MessageField& field = reader.field();
  if (is_text != (field.type == WireType::kString)) {
    return "field '" + entry.field + "' of " + entry.message + " is a " + field.type_text +
           ", the value is a " + entry.layout.type.text();
  }
  if (entry.layout.count > 1 && !reader.is_array()) {
    return "field '" + entry.field + "' of " + entry.message + " is no array, count is " +
           std::to_string(entry.layout.count);
  }
  if (field.length >= 0 && reader.is_array() && field.length < entry.layout.count) {
    return "field '" + entry.field + "' of " + entry.message + " has " +
           std::to_string(field.length) + " elements, count is " +
           std::to_string(entry.layout.count);
  }
  return "";
}

/// Why an entry cannot be read from its field; "": it can.
std::string field_problem(const RegisterEntry& entry, const MessageDefinition& definition) {
  try {
    return misfit(entry, FieldReader(definition, entry.field));
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

TopicBindings topic_bindings(const RegisterMap& map, Role role) {
  TopicBindings bindings;
  auto& commands = role == Role::kServer ? bindings.outputs : bindings.inputs;
  auto& states = role == Role::kServer ? bindings.inputs : bindings.outputs;
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    const RegisterEntry& entry = map.entries[i];
    if (entry.topic.empty()) continue;
    if (entry.is_writable()) add_bindings(entry, i, "", commands);
    if (entry.is_polled()) add_bindings(entry, i, entry.is_writable() ? "/state" : "", states);
  }
  return bindings;
}

std::vector<ConfigError> errors_of_topics(const RegisterMap& map, const DefinitionSource& source) {
  std::vector<ConfigError> errors;
  std::map<std::string, const RegisterEntry*> first_of_topic;
  const auto report = [&](const RegisterEntry& entry, const char* key, const std::string& text) {
    errors.emplace_back(map.file, entry.line, "registers." + entry.name + "." + key, text);
  };
  for (const RegisterEntry& entry : map.entries) {
    if (entry.topic.empty()) continue;
    const RegisterEntry& first = *first_of_topic.emplace(entry.topic, &entry).first->second;
    if (first.message != entry.message) {
      report(entry, "message",
             entry.message + ", but line " + std::to_string(first.line) + " has " + first.message +
                 " on topic " + entry.topic);
    }
    const MessageDefinition* definition = nullptr;
    try {
      definition = &source(entry.message);
    } catch (const Error& error) {
      report(entry, "message", error.what());
      continue;
    }
    const std::string problem = field_problem(entry, *definition);
    if (!problem.empty()) report(entry, "field", problem);
  }
  return errors;
}

}  // namespace trident::bridges::modbus
