// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/sequence_tracker.h"

namespace trident::bridges::mavlink {
namespace {

/// A packet that is further behind than this is the first of a sender that was started again.
constexpr int kLateWindow = 32;

}  // namespace

void SequenceTracker::note(Address source, std::uint8_t sequence) {
  const auto [it, is_new] = counts_.try_emplace(source);
  SequenceCounts& counts = it->second;
  ++counts.received;
  const auto gap = static_cast<std::uint8_t>(sequence - counts.next);
  if (!is_new && gap >= 256 - kLateWindow) {
    ++counts.reordered;
    if (counts.lost > 0) --counts.lost;
    return;
  }
  if (!is_new && gap < 128) counts.lost += gap;
  counts.next = static_cast<std::uint8_t>(sequence + 1);
}

}  // namespace trident::bridges::mavlink
