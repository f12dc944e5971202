// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/relay/reliable_flow.h"

#include <algorithm>
#include <cstdlib>

namespace trident::sim {
namespace {

// Parts that await an answer at once, at most.
constexpr std::size_t kWindow = 64;
// An answer comes a step later at the earliest; a channel that is full takes tens of milliseconds.
constexpr SimTime kFirstTimeout{100'000'000}, kMinTimeout{20'000'000}, kMaxTimeout{500'000'000};

bool is_too_old(const RelayMessage& message, SimTime deadline, SimTime now) {
  return deadline.ns > 0 && now - message.born > deadline;
}

}  // namespace

void ReliableSender::add(const RelayMessage& message, std::uint64_t passed, RelayCounts* counts) {
  const std::size_t parts = part_count(message.data->size());
  for (std::size_t i = 0; i < parts; ++i) {
    Part part;
    part.message = message;
    part.part = static_cast<std::uint16_t>(i);
    part.parts = static_cast<std::uint16_t>(parts);
    parts_.push_back(std::move(part));
  }
  // As a publisher's queue: the oldest message makes room for the newest.
  if (++messages_ > depth_) give_up_front(passed, &counts->superseded);
}

/// A message that the receiver has passed is counted there: that is not known here yet.
void ReliableSender::give_up_front(std::uint64_t passed, std::uint64_t* count) {
  const Part& front = parts_.front();
  const std::uint64_t last = first_ + front.parts - 1U - front.part;
  if (last >= passed) ++*count;
  // A message is given up with all of its parts.
  do {
    parts_.pop_front();
    ++first_;
  } while (!parts_.empty() && parts_.front().part != 0);
  --messages_;
}

void ReliableSender::measure(SimTime round_trip) {
  // Smoothed round trip and its variation by RFC 6298, 2.2 and 2.3, with gains of 1/8 and 1/4.
  if (round_trip_.ns == 0) {
    round_trip_ = round_trip;
    variation_.ns = round_trip.ns / 2;
  } else {
    variation_.ns = (3 * variation_.ns + std::abs((round_trip_ - round_trip).ns)) / 4;
    round_trip_.ns = (7 * round_trip_.ns + round_trip.ns) / 8;
  }
}

// The time of what was sent twice says nothing: which one has arrived is not known (Karn).
void ReliableSender::note_arrival(Part* part, SimTime now) {
  if (part->is_acknowledged || part->tries == 0) return;
  part->is_acknowledged = true;
  newest_arrived_ = std::max(newest_arrived_, part->sent);
  if (part->tries == 1) measure(now - part->sent);
}

void ReliableSender::acknowledge(const AckDatagram& ack, SimTime now) {
  const std::uint64_t end = first_ + parts_.size();
  if (ack.next > end) return;  // of a flow before this one
  for (std::uint64_t number = first_; number < ack.next; ++number) {
    note_arrival(&parts_[number - first_], now);
  }
  for (const std::uint64_t number : ack.beyond) {
    if (number >= first_ && number < end) note_arrival(&parts_[number - first_], now);
  }
  if (ack.next > acknowledged_ || !ack.beyond.empty()) {
    // News from the receiver restart the timer; what was doubled by timeouts is forgotten.
    timeout_ = {std::max(round_trip_.ns + 4 * variation_.ns, kMinTimeout.ns)};
    timer_ = now;
  }
  acknowledged_ = std::max(acknowledged_, ack.next);
  // What is acknowledged beyond a gap stays until the gap is closed.
  while (!parts_.empty() && first_ < acknowledged_) {
    if (parts_.front().part + 1 == parts_.front().parts) --messages_;
    parts_.pop_front();
    ++first_;
  }
}

bool ReliableSender::is_lost(const Part& part, SimTime now) const {
  if (part.sent >= newest_arrived_) return false;
  // What overtakes by less than a quarter of the round trip may do so by chance.
  return now - part.sent > round_trip_ + SimTime{round_trip_.ns / 4};
}

/// What is lost, then what is new as far as the window goes; after a timeout the oldest that
/// nobody has acknowledged.
std::optional<std::size_t> ReliableSender::choose(SimTime now) {
  std::size_t unanswered = 0;
  std::optional<std::size_t> oldest, fresh;
  is_first_ = is_probe_ = false;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.is_acknowledged) continue;
    if (part.tries == 0) {
      fresh = i;
      break;
    }
    if (is_lost(part, now)) return i;
    if (!oldest) oldest = i;
    ++unanswered;
  }
  is_probe_ = unanswered > 0 && now - timer_ >= timeout_;
  if (is_probe_) return oldest;
  is_first_ = unanswered == 0;
  // The window bounds what is on the air, and four of
  // them what the receiver has to hold behind a gap.
  const bool has_room = fresh && unanswered < kWindow && *fresh < 4 * kWindow;
  return has_room ? fresh : std::nullopt;
}

