// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <cstdint>

#include "comms/routing/hello.h"

namespace trident::sim {

/// Which of a neighbor's last hellos have arrived, by their numbers. A value.
///
/// The share is a mean over a window of 16, about 3 s at five hellos a second: its standard
/// deviation is 0.1 where 80 % arrive, and a change of the link is followed in that time. An
/// exponential mean of the same variance would keep a rest of what is older. While fewer than four
/// were sent the others count as lost, as one hello that came by luck does not make a link.
class HelloWindow {
 public:
  /// An old number begins again, as its sender does.
  void add(std::uint32_t number) {
    const bool is_next = number > last_ && number - last_ < kWindow;
    const std::size_t gap = is_next ? number - last_ : kWindow;
    const bool is_first = !is_next || sent_ == 0;
    arrived_ = is_first ? 0 : arrived_ << gap;
    arrived_.set(0);
    sent_ = is_first ? 1 : std::min(sent_ + gap, kWindow);
    last_ = number;
  }
  /// Of kHeardAll; 0 only before the first hello, as the last one has arrived.
  std::uint8_t share() const {
    const std::size_t sent = std::max(sent_, kMinSent);
    return static_cast<std::uint8_t>((arrived_.count() * kHeardAll + sent / 2) / sent);
  }
  std::uint32_t last() const { return last_; }

 private:
  static constexpr std::size_t kWindow = 16, kMinSent = 4;

  std::bitset<kWindow> arrived_;  ///< bit 0: the last one
  std::size_t sent_ = 0;          ///< of the window
  std::uint32_t last_ = 0;        ///< number
};

}  // namespace trident::sim
