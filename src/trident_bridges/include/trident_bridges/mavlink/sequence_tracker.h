// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>

#include "trident_bridges/mavlink/packet.h"

namespace trident::bridges::mavlink {

/// What came of one sender.
struct SequenceCounts {
  std::uint64_t received = 0;   ///< packets
  std::uint64_t lost = 0;       ///< gaps in their numbers, less those that came late
  std::uint64_t reordered = 0;  ///< packets that came after a later one, or twice
  std::uint8_t next = 0;        ///< number that should come
};

/// Counts lost packets by the gaps in their numbers, per sender. A link that loses more than 127
/// packets in a row counts too few.
class SequenceTracker {
 public:
  /// A packet was received.
  void note(Address source, std::uint8_t sequence);
  /// Of all senders that were heard.
  const std::map<Address, SequenceCounts>& counts() const { return counts_; }

 private:
  std::map<Address, SequenceCounts> counts_;
};

}  // namespace trident::bridges::mavlink