PartDatagram ReliableSender::datagram(std::size_t index) const {
  const Part& part = parts_[index];
  PartDatagram result;
  result.rule = rule_;
  result.number = first_ + index;
  result.oldest = first_;
  result.part = part.part;
  result.parts = part.parts;
  result.born = part.message.born;
  result.data = std::string_view(*part.message.data).substr(part.part * kPartBytes, kPartBytes);
  return result;
}

std::optional<PartDatagram> ReliableSender::next(SimTime now, std::uint64_t passed,
                                                 RelayCounts* counts) {
  while (!parts_.empty() && is_too_old(parts_.front().message, deadline_, now)) {
    give_up_front(passed, &counts->expired);
  }
  if (timeout_.ns == 0) timeout_ = kFirstTimeout;
  is_skip_chosen_ = false;
  chosen_ = choose(now);
  if (chosen_) return datagram(*chosen_);
  // The receiver waits for what was given up: no other datagram says so.
  is_skip_chosen_ = acknowledged_ < first_ && now - timer_ >= timeout_;
  if (!is_skip_chosen_) return std::nullopt;
  PartDatagram skip;
  skip.rule = rule_;
  skip.number = skip.oldest = first_;
  return skip;
}

void ReliableSender::sent(SimTime now, RelayCounts* counts) {
  ++counts->datagrams;
  if (is_probe_ || is_skip_chosen_) {
    // Backoff by RFC 6298, 5.5.
    timeout_ = {std::min(2 * timeout_.ns, kMaxTimeout.ns)};
    timer_ = now;
  }
  if (!chosen_) return;
  Part& part = parts_[*chosen_];
  if (is_first_) timer_ = now;
  if (part.tries++ > 0) ++counts->resent;
  part.sent = now;
}

void ReliableReceiver::skip_to(std::uint64_t oldest) {
  if (oldest <= next_) return;
  next_ = oldest;
  begun_.clear();
  waiting_.erase(waiting_.begin(), waiting_.lower_bound(oldest));
}

void ReliableReceiver::take(const PartDatagram& part, SimTime now, std::uint64_t given_up,
                            std::vector<RelayMessage>* messages, RelayCounts* counts) {
  is_ack_due_ = true;
  skip_to(part.oldest);
  const bool is_there = part.number < next_ || waiting_.count(part.number) > 0;
  if (is_there && part.parts > 0) ++counts->doubles;
  if (!is_there && part.parts > 0) {
    waiting_.emplace(part.number, Part{part.part, part.parts, part.born, std::string(part.data)});
  }
  for (auto at = waiting_.begin(); at != waiting_.end() && at->first == next_;
       at = waiting_.erase(at), ++next_) {
    // A part before this message was given up, with what had come of that message.
    if (at->second.part == 0) begun_.clear();
    begun_ += at->second.data;
    if (at->second.part + 1 < at->second.parts) continue;
    RelayMessage message{at->second.born, std::make_shared<const std::string>(std::move(begun_))};
    begun_.clear();
    const bool was_given_up = next_ < given_up;
    if (is_too_old(message, deadline_, now)) {
      if (!was_given_up) ++counts->expired;
    } else {
      // It was on its path when a newer one took its place.
      if (was_given_up) --counts->superseded;
      messages->push_back(std::move(message));
    }
  }
}

std::optional<AckDatagram> ReliableReceiver::take_ack() {
  if (!is_ack_due_) return std::nullopt;
  is_ack_due_ = false;
  AckDatagram ack;
  ack.rule = rule_;
  ack.next = next_;
  for (const auto& [number, part] : waiting_) ack.beyond.push_back(number);
  return ack;
}

}  // namespace trident::sim
