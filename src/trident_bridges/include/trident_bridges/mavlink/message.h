// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "trident_base/span.h"

namespace trident::bridges::mavlink {

/// A block of bytes that somebody else owns.
using Bytes = Span<const std::uint8_t>;

/// Who sends a message, or for whom it is. In a target 0 means all.
struct Address {
  std::uint8_t system = 0;     ///< of a vehicle or a ground station
  std::uint8_t component = 0;  ///< MAV_COMPONENT: an autopilot is 1, a ground station 190

  friend bool operator==(Address a, Address b) {
    return a.system == b.system && a.component == b.component;
  }
  friend bool operator!=(Address a, Address b) { return !(a == b); }
  friend bool operator<(Address a, Address b) {
    return a.system != b.system ? a.system < b.system : a.component < b.component;
  }
};

/// True when a message for `target` concerns `self`: each number is equal, or 0 in the target.
inline bool is_for(Address target, Address self) {
  return (target.system == 0 || target.system == self.system) &&
         (target.component == 0 || target.component == self.component);
}

inline constexpr std::size_t kMaxPayload = 255;  ///< [bytes]

/// A message outside of any packet. Its fields lie in the payload as on the wire, in the order of
/// their sizes, lowest byte first; dialect.h makes structs of them and message_table.h lists them.
struct Message {
  std::uint32_t id = 0;       ///< of the type
  Address source;             ///< who sent it
  std::uint8_t sequence = 0;  ///< of the sender's packets; a PacketWriter gives its own
  std::uint8_t length = 0;    ///< [bytes] of the payload that are meaningful
  alignas(8) std::array<std::uint8_t, kMaxPayload> payload{};  ///< zeros behind `length`
};

/// Takes what a protocol's state machine sends.
using MessageSink = std::function<void(const Message&)>;

}  // namespace trident::bridges::mavlink
