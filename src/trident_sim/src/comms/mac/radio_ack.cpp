// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// How frames are acknowledged, and what their senders do then.
#include <algorithm>
#include <utility>

#include "comms/mac/radio_channel.h"
#include "comms/phy/vht.h"

namespace trident::sim {
namespace {

// More often than a frame is tried its acknowledgement is asked for: who waits for a gap between
// the frames of a hidden station would else give up, and begin again with a short wait.
constexpr int kRequestsPerTry = 3;
// Random numbers of an acknowledgement lie beyond those of the subframes of its frame.
constexpr std::uint32_t kAckChannel = 1000;

}  // namespace

void RadioChannel::send_ack(int number, std::uint64_t frame, LinkLosses& losses) {
  const auto known = answers_.find(frame);
  const Answer answer = known->second;
  answers_.erase(known);
  if (at(number).is_sending || !at(number).is_present) return;
  Transmission ack;
  ack.kind = Transmission::Kind::kAck;
  ack.source = number;
  ack.destination = answer.to;
  ack.mcs = vht::equal_mcs(vht::control_rate(answer.mcs));
  ack.frame = answer.frame;
  ack.end_ns = now_ns_ + vht::ack_duration_ns(answer.mcs, answer.subframes);
  begin(std::move(ack), losses);
}

void RadioChannel::end_ack(Transmission& frame) {
  RadioStation& waiting = at(frame.destination);
  const Reception* reception = frame.reception(frame.destination);
  if (reception == nullptr || !reception->is_locked || waiting.awaits == 0) return;
  const double success =
      reception->success(frame.mcs, vht::kBlockAckBytes, frame.begin_ns, frame.end_ns);
  RadioFlow& own = flow(frame.destination, frame.source);
  if (own.random.uniform(frame.frame, kAckChannel) < success) finish(frame.destination, true);
}

// Whether an A-MPDU has arrived is asked with a short frame, rather than sending it again: where
// stations do not hear each other, long frames would collide again and again. Who answers no
// request has gone.
void RadioChannel::miss_ack(int number) {
  RadioStation& source = at(number);
  if (!source.attempt || source.sent.size() < 2) return finish(number, false);
  if (source.requests >= kRequestsPerTry * source.params.tries) {
    for (const std::size_t i : source.sent) {
      source.attempt->subframes[i].tries = source.params.tries;
    }
    return finish(number, false);
  }
  ++source.requests;
  source.awaits = 0;
  source.window = std::min(2 * source.window + 1, vht::kMaxWindow);
  source.draw_backoff();
  source.idle_from_ns = std::max(source.idle_from_ns, now_ns_);
  contend(number);
}

// What a frame's sender knows now: which subframes to send again, which to give up.
void RadioChannel::finish(int number, bool is_acknowledged) {
  RadioStation& source = at(number);
  source.awaits = 0;
  source.requests = 0;
  if (!source.attempt) return;
  Attempt& attempt = *source.attempt;
  RadioFlow& own = flow(number, attempt.destination);
  std::size_t arrived = 0;
  for (const std::size_t i : source.sent) {
    Subframe& subframe = attempt.subframes[i];
    subframe.is_acknowledged = is_acknowledged && subframe.has_arrived;
    arrived += subframe.is_acknowledged ? 1 : 0;
    const bool is_given_up = !subframe.has_arrived && subframe.tries >= source.params.tries;
    if (is_given_up) ++own.counts.lost;
    subframe.is_settled |= is_given_up;
  }
  own.rate.report(source.sent_mcs, source.sent.size(), arrived);
  settle(number, own.counts.snr_db);
  auto& subframes = attempt.subframes;
  const auto is_done = [&](const Subframe& subframe) {
    if (!subframe.is_done(source.params.tries)) return false;
    source.queued_bytes[static_cast<std::size_t>(attempt.priority)] -= subframe.packet.bytes();
    return true;
  };
  subframes.erase(std::remove_if(subframes.begin(), subframes.end(), is_done), subframes.end());
  const bool resets_window = is_acknowledged || subframes.empty();
  source.window =
      resets_window ? vht::kMinWindow : std::min(2 * source.window + 1, vht::kMaxWindow);
  if (subframes.empty()) source.attempt.reset();
  source.draw_backoff();
  if (!is_acknowledged) source.idle_from_ns = std::max(source.idle_from_ns, now_ns_);
  contend(number);
}

}  // namespace trident::sim
