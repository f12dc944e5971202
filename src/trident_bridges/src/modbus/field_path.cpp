// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "field_path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges::modbus {
namespace {

constexpr int kMaxElement = 4096;  // of an array of any length, which must be that long then

/// The field of a type by its name; throws Error with the nearest one.
const MessageField& field_named(const MessageDefinition& definition, const std::string& type,
                                const std::string& name) {
  const auto& fields = definition.fields(type);
  std::vector<std::string> names;
  for (const MessageField& field : fields) {
    if (field.name == name) return field;
    names.push_back(field.name);
  }
  throw Error(type + " has no field " + unknown_name_text(name, names));
}

void check_element(const PathStep& step, const MessageField& field) {
  if (step.element == PathStep::kWhole) return;
  const int count = field.length == MessageField::kVariable ? kMaxElement : field.length;
  if (field.length == MessageField::kSingle) {
    throw Error("field '" + field.name + "' is no array");
  }
  if (step.element >= count) {
    throw Error("element " + std::to_string(step.element) + " of '" + field.name +
                "', legal: 0 to " + std::to_string(count - 1));
  }
}

/// A path continues in a message, and ends with a number, an array of numbers or a text.
void check_step(const PathStep& step, const MessageField& field, const std::string& type,
                bool is_last) {
  check_element(step, field);
  if (is_last == (field.type == WireType::kMessage)) {
    throw Error("field '" + field.name + "' of " + type + " is " +
                (is_last ? "a " + field.message + ", legal: a number or a text in it"
                         : "a " + field.type_text + ", which has no fields"));
  }
  if (is_whole_array(step, field) && (!is_last || field.type == WireType::kString)) {
    throw Error("field '" + field.name + "' of " + type +
                " is an array, of which one element must be named: " + field.name + "[0]");
  }
}

/// nullopt: the text is no number of an element.
std::optional<int> element_number(const std::string& text) {
  const auto number = number_from_text(text);
  if (!number || *number < 0 || *number > kMaxElement || *number != std::floor(*number)) {
    return std::nullopt;
  }
  return static_cast<int>(*number);
}

/// Takes "[3]" off the name of a step.
void take_element(const std::string& path, PathStep& step) {
  const std::size_t open = step.name.find('[');
  if (open == std::string::npos) return;
  const std::string inside = step.name.substr(open + 1, step.name.size() - open - 2);
  const auto number = step.name.back() == ']' ? element_number(inside) : std::nullopt;
  if (!number) {
    throw Error("field '" + path + "': '" + step.name + "', legal: name[0] to name[4096]");
  }
  step.element = *number;
  step.name.resize(open);
}

}  // namespace

bool is_whole_array(const PathStep& step, const MessageField& field) {
  return field.length != MessageField::kSingle && step.element == PathStep::kWhole;
}

MessageField target_of(const MessageDefinition& definition, const std::vector<PathStep>& steps) {
  std::string type = definition.type();
  MessageField field;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    field = field_named(definition, type, steps[i].name);
    check_step(steps[i], field, type, i + 1 == steps.size());
    type = field.message;
  }
  return field;
}

std::vector<PathStep> parse_field_path(const std::string& path) {
  std::vector<PathStep> steps;
  std::size_t begin = 0;
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    PathStep step{path.substr(begin, end - begin)};
    take_element(path, step);
    if (step.name.empty()) throw Error("field '" + path + "', legal: names with dots between them");
    steps.push_back(std::move(step));
    begin = end + 1;
  }
  return steps;
}

}  // namespace trident::bridges::modbus
