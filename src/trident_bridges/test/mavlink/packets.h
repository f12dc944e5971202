// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Packets for tests.
#pragma once

#include <cstdint>
#include <vector>

#include "trident_bridges/mavlink/packet_writer.h"

namespace trident::bridges::mavlink::testing {

inline constexpr Address kVehicle{1, 1};     ///< an autopilot
inline constexpr Address kGround{255, 190};  ///< a ground station

/// ATTITUDE of vehicle 7.
Message attitude(float roll);
/// A message of the dialect's type number `type` (modulo their number) with random fields.
Message random_message(std::uint32_t type, std::uint64_t seed);
/// A copy of what a writer makes.
std::vector<std::uint8_t> packet_of(PacketWriter& writer, const Message& message);
/// The packet with these incompatibility flags and the checksum that belongs to them.
std::vector<std::uint8_t> with_flags(const Message& message, std::uint8_t flags);
/// The packet as MAVLink 1.
std::vector<std::uint8_t> mavlink1(const Message& message);
/// `more` behind `bytes`.
void append(std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& more);
/// All messages of a stream.
std::vector<Message> parse(const std::vector<std::uint8_t>& bytes);

}  // namespace trident::bridges::mavlink::testing
