// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/message_definition.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges::modbus {
namespace {

constexpr int kMaxFixedArray = 1 << 20;  // more is no message, but a mistake

const std::map<std::string, WireType>& wire_types() {
  static const std::map<std::string, WireType> types{
      {"bool", WireType::kBool},         {"int8", WireType::kInt8},
      {"byte", WireType::kInt8},         {"uint8", WireType::kUint8},
      {"char", WireType::kUint8},        {"int16", WireType::kInt16},
      {"uint16", WireType::kUint16},     {"int32", WireType::kInt32},
      {"uint32", WireType::kUint32},     {"int64", WireType::kInt64},
      {"uint64", WireType::kUint64},     {"float32", WireType::kFloat32},
      {"float64", WireType::kFloat64},   {"time", WireType::kTime},
      {"duration", WireType::kDuration}, {"string", WireType::kString}};
  return types;
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

/// A line of a definition in its two words; empty: it has no field and no constant.
struct DefinitionLine {
  std::string type, name;
  std::optional<std::string> constant;  ///< value of a constant
};

/// Texts of constants reach to the end of the line; elsewhere "#" begins a comment.
DefinitionLine split_line(const std::string& line) {
  const std::string code = trimmed(line.substr(0, line.find('#')));
  DefinitionLine result;
  const std::size_t space = code.find_first_of(" \t");
  result.type = code.substr(0, space);
  if (space == std::string::npos) return result;
  const std::string rest = trimmed(code.substr(space));
  const std::size_t equals = rest.find('=');
  result.name = trimmed(rest.substr(0, equals));
  if (equals == std::string::npos) return result;
  result.constant = result.type == "string" ? trimmed(line.substr(line.find('=') + 1))
                                            : trimmed(rest.substr(equals + 1));
  return result;
}

std::string full_name(const std::string& type, const std::string& package) {
  if (type == "Header") return "std_msgs/Header";
  return type.find('/') == std::string::npos ? package + "/" + type : type;
}

std::string package_of(const std::string& type) { return type.substr(0, type.find('/')); }

/// nullopt: the text is no length of an array.
std::optional<int> fixed_length(const std::string& text) {
  const auto length = number_from_text(text);
  if (!length || *length < 0 || *length > kMaxFixedArray) return std::nullopt;
  return static_cast<int>(*length);
}

/// Takes the brackets off a type.
int take_length(std::string& type) {
  if (type.empty() || type.back() != ']') return MessageField::kSingle;
  const std::size_t open = type.find('[');
  const std::string inside =
      open == std::string::npos ? "?" : type.substr(open + 1, type.size() - open - 2);
  type.resize(std::min(open, type.size()));
  if (inside.empty()) return MessageField::kVariable;
  const auto length = fixed_length(inside);
  if (!length) throw Error("array length '" + inside + "', legal: 0 to 1048576");
  return *length;
}

bool is_identifier(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
}

MessageField make_field(const DefinitionLine& line, const std::string& package) {
  MessageField field;
  field.name = line.name;
  field.type_text = line.type;
  field.length = take_length(field.type_text);
  const auto known = wire_types().find(field.type_text);
  if (known != wire_types().end()) {
    field.type = known->second;
  } else {
    field.message = full_name(field.type_text, package);
  }
  return field;
}

std::string md5_of(const std::string& text) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), digest, &size, EVP_md5(), nullptr) != 1) {
    throw Error("MD5: the OpenSSL digest failed");
  }
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) {
    hex += "0123456789abcdef"[digest[i] >> 4];
    hex += "0123456789abcdef"[digest[i] & 0xF];
  }
  return hex;
}

bool is_separator(const std::string& line) {
  return line.size() >= 80 && trimmed(line).find_first_not_of('=') == std::string::npos;
}

}  // namespace

std::size_t wire_size(WireType type) {
  switch (type) {
    case WireType::kBool:
    case WireType::kInt8:
    case WireType::kUint8:
      return 1;
    case WireType::kInt16:
    case WireType::kUint16:
      return 2;
    case WireType::kInt32:
    case WireType::kUint32:
    case WireType::kFloat32:
      return 4;
    case WireType::kString:
    case WireType::kMessage:
      return 0;
    default:
      return 8;
  }
}

MessageDefinition::MessageDefinition(std::string type, std::string text)
    : type_(std::move(type)), text_(std::move(text)) {
  std::istringstream lines(text_);
  std::string name = type_, part;
  for (std::string line; std::getline(lines, line);) {
    if (!is_separator(line)) {
      part += line + '\n';
      continue;
    }
    add_type(name, std::exchange(part, ""));
    std::getline(lines, line);
    if (!starts_with(line, "MSG: ")) {
      throw Error("definition of " + type_ + ": '" + line + "', legal: MSG: package/Type");
    }
    name = trimmed(line.substr(5));
  }
  add_type(name, part);
  check_types();
}

void MessageDefinition::add_type(const std::string& name, const std::string& text) {
  Type& type = types_[name];
  type = {};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const DefinitionLine parts = split_line(line);
    if (parts.type.empty()) continue;
    if (!is_identifier(parts.name)) {
      throw Error("definition of " + name + ": '" + trimmed(line) + "', legal: type name");
    }
    if (parts.constant) {
      type.constants.push_back(parts.type + " " + parts.name + "=" + *parts.constant);
    } else {
      type.fields.push_back(make_field(parts, package_of(name)));
    }
  }
}

void MessageDefinition::check_types() const {
  for (const auto& [name, type] : types_) {
    for (const MessageField& field : type.fields) {
      if (field.type == WireType::kMessage && types_.count(field.message) == 0) {
        throw Error("definition of " + name + ": field '" + field.name + "' is of type " +
                    field.message + ", which is not defined");
      }
    }
  }
  for (const auto& [name, type] : types_) {
    std::vector<std::string> above;
    check_acyclic(name, above);
  }
}

void MessageDefinition::check_acyclic(const std::string& name,
                                      std::vector<std::string>& above) const {
  if (std::find(above.begin(), above.end(), name) != above.end()) {
    throw Error("definition of " + name + ": it holds itself");
  }
  above.push_back(name);
  for (const MessageField& field : types_.at(name).fields) {
    if (field.type == WireType::kMessage) check_acyclic(field.message, above);
  }
  above.pop_back();
}

/// Constants, then fields, of which messages stand as their sums (genmsg.gentools).
std::string MessageDefinition::md5sum_of(const std::string& name) const {
  std::string text;
  const Type& type = types_.at(name);
  for (const std::string& constant : type.constants) text += constant + '\n';
  for (const MessageField& field : type.fields) {
    if (field.type == WireType::kMessage) {
      text += md5sum_of(field.message);
    } else {
      text += field.type_text;
      if (field.length == MessageField::kVariable) text += "[]";
      if (field.length >= 0) text += '[' + std::to_string(field.length) + ']';
    }
    text += ' ' + field.name + '\n';
  }
  return md5_of(trimmed(text));
}

bool MessageDefinition::has_header() const {
  return !fields().empty() && fields().front().message == "std_msgs/Header" &&
         fields().front().length == MessageField::kSingle;
}

std::vector<std::string> used_types(const std::string& type, const std::string& text) {
  std::vector<std::string> result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    DefinitionLine parts = split_line(line);
    if (parts.name.empty() || parts.constant) continue;
    take_length(parts.type);
    const std::string name = full_name(parts.type, package_of(type));
    const bool is_message = wire_types().count(parts.type) == 0;
    if (is_message && std::find(result.begin(), result.end(), name) == result.end()) {
      result.push_back(name);
    }
  }
  return result;
}

}  // namespace trident::bridges::modbus
