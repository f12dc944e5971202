// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_bridges/modbus/value.h"

namespace trident::bridges::modbus {
namespace {

constexpr std::size_t kMaxNames = 16;  // of the bits of a register
constexpr int kMaxCharacters = 246;    // of 123 registers, which one request can write

const std::array<std::pair<const char*, ValueKind>, 9> kPlainTypes{{
    {"bool", ValueKind::kBool},
    {"int16", ValueKind::kInt16},
    {"uint16", ValueKind::kUint16},
    {"int32", ValueKind::kInt32},
    {"uint32", ValueKind::kUint32},
    {"int64", ValueKind::kInt64},
    {"uint64", ValueKind::kUint64},
    {"float32", ValueKind::kFloat32},
    {"float64", ValueKind::kFloat64},
}};

/// What stands in the brackets of "name(…)"; false: the text is not of that form.
bool take_argument(const std::string& text, const std::string& name, std::string& argument) {
  if (!starts_with(text, name + "(") || text.back() != ')') return false;
  argument = text.substr(name.size() + 1, text.size() - name.size() - 2);
  return true;
}

ValueType string_type(const std::string& argument) {
  const auto characters = number_from_text(argument);
  if (!characters || *characters != std::floor(*characters) || *characters < 1 ||
      *characters > kMaxCharacters) {
    throw Error("type 'string(" + argument + ")', legal: string(1) to string(246) characters");
  }
  return {ValueKind::kString, static_cast<int>(*characters)};
}

ValueType bits_type(std::string argument) {
  std::replace(argument.begin(), argument.end(), ',', ' ');
  ValueType type{ValueKind::kBits};
  std::string name;
  for (const char c : argument + ' ') {
    if (c != ' ') {
      name += c;
    } else if (!name.empty()) {
      type.bits.push_back(std::exchange(name, ""));
    }
  }
  if (type.bits.empty() || type.bits.size() > kMaxNames) {
    throw Error("type bits with " + std::to_string(type.bits.size()) + " names, legal: 1 to 16");
  }
  return type;
}

}  // namespace

int ValueType::registers() const {
  switch (kind) {
    case ValueKind::kInt32:
    case ValueKind::kUint32:
    case ValueKind::kFloat32:
      return 2;
    case ValueKind::kInt64:
    case ValueKind::kUint64:
    case ValueKind::kFloat64:
      return 4;
    case ValueKind::kString:
      return (characters + 1) / 2;
    default:
      return 1;
  }
}

bool ValueType::is_integer() const {
  return kind >= ValueKind::kInt16 && kind <= ValueKind::kUint64;
}

bool ValueType::is_real() const {
  return kind == ValueKind::kFloat32 || kind == ValueKind::kFloat64;
}

std::string ValueType::text() const {
  if (kind == ValueKind::kString) return "string(" + std::to_string(characters) + ")";
  if (kind == ValueKind::kBits) return "bits(" + join(bits, " ") + ")";
  for (const auto& [name, plain] : kPlainTypes) {
    if (plain == kind) return name;
  }
  return "";
}

ValueType parse_value_type(const std::string& text) {
  std::string argument;
  if (take_argument(text, "string", argument)) return string_type(argument);
  if (take_argument(text, "bits", argument)) return bits_type(argument);
  std::vector<std::string> known;
  for (const auto& [name, kind] : kPlainTypes) {
    if (text == name) return {kind};
    known.emplace_back(name);
  }
  known.insert(known.end(), {"string(N)", "bits(NAMES)"});
  throw Error("unknown type " + unknown_name_text(text, known));
}

}  // namespace trident::bridges::modbus
