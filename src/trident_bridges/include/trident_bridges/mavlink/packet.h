// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

inline constexpr std::uint8_t kStart2 = 0xFD;      ///< first byte of a MAVLink 2 packet
inline constexpr std::uint8_t kStart1 = 0xFE;      ///< first byte of a MAVLink 1 packet
inline constexpr std::uint8_t kSignedFlag = 0x01;  ///< incompatibility flag: a signature
inline constexpr std::size_t kHeader2 = 10;        ///< [bytes] of MAVLink 2
inline constexpr std::size_t kHeader1 = 6;         ///< [bytes] of MAVLink 1
inline constexpr std::size_t kChecksumSize = 2;    ///< [bytes]
inline constexpr std::size_t kSignatureSize = 13;  ///< [bytes] link id, time, 48 bits
/// [bytes] of the longest packet.
inline constexpr std::size_t kMaxPacket = kHeader2 + kMaxPayload + kChecksumSize + kSignatureSize;

/// A packet as it lies in bytes that somebody else owns. Its checksum is right, unless it is
/// unknown; nothing was said about its signature.
struct Packet {
  std::uint32_t id = 0;       ///< of the message
  Address source;             ///< who sent it
  std::uint8_t sequence = 0;  ///< counts the sender's packets, modulo 256
  std::uint8_t version = 2;   ///< of MAVLink: 1 or 2
  bool is_known = true;       ///< false: the dialect has no such message; no checksum was compared
  bool is_signed = false;     ///< carries a signature
  Bytes payload;              ///< as sent: MAVLink 2 leaves out zeros at the end
  Bytes raw;                  ///< the whole packet
};

/// The message of a packet. A payload that is longer than the dialect's is kept whole.
Message to_message(const Packet& packet);

/// For whom a packet is: the fields target_system and target_component of its payload, 0 where it
/// has no such field, leaves it out, or is unknown.
Address target_of(const Packet& packet);

}  // namespace trident::bridges::mavlink
