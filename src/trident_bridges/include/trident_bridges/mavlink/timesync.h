// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// What an exchange of TIMESYNC found.
struct TimeOffset {
  std::int64_t offset_ns = 0;      ///< of the partner's clock: its time minus ours
  std::int64_t round_trip_ns = 0;  ///< by our clock
};

/// The answer to a TIMESYNC of a partner; nullopt: nothing to answer. `now_ns`: our clock.
std::optional<Message> timesync_answer(const Message& message, Address self, std::int64_t now_ns);

/// Asks a partner for its time and keeps the offset with the shortest round trip of the last ten.
/// Where both clocks are the simulated one the offset is 0 and nothing is filtered.
class TimesyncClient {
 public:
  static constexpr std::int64_t kMaxRoundTrip_ns = 10'000'000'000;  ///< longer ones measure nothing

  /// `has_one_clock`: both ends have the same clock, such as simulated time.
  TimesyncClient(Address self, bool has_one_clock) : self_(self), has_one_clock_(has_one_clock) {}

  /// TIMESYNC that asks for the partner's time.
  Message request(std::int64_t now_ns) const;
  /// What an answer to a request of this end says; nullopt: another message, or an answer that came
  /// from the future or too late.
  std::optional<TimeOffset> handle(const Message& message, std::int64_t now_ns);
  /// The best offset so far.
  const std::optional<TimeOffset>& best() const { return best_; }

 private:
  void keep_if_best(const TimeOffset& found);

  Address self_;
  bool has_one_clock_;
  std::optional<TimeOffset> best_;
  int age_ = 0;  // exchanges since best_
};

}  // namespace trident::bridges::mavlink
