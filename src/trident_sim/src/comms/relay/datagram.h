// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// What relays send each other: a part of a message, or nothing but where the oldest part is that
/// is still offered (RFC 3758, FORWARD TSN).
struct PartDatagram {
  std::uint16_t rule = 0;    ///< index in the file, the same at both ends
  std::uint64_t number = 0;  ///< of a reliable flow: of the part; of the others: of the message
  std::uint64_t oldest = 0;  ///< of a reliable flow: what is before this was given up
  std::uint16_t part = 0;    ///< of its message, from 0
  std::uint16_t parts = 0;   ///< that its message has; 0: the datagram has no part
  SimTime born;              ///< time from which its message's age is counted
  std::string_view data;
};

/// What a receiver of a reliable flow has.
struct AckDatagram {
  std::uint16_t rule = 0;
  std::uint64_t next = 0;             ///< all parts before it have arrived, or were given up
  std::vector<std::uint64_t> beyond;  ///< parts behind it that have arrived
};

/// Bytes of a message in one datagram, at most.
constexpr std::size_t kPartBytes = 1400;

std::string encode(const PartDatagram& part);
std::string encode(const AckDatagram& ack);
/// Empty: the bytes are something else. `data` points into `bytes`.
std::optional<PartDatagram> decode_part(std::string_view bytes);
std::optional<AckDatagram> decode_ack(std::string_view bytes);

/// Into how many parts a message is cut; one without bytes is one, too.
std::size_t part_count(std::size_t bytes);

}  // namespace trident::sim
