// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "trident_base/span.h"

namespace trident::bridges::mavlink {

/// The type of a field of a message, or of its elements.
enum class FieldType : std::uint8_t {
  kChar,
  kUint8,
  kInt8,
  kUint16,
  kInt16,
  kUint32,
  kInt32,
  kUint64,
  kInt64,
  kFloat,
  kDouble
};

/// [bytes] of one element.
std::uint8_t size_of(FieldType type);

/// A field of a message.
struct FieldFacts {
  std::string_view name;      ///< as the dialect spells it: "time_boot_ms"
  FieldType type;             ///< of the field or its elements
  std::uint8_t array_length;  ///< 0: not an array
  std::uint8_t offset;        ///< [bytes] in the payload
};

/// What the dialect says of a type of message.
struct MessageFacts {
  std::uint32_t id;               ///< MAVLINK_MSG_ID_...
  std::string_view name;          ///< "HEARTBEAT"
  std::uint8_t crc_extra;         ///< last byte of the checksum: of names and types of the fields
  std::uint8_t min_length;        ///< [bytes] without extension fields
  std::uint8_t max_length;        ///< [bytes] with them
  bool has_target_system;         ///< is there a field target_system?
  bool has_target_component;      ///< is there a field target_component?
  std::uint8_t target_system;     ///< [bytes] offset of that field
  std::uint8_t target_component;  ///< [bytes] offset of that field
  Span<const FieldFacts> fields;  ///< in the dialect's order
};

/// All messages of the dialect, by id. They live as long as the program.
Span<const MessageFacts> message_table();

/// nullptr: the dialect has no such message.
const MessageFacts* find_message(std::uint32_t id);

/// By the name in capitals; nullptr: the dialect has no such message.
const MessageFacts* find_message(std::string_view name);

}  // namespace trident::bridges::mavlink
