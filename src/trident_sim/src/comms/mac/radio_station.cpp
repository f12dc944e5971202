// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/mac/radio_station.h"

#include <algorithm>

namespace trident::sim {
namespace {

// After a frame that could not be read: the gap, an acknowledgement at 6 Mbit/s, and the usual wait
// (EIFS, IEEE 802.11-2016, 10.3.2.3.7).
const std::int64_t kEifs_ns =
    vht::kSifs_ns + vht::legacy_duration_ns(6, vht::kAckBytes) + vht::kAifs_ns;

}  // namespace

bool RadioStation::has_work() const {
  if (attempt) return true;
  return std::any_of(queues.begin(), queues.end(), [](const auto& q) { return !q.empty(); });
}

std::int64_t RadioStation::contention_begin_ns() const {
  return std::max(idle_from_ns + vht::kAifs_ns, damaged_ns + kEifs_ns);
}

void RadioStation::draw_backoff() {
  slots = static_cast<std::int64_t>(random.uniform(draws++, 0) * (window + 1));
}

// The end of the usual wait counts as a slot, as do all ends of free slots after it (EDCA, IEEE
// 802.11-2016, 10.22.2.4).
void RadioStation::hold_backoff(std::int64_t now_ns) {
  const std::int64_t free_ns = now_ns - contention_begin_ns();
  if (free_ns < 0) return;
  slots -= std::min(free_ns / vht::kSlot_ns + 1, slots);
}

}  // namespace trident::sim
