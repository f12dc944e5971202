// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/packet.h"

#include <algorithm>

#include "trident_bridges/mavlink/message_table.h"

namespace trident::bridges::mavlink {

Message to_message(const Packet& packet) {
  Message message;
  message.id = packet.id;
  message.source = packet.source;
  message.sequence = packet.sequence;
  const MessageFacts* facts = find_message(packet.id);
  const std::size_t full = facts == nullptr ? 0 : facts->max_length;
  message.length = static_cast<std::uint8_t>(std::max(full, packet.payload.size()));
  std::copy(packet.payload.begin(), packet.payload.end(), message.payload.begin());
  return message;
}

Address target_of(const Packet& packet) {
  const MessageFacts* facts = find_message(packet.id);
  if (facts == nullptr) return {};
  const auto field = [&](bool is_there, std::size_t offset) -> std::uint8_t {
    return is_there && offset < packet.payload.size() ? packet.payload[offset] : 0;
  };
  return {field(facts->has_target_system, facts->target_system),
          field(facts->has_target_component, facts->target_component)};
}

}  // namespace trident::bridges::mavlink
