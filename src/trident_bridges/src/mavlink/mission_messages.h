// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Mission items as messages. For sources alone: brings the dialect.
#pragma once

#include <optional>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/mission.h"

namespace trident::bridges::mavlink {

/// What concerns an item besides its content.
struct ItemHeader {
  Address target;
  std::uint16_t sequence = 0;
  std::uint8_t type = 0;  ///< MAV_MISSION_TYPE
};

/// An item that came, as MISSION_ITEM_INT or MISSION_ITEM.
struct ReceivedItem {
  ItemHeader header;
  MissionItem item;
  bool is_int = true;      ///< MISSION_ITEM_INT
  MissionVerdict verdict;  ///< refused when its numbers fit no item
};

/// "mission item 3".
std::string item_text(MissionType type, std::size_t item);
/// nullopt: the message is another one.
std::optional<ReceivedItem> read_item(const Message& message);
/// MISSION_ITEM_INT.
Message item_int_message(const MissionItem& item, const ItemHeader& header, Address self);
/// MISSION_ITEM.
Message item_message(const MissionItem& item, const ItemHeader& header, Address self);
/// MISSION_ACK.
Message ack_message(MissionResult result, Address target, std::uint8_t type, Address self);
/// MISSION_REQUEST_INT, or MISSION_REQUEST.
Message request_message(const ItemHeader& header, bool is_int, Address self);
/// MISSION_COUNT.
Message count_message(std::size_t count, Address target, std::uint8_t type, Address self);

}  // namespace trident::bridges::mavlink
