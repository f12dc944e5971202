// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// The dialect's structs, enumerations and constants, made by pymavlink's generator at build time
/// (mavlink_heartbeat_t, MAV_CMD_NAV_TAKEOFF, MAVLINK_MSG_ID_HEARTBEAT ...). They are 160,000
/// lines: to be included by sources, never by headers.
#pragma once

#include <cstring>
#include <optional>

#include "trident/mavlink.h"
#include "trident_bridges/mavlink/message.h"
#include "trident_message_list.h"

namespace trident::bridges::mavlink {

/// Id and length of the message of a generated struct.
template <class Payload>
struct PayloadTraits;

#define TRIDENT_MAVLINK_TRAITS(name, NAME)                                    \
  template <>                                                                 \
  struct PayloadTraits<mavlink_##name##_t> {                                  \
    static constexpr std::uint32_t kId = MAVLINK_MSG_ID_##NAME;               \
    static constexpr std::uint8_t kLength = MAVLINK_MSG_ID_##NAME##_LEN;      \
    static_assert(sizeof(mavlink_##name##_t) >= MAVLINK_MSG_ID_##NAME##_LEN); \
  };
TRIDENT_MAVLINK_MESSAGES(TRIDENT_MAVLINK_TRAITS)
#undef TRIDENT_MAVLINK_TRAITS

/// The message of a generated struct, e.g. mavlink_heartbeat_t.
template <class Payload>
Message pack(const Payload& payload, Address source) {
  Message message;
  message.id = PayloadTraits<Payload>::kId;
  message.source = source;
  message.length = PayloadTraits<Payload>::kLength;
  std::memcpy(message.payload.data(), &payload, PayloadTraits<Payload>::kLength);
  return message;
}

/// True when the message is of the type of that struct.
template <class Payload>
bool is(const Message& message) {
  return message.id == PayloadTraits<Payload>::kId;
}

/// The struct of a message for which is<Payload>() is true. What the sender left out is zero.
template <class Payload>
Payload unpack(const Message& message) {
  Payload payload{};
  std::memcpy(&payload, message.payload.data(), PayloadTraits<Payload>::kLength);
  return payload;
}

/// The struct of a message that is of its type and for `self`; nothing for any other one.
template <class Payload>
std::optional<Payload> unpack_if_for(const Message& message, Address self) {
  if (!is<Payload>(message)) return std::nullopt;
  const auto payload = unpack<Payload>(message);
  if (!is_for({payload.target_system, payload.target_component}, self)) return std::nullopt;
  return payload;
}

}  // namespace trident::bridges::mavlink
