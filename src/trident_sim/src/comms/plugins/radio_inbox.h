// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "trident_sim/comms/radio.h"

namespace trident::sim {

/// What a radio has received and nobody has asked for yet; the oldest goes when it is full.
class Inbox {
 public:
  /// Returns how many messages had to go.
  std::uint64_t add(RadioMessage message);
  /// Those that have come by then, oldest first.
  std::vector<RadioMessage> take(SimTime now);

 private:
  std::deque<RadioMessage> messages_;
  std::size_t bytes_ = 0;
};

}  // namespace trident::sim
