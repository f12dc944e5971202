// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/message_table.h"

#include <algorithm>
#include <array>
#include <vector>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

FieldType field_type(mavlink_message_type_t type) {
  switch (type) {
    case MAVLINK_TYPE_CHAR:
      return FieldType::kChar;
    case MAVLINK_TYPE_UINT8_T:
      return FieldType::kUint8;
    case MAVLINK_TYPE_INT8_T:
      return FieldType::kInt8;
    case MAVLINK_TYPE_UINT16_T:
      return FieldType::kUint16;
    case MAVLINK_TYPE_INT16_T:
      return FieldType::kInt16;
    case MAVLINK_TYPE_UINT32_T:
      return FieldType::kUint32;
    case MAVLINK_TYPE_INT32_T:
      return FieldType::kInt32;
    case MAVLINK_TYPE_UINT64_T:
      return FieldType::kUint64;
    case MAVLINK_TYPE_INT64_T:
      return FieldType::kInt64;
    case MAVLINK_TYPE_FLOAT:
      return FieldType::kFloat;
    case MAVLINK_TYPE_DOUBLE:
      return FieldType::kDouble;
  }
  return FieldType::kUint8;
}

/// The dialect, and where in it ids below kDirect are.
struct Table {
  static constexpr std::uint32_t kDirect = 512;

  std::vector<FieldFacts> fields;
  std::vector<MessageFacts> messages;
  std::array<const MessageFacts*, kDirect> direct{};

  Table();
  void add_fields(const mavlink_message_info_t& info);
  MessageFacts facts(const mavlink_msg_entry_t& entry, const mavlink_message_info_t& info,
                     std::size_t first_field) const;
};

/// Whether the generated structs lie in memory as their messages lie on the wire.
template <std::size_t kCount>
constexpr bool structs_are_payloads(const mavlink_message_info_t (&infos)[kCount]) {
  for (const mavlink_message_info_t& info : infos) {
    for (unsigned i = 0; i < info.num_fields; ++i) {
      if (info.fields[i].wire_offset != info.fields[i].structure_offset) return false;
    }
  }
  return true;
}

Table::Table() {
  static constexpr mavlink_msg_entry_t kEntries[] = MAVLINK_MESSAGE_CRCS;
  static constexpr mavlink_message_info_t kInfos[] = MAVLINK_MESSAGE_INFO;
  static_assert(std::size(kEntries) == std::size(kInfos));
  static_assert(structs_are_payloads(kInfos));
  std::vector<std::size_t> first_fields;
  for (const mavlink_message_info_t& info : kInfos) {
    first_fields.push_back(fields.size());
    add_fields(info);
  }
  messages.reserve(std::size(kEntries));
  for (std::size_t i = 0; i < std::size(kEntries); ++i) {
    messages.push_back(facts(kEntries[i], kInfos[i], first_fields[i]));
  }
  for (const MessageFacts& message : messages) {
    if (message.id < kDirect) direct[message.id] = &message;
  }
}

void Table::add_fields(const mavlink_message_info_t& info) {
  for (unsigned i = 0; i < info.num_fields; ++i) {
    const mavlink_field_info_t& field = info.fields[i];
    fields.push_back({field.name, field_type(field.type),
                      static_cast<std::uint8_t>(field.array_length),
                      static_cast<std::uint8_t>(field.wire_offset)});
  }
}

MessageFacts Table::facts(const mavlink_msg_entry_t& entry, const mavlink_message_info_t& info,
                          std::size_t first_field) const {
  return {entry.msgid,
          info.name,
          entry.crc_extra,
          entry.min_msg_len,
          entry.max_msg_len,
          (entry.flags & MAV_MSG_ENTRY_FLAG_HAVE_TARGET_SYSTEM) != 0,
          (entry.flags & MAV_MSG_ENTRY_FLAG_HAVE_TARGET_COMPONENT) != 0,
          entry.target_system_ofs,
          entry.target_component_ofs,
          {fields.data() + first_field, info.num_fields}};
}

const Table& table() {
  static const Table instance;
  return instance;
}

}  // namespace

std::uint8_t size_of(FieldType type) {
  switch (type) {
    case FieldType::kChar:
    case FieldType::kUint8:
    case FieldType::kInt8:
      return 1;
    case FieldType::kUint16:
    case FieldType::kInt16:
      return 2;
    case FieldType::kUint32:
    case FieldType::kInt32:
    case FieldType::kFloat:
      return 4;
    case FieldType::kUint64:
    case FieldType::kInt64:
    case FieldType::kDouble:
      return 8;
  }
  return 1;
}

Span<const MessageFacts> message_table() { return table().messages; }

const MessageFacts* find_message(std::uint32_t id) {
  const Table& all = table();
  if (id < Table::kDirect) return all.direct[id];
  const auto it =
      std::lower_bound(all.messages.begin(), all.messages.end(), id,
                       [](const MessageFacts& facts, std::uint32_t key) { return facts.id < key; });
  return it != all.messages.end() && it->id == id ? &*it : nullptr;
}

const MessageFacts* find_message(std::string_view name) {
  const auto& messages = table().messages;
  const auto it = std::find_if(messages.begin(), messages.end(),
                               [&](const MessageFacts& facts) { return facts.name == name; });
  return it == messages.end() ? nullptr : &*it;
}

}  // namespace trident::bridges::mavlink
