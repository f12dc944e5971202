// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// A message of any type as the bytes that it is sent as; nobody looks into it.
struct BytesSample {
  SimTime stamp;  ///< of its header; zero: it has none
  /// nullptr: it was left out for max_rate (RelayReport::is_thinned()), and is only to be counted.
  std::shared_ptr<const std::string> data;
  std::string origin;       ///< of an output: name of the input that its messages come from
  bool is_latched = false;  ///< of an input: who comes later is to have the newest
};

/// When a message counts.
enum class StampUse {
  kNow,          ///< it has no stamp, or the world is past it
  kAtItsStamp,   ///< in the step that begins then
  kOfOtherClock  ///< now: its stamp is more than kFarAhead ahead, of no simulated time
};
constexpr SimTime kFarAhead{10'000'000'000};  ///< see StampUse

/// Of a message that is here in a step that begins at `now`.
inline StampUse stamp_use(SimTime stamp, SimTime now) {
  if (stamp <= now) return StampUse::kNow;
  return stamp - now > kFarAhead ? StampUse::kOfOtherClock : StampUse::kAtItsStamp;
}

}  // namespace trident::sim
