// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What happens on the air: frames begin, disturb each other, end and are received.
#include <algorithm>
#include <cmath>
#include <utility>

#include "comms/mac/radio_channel.h"
#include "comms/phy/packet_error.h"

namespace trident::sim {
namespace {

// What is weaker than the noise by so much neither is heard nor disturbs [dB].
constexpr double kNegligible_db = -20.0;
// Of signal to noise, and of signal to all other frames on the air, below which nobody notices that
// a frame begins [dB]. Noise is averaged away by a correlation with the preamble; frames have the
// same preamble, so that of two that begin at once both are lost (ns-3: 4 dB in all).
constexpr double kPreamble_db = -1.0, kPreambleOverOthers_db = 4.0;
// For so long a receiver looks whether a frame begins (aCCATime, IEEE 802.11-2016, table 17-21).
constexpr std::int64_t kDetection_ns = 4000;
// A frame's header is about as short as this, for those that only need to know how long it takes.
constexpr std::size_t kHeaderBytes = 100;

double mw_of_dbm(double dbm) { return std::pow(10.0, 0.1 * dbm); }

/// Whether a receiver that has nothing else to do notices that the frame begins.
bool stands_out(const Reception& reception) {
  static const double noise_ratio = mw_of_dbm(kPreamble_db);
  static const double others_ratio = mw_of_dbm(kPreambleOverOthers_db);
  return reception.signal_mw > noise_ratio * reception.noise_mw &&
         reception.signal_mw >= others_ratio * reception.interference_mw;
}

}  // namespace

Transmission* RadioChannel::find(std::uint64_t id) {
  const auto at = std::find_if(on_air_.begin(), on_air_.end(),
                               [id](const Transmission& frame) { return frame.id == id; });
  return at == on_air_.end() ? nullptr : &*at;
}

void RadioChannel::begin(Transmission frame, LinkLosses& losses) {
  RadioStation& source = at(frame.source);
  frame.id = ++frames_;
  frame.begin_ns = now_ns_;
  note(static_cast<std::uint64_t>(now_ns_));
  note(static_cast<std::uint64_t>(frame.source));
  // The source hears nothing while it sends; all others on its channel may.
  stop_listening(frame.source);
  set_busy(frame.source);
  source.is_sending = true;
  for (int j = 0; j < static_cast<int>(stations_.size()); ++j) {
    const RadioStation& other = at(j);
    const bool is_deaf = !other.is_present || other.is_out || source.is_out;
    if (j == frame.source || is_deaf || other.params.channel != source.params.channel) continue;
    hear(frame, j, losses.loss_db(frame.source, j));
  }
  plan(frame.end_ns, EventKind::kEnd, frame.source, frame.id);
  on_air_.push_back(std::move(frame));
}

// Half-duplex: who sends cannot receive.
void RadioChannel::stop_listening(int number) {
  RadioStation& station = at(number);
  if (Transmission* frame = find(station.listens_to)) frame->reception(number)->is_locked = false;
  station.listens_to = 0;
}

void RadioChannel::hear(Transmission& frame, int listener, double loss_db) {
  const RadioStation& station = at(listener);
  const double signal_dbm = at(frame.source).params.tx_power_dbm - loss_db;
  const double noise_dbm =
      noise_power_dbm(station.params.width_mhz, station.params.noise_figure_db);
  if (!(signal_dbm > noise_dbm + kNegligible_db)) return;
  Reception own;
  own.station = listener;
  own.signal_mw = mw_of_dbm(signal_dbm);
  own.noise_mw = mw_of_dbm(noise_dbm);
  own.is_audible = signal_dbm >= station.params.carrier_sense_dbm;
  for (Transmission& other : on_air_) {
    Reception* theirs = other.reception(listener);
    if (theirs == nullptr) continue;
    // A segment of constant interference ends with each frame that begins.
    theirs->cut(now_ns_);
    theirs->interference_mw += own.signal_mw;
    own.interference_mw += theirs->signal_mw;
  }
  listen(frame, own);
  own.is_audible |= own.is_locked;
  if (own.is_audible) set_busy(listener);
  frame.receptions.push_back(std::move(own));
}

// To the first frame that comes, of several at once to the one that stands out of the others.
void RadioChannel::listen(const Transmission& frame, Reception& reception) {
  RadioStation& station = at(reception.station);
  if (station.is_sending) return;
  if (Transmission* present = find(station.listens_to)) {
    Reception* theirs = present->reception(reception.station);
    if (now_ns_ - present->begin_ns >= kDetection_ns || stands_out(*theirs)) return;
    theirs->is_locked = false;
    station.listens_to = 0;
  }
  if (!stands_out(reception)) return;
  station.listens_to = frame.id;
  reception.is_locked = true;
}

void RadioChannel::end(std::uint64_t id) {
  const auto place = std::find_if(on_air_.begin(), on_air_.end(),
                                  [id](const Transmission& frame) { return frame.id == id; });
  Transmission frame = std::move(*place);
  on_air_.erase(place);
  for (Reception& own : frame.receptions) {
    own.cut(now_ns_);
    for (Transmission& other : on_air_) {
      Reception* theirs = other.reception(own.station);
      if (theirs == nullptr) continue;
      theirs->cut(now_ns_);
      // Rounding could leave a little less than nothing.
      theirs->interference_mw = std::max(theirs->interference_mw - own.signal_mw, 0.0);
    }
    if (own.is_locked) at(own.station).listens_to = 0;
    overhear(frame, own);
  }
  at(frame.source).is_sending = false;
  if (frame.kind == Transmission::Kind::kAck) {
    end_ack(frame);
  } else if (frame.destination == kEverybody) {
    end_broadcast(frame);
  } else {
    end_unicast(frame);
  }
  set_idle(frame.source);
  for (const Reception& own : frame.receptions) {
    if (own.is_audible) set_idle(own.station);
  }
}

// A station that can read a frame for another one leaves the channel to its acknowledgement (NAV);
// after one that it has noticed and could not read it waits for longer.
void RadioChannel::overhear(const Transmission& frame, const Reception& reception) {
  if (!reception.is_locked) return;
  RadioStation& station = at(reception.station);
  const bool is_read =
      reception.success(frame.mcs, kHeaderBytes, frame.begin_ns, frame.end_ns) > 0.5;
  station.damaged_ns = is_read ? -kNever_ns : now_ns_;
  const bool is_answered = frame.kind != Transmission::Kind::kAck &&
                           frame.destination != kEverybody &&
                           frame.destination != reception.station;
  if (!is_read || !is_answered) return;
  const std::int64_t free_ns =
      now_ns_ + vht::kSifs_ns + vht::ack_duration_ns(frame.mcs, frame.subframes);
  station.idle_from_ns = std::max(station.idle_from_ns, free_ns);
}

void RadioChannel::end_unicast(Transmission& frame) {
  RadioStation& source = at(frame.source);
  if (!source.attempt) return;
  const std::int64_t ack_ns = vht::ack_duration_ns(frame.mcs, frame.subframes);
  source.awaits = frame.id;
  // The source waits for an acknowledgement and one slot more.
  plan(now_ns_ + vht::kSifs_ns + ack_ns + vht::kSlot_ns, EventKind::kTimeout, frame.source,
       frame.id);
  const Reception* reception = frame.reception(frame.destination);
  if (reception == nullptr || !reception->is_locked) return;
  const bool is_request = frame.kind == Transmission::Kind::kRequest;
  const bool is_read =
      is_request ? has_heard_request(frame, *reception) : receive(frame, *reception) > 0;
  if (!is_read) return;
  answers_[frame.id] = {frame.source, frame.mcs, frame.subframes, frame.frame};
  plan(now_ns_ + vht::kSifs_ns, EventKind::kAck, frame.destination, frame.id);
}

bool RadioChannel::has_heard_request(const Transmission& frame, const Reception& reception) {
  const double success =
      reception.success(frame.mcs, vht::kRequestBytes, frame.begin_ns, frame.end_ns);
  return flow(frame.source, frame.destination).random.uniform(frame.frame, 0) < success;
}

// Returns how many subframes have arrived in this frame.
std::size_t RadioChannel::receive(const Transmission& frame, const Reception& reception) {
  RadioStation& source = at(frame.source);
  RadioFlow& own = flow(frame.source, frame.destination);
  const double snr_db = 10.0 * std::log10(reception.signal_mw / reception.noise_mw);
  own.counts.snr_db = snr_db;
  const auto count = static_cast<std::int64_t>(frame.subframes);
  const std::int64_t duration_ns = frame.end_ns - frame.begin_ns;
  std::size_t arrived = 0;
  for (std::int64_t k = 0; k < count; ++k) {
    Subframe& subframe = source.attempt->subframes[source.sent[static_cast<std::size_t>(k)]];
    const std::size_t bytes = vht::kFrameBytes + subframe.packet.bytes();
    const double success =
        reception.success(frame.mcs, bytes, frame.begin_ns + duration_ns * k / count,
                          frame.begin_ns + duration_ns * (k + 1) / count);
    // Drawn by frame and subframe of the flow: what others send changes the chance, not the number.
    if (own.random.uniform(frame.frame, static_cast<std::uint32_t>(k)) >= success) continue;
    subframe.has_arrived = true;
    ++arrived;
  }
  settle(frame.source, snr_db);
  return arrived;
}

// In their order: what has arrived waits for what is still tried before it.
void RadioChannel::settle(int number, double snr_db) {
  Attempt& attempt = *at(number).attempt;
  for (Subframe& subframe : attempt.subframes) {
    if (subframe.is_settled) continue;
    if (!subframe.has_arrived) return;
    subframe.is_settled = true;
    deliver(subframe.packet, attempt.destination, snr_db);
  }
}

void RadioChannel::deliver(const RadioPacket& packet, int receiver, double snr_db) {
  RadioFlow& own = flow(packet.source, packet.destination);
  const std::int64_t time_ns = std::max(now_ns_ + packet.processing_ns, own.delivered_ns);
  own.delivered_ns = time_ns;
  ++own.counts.delivered;
  own.counts.bytes += packet.bytes();
  const double delay_s = 1e-9 * static_cast<double>(time_ns - packet.created_ns);
  own.counts.delay_s += delay_s;
  own.counts.squared_delay_s2 += delay_s * delay_s;
  note(packet.number);
  note(static_cast<std::uint64_t>(time_ns));
  deliveries_.push_back({time_ns, receiver, snr_db, packet});
}

void RadioChannel::end_broadcast(Transmission& frame) {
  RadioStation& source = at(frame.source);
  if (!source.attempt) return;
  const RadioPacket packet = source.attempt->subframes.front().packet;
  RadioFlow& own = flow(frame.source, kEverybody);
  for (const Reception& reception : frame.receptions) {
    if (!reception.is_locked) continue;
    const double success = reception.success(frame.mcs, vht::kFrameBytes + packet.bytes(),
                                             frame.begin_ns, frame.end_ns);
    const auto channel = static_cast<std::uint32_t>(reception.station);
    if (own.random.uniform(frame.frame, channel) >= success) continue;
    own.counts.snr_db = 10.0 * std::log10(reception.signal_mw / reception.noise_mw);
    deliver(packet, reception.station, own.counts.snr_db);
  }
  source.queued_bytes[static_cast<std::size_t>(packet.priority)] -= packet.bytes();
  source.attempt.reset();
  source.draw_backoff();
}

}  // namespace trident::sim
