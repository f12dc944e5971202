// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/timesync.h"

#include <algorithm>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

constexpr int kKept = 10;  // exchanges after which a longer round trip replaces a shorter one

/// Anything may stand in a packet: what is not between 0 and now is no answer to a request.
bool is_answer(const mavlink_timesync_t& payload, std::int64_t now_ns) {
  return payload.tc1 > 0 && payload.ts1 >= 0 && payload.ts1 <= now_ns;
}

}  // namespace

std::optional<Message> timesync_answer(const Message& message, Address self, std::int64_t now_ns) {
  if (!is<mavlink_timesync_t>(message)) return std::nullopt;
  auto payload = unpack<mavlink_timesync_t>(message);
  if (payload.tc1 != 0) return std::nullopt;
  // Simulated time begins at 0, and an answer with 0 would be a request: both ends would answer one
  // another without end.
  payload.tc1 = std::max(now_ns, std::int64_t{1});
  return pack(payload, self);
}

Message TimesyncClient::request(std::int64_t now_ns) const {
  mavlink_timesync_t payload{};
  payload.ts1 = now_ns;
  return pack(payload, self_);
}

void TimesyncClient::keep_if_best(const TimeOffset& found) {
  ++age_;
  if (best_ && found.round_trip_ns > best_->round_trip_ns && age_ < kKept) return;
  best_ = found;
  age_ = 0;
}

std::optional<TimeOffset> TimesyncClient::handle(const Message& message, std::int64_t now_ns) {
  if (!is<mavlink_timesync_t>(message)) return std::nullopt;
  const auto payload = unpack<mavlink_timesync_t>(message);
  if (!is_answer(payload, now_ns)) return std::nullopt;
  TimeOffset found;
  found.round_trip_ns = now_ns - payload.ts1;
  if (found.round_trip_ns > kMaxRoundTrip_ns) return std::nullopt;
  if (!has_one_clock_) found.offset_ns = payload.tc1 - (payload.ts1 + found.round_trip_ns / 2);
  keep_if_best(found);
  return found;
}

}  // namespace trident::bridges::mavlink
