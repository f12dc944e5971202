// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "trident_bridges/mavlink/packet.h"

namespace trident::bridges::mavlink {

/// What a parser has seen.
struct ParserCounts {
  std::uint64_t packets = 0;        ///< handed on, unknown ones included
  std::uint64_t unknown = 0;        ///< of these: the dialect has no such message
  std::uint64_t bad_checksum = 0;   ///< began as a packet does, but the checksum was wrong
  std::uint64_t unknown_flags = 0;  ///< dropped: incompatibility flags that nobody here knows
  std::uint64_t mavlink1 = 0;       ///< dropped: MAVLink 1 where it is not accepted
  std::uint64_t skipped_bytes = 0;  ///< between packets
};

/// Finds packets in bytes. Behind a packet with a wrong checksum the search continues at its second
/// byte, so that garbage costs no packet that follows it. An unknown message is believed where
/// another packet, or the end of what was received, follows it. Nothing is allocated.
class PacketParser {
 public:
  /// `accept_mavlink1`: hand on packets of MAVLink 1, too.
  explicit PacketParser(bool accept_mavlink1 = false) : accept_mavlink1_(accept_mavlink1) {}

  /// More bytes of a stream, in pieces of any size. What of the last call next() has not returned
  /// is lost; `bytes` must stay where they are until next() returns nullopt.
  void feed(Bytes bytes);
  /// A datagram: whole packets. A packet that it does not hold whole is skipped.
  void feed_datagram(Bytes bytes);
  /// The next packet, valid until next() or feed() is called; nullopt: all bytes are used.
  std::optional<Packet> next();

  const ParserCounts& counts() const { return counts_; }  ///< since the parser was made

 private:
  enum class Outcome { kPacket, kDropped, kGarbage, kIncomplete };
  struct Found {
    Outcome outcome = Outcome::kGarbage;
    std::size_t size = 1;
  };

  std::optional<Packet> next_in_input();
  std::optional<Packet> next_in_pending();
  /// Skips to the next packet of `bytes`, from `at` on. Incomplete: `at` is where it begins.
  Outcome scan(Bytes bytes, std::size_t& at, std::size_t& size, Packet& packet);
  Found look_at(Bytes bytes, Packet& packet);
  Found look_at_1(Bytes bytes, Packet& packet);
  Found look_at_2(Bytes bytes, Packet& packet);
  Found judge(Bytes bytes, std::uint16_t crc, std::size_t crc_at, std::size_t size, Packet& packet);

  bool accept_mavlink1_;
  bool is_datagram_ = false;
  Bytes input_;                                       // what next() has not looked at
  std::array<std::uint8_t, 2 * kMaxPacket> pending_;  // the beginning of a packet, and what follows
  std::size_t pending_size_ = 0;                      // bytes that are no longer in the input
  std::size_t used_ = 0;                              // of pending_ by the last packet returned
  ParserCounts counts_;
};

}  // namespace trident::bridges::mavlink
