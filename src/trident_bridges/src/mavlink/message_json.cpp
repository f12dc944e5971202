// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/message_json.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "trident_bridges/mavlink/message_table.h"

namespace trident::bridges::mavlink {
namespace {

void append_format(std::string& text, const char* format, ...)
    __attribute__((format(printf, 2, 3)));

void append_format(std::string& text, const char* format, ...) {
  char buffer[64];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  text += buffer;
}

template <class Number>
Number read(const std::uint8_t* at) {
  Number value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

void append_real(std::string& text, double value, int digits) {
  if (std::isnan(value)) {
    text += "NaN";
  } else if (std::isinf(value)) {
    text += value > 0 ? "Infinity" : "-Infinity";
  } else {
    append_format(text, "%.*g", digits, value);
  }
}

void append_number(std::string& text, FieldType type, const std::uint8_t* at) {
  switch (type) {
    case FieldType::kChar:
    case FieldType::kUint8:
      return append_format(text, "%u", unsigned{*at});
    case FieldType::kInt8:
      return append_format(text, "%d", int{read<std::int8_t>(at)});
    case FieldType::kUint16:
      return append_format(text, "%u", unsigned{read<std::uint16_t>(at)});
    case FieldType::kInt16:
      return append_format(text, "%d", int{read<std::int16_t>(at)});
    case FieldType::kUint32:
      return append_format(text, "%u", read<std::uint32_t>(at));
    case FieldType::kInt32:
      return append_format(text, "%d", read<std::int32_t>(at));
    case FieldType::kUint64:
      return append_format(text, "%llu", static_cast<unsigned long long>(read<std::uint64_t>(at)));
    case FieldType::kInt64:
      return append_format(text, "%lld", static_cast<long long>(read<std::int64_t>(at)));
    case FieldType::kFloat:
      return append_real(text, read<float>(at), 9);
    case FieldType::kDouble:
      return append_real(text, read<double>(at), 17);
  }
}

/// Whether a character stands for itself in a text of JSON.
bool is_plain(std::uint8_t c) { return c >= 0x20 && c < 0x7F && c != '"' && c != '\\'; }

void append_text(std::string& text, const std::uint8_t* at, std::size_t size) {
  text += '"';
  for (std::size_t i = 0; i < size && at[i] != 0; ++i) {
    if (is_plain(at[i])) {
      text += static_cast<char>(at[i]);
    } else {
      append_format(text, "\\u%04x", unsigned{at[i]});
    }
  }
  text += '"';
}

void append_field(std::string& text, const FieldFacts& field, const std::uint8_t* payload) {
  const std::uint8_t* at = payload + field.offset;
  if (field.array_length == 0) return append_number(text, field.type, at);
  if (field.type == FieldType::kChar) return append_text(text, at, field.array_length);
  text += '[';
  for (std::size_t i = 0; i < field.array_length; ++i) {
    if (i > 0) text += ", ";
    append_number(text, field.type, at + i * size_of(field.type));
  }
  text += ']';
}

void append_payload(std::string& text, const Message& message) {
  text += "\"payload\": \"";
  for (std::size_t i = 0; i < message.length; ++i) {
    append_format(text, "%02x", unsigned{message.payload[i]});
  }
  text += '"';
}

void append_fields(std::string& text, const MessageFacts& facts, const Message& message) {
  text += "\"fields\": {";
  bool is_first = true;
  for (const FieldFacts& field : facts.fields) {
    if (!is_first) text += ", ";
    is_first = false;
    text.append("\"").append(field.name).append("\": ");
    append_field(text, field, message.payload.data());
  }
  text += '}';
}

}  // namespace

std::string to_json(const Message& message) {
  const MessageFacts* facts = find_message(message.id);
  std::string text = "{\"name\": \"";
  text += facts == nullptr ? "UNKNOWN" : facts->name;
  append_format(text, "\", \"id\": %u, \"system\": %u, ", message.id,
                unsigned{message.source.system});
  append_format(text, "\"component\": %u, \"sequence\": %u, ", unsigned{message.source.component},
                unsigned{message.sequence});
  if (facts == nullptr) {
    append_payload(text, message);
  } else {
    append_fields(text, *facts, message);
  }
  return text + '}';
}

}  // namespace trident::bridges::mavlink
