// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Queues and contention; what happens on the air is in radio_air.cpp.
#include "comms/mac/radio_channel.h"

#include <algorithm>
#include <utility>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

// A probe of a faster mode need not carry more.
constexpr std::size_t kProbeSubframes = 4;

/// Of the n-th request for an acknowledgement [Mbit/s]: perhaps none is answered because the data's
/// mode has become too fast for the link.
int request_rate(int mcs, int n) {
  constexpr int kOfARate = 2;
  int rate = vht::control_rate(mcs);
  for (int k = kOfARate; k < n && rate > 6; k += kOfARate) rate /= 2;
  return rate;
}

std::size_t frame_bytes(const RadioPacket& packet) { return vht::kFrameBytes + packet.bytes(); }

/// How many of `subframes` one frame takes with that mode, at least one.
std::size_t fitting(const std::vector<Subframe>& subframes, const RadioParams& params,
                    const RateChoice& rate, std::size_t* bytes) {
  std::size_t most = params.max_ampdu_bytes == 0 ? 1 : vht::kMaxSubframes;
  if (rate.is_probe) most = std::min(most, kProbeSubframes);
  std::size_t count = 0;
  *bytes = 0;
  for (const Subframe& subframe : subframes) {
    if (subframe.is_acknowledged) continue;
    const std::size_t more = *bytes + vht::subframe_bytes(frame_bytes(subframe.packet));
    const bool is_long = vht::duration_ns(rate.mcs, params.width_mhz, params.has_short_guard,
                                          more) > vht::kMaxDuration_ns;
    if (count > 0 && (count == most || more > params.max_ampdu_bytes || is_long)) break;
    *bytes = more;
    ++count;
  }
  return count;
}

}  // namespace

int RadioChannel::add(const std::string& name, const RadioParams& params) {
  for (const RadioStation& known : stations_) {
    if (known.is_present && known.name == name) {
      throw Error("radio '" + name + "': there is one of that name already");
    }
  }
  stations_.emplace_back(name, params, seed_);
  stations_.back().idle_from_ns = now_ns_;
  return static_cast<int>(stations_.size()) - 1;
}

void RadioChannel::remove(int station) {
  RadioStation& gone = at(station);
  gone.is_present = false;
  // Numbers of stations stay, as events and frames on the air refer to them.
  gone.attempt.reset();
  for (auto& queue : gone.queues) queue.clear();
}

RadioFlow& RadioChannel::flow(int source, int destination) {
  RadioStation& from = at(source);
  const auto known = from.flows.find(destination);
  if (known != from.flows.end()) return known->second;
  const std::string to = destination == kEverybody ? "*" : at(destination).name;
  const std::string pair = "radio/" + from.name + "/" + to;
  return from.flows.emplace(destination, RadioFlow(seed_, pair, from.params)).first->second;
}

LinkCounts RadioChannel::counts(int source, int destination) const {
  const auto& flows = station(source).flows;
  const auto known = flows.find(destination);
  return known == flows.end() ? LinkCounts{} : known->second.counts;
}

int RadioChannel::mcs(int source, int destination) const {
  const RadioStation& from = station(source);
  if (from.params.mcs >= 0) return from.params.mcs;
  const auto known = from.flows.find(destination);
  return known == from.flows.end() ? 0 : known->second.rate.mcs();
}

void RadioChannel::note(std::uint64_t what) {
  // FNV-1a, a word at a time.
  digest_ = (digest_ ^ what) * 0x100000001B3ULL;
}

void RadioChannel::plan(std::int64_t time_ns, EventKind kind, int station, std::uint64_t key) {
  events_.push_back({time_ns, planned_++, kind, station, key});
  std::push_heap(events_.begin(), events_.end());
}

std::vector<RadioDelivery> RadioChannel::take_deliveries() {
  std::vector<RadioDelivery> result;
  std::swap(result, deliveries_);
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  return result;
}

// From the user to the queue it takes a random part of the processing, so that radios whose users
// send in the same step do not always collide.
bool RadioChannel::send(const RadioPacket& packet) {
  RadioStation& source = at(packet.source);
  LinkCounts& counts = flow(packet.source, packet.destination).counts;
  ++counts.sent;
  const auto priority = static_cast<std::size_t>(packet.priority);
  const bool is_full = source.queued_bytes[priority] + packet.bytes() > source.params.queue_bytes;
  if (is_full) {
    ++counts.refused;
    return false;
  }
  source.queued_bytes[priority] += packet.bytes();
  now_ns_ = std::max(now_ns_, packet.created_ns);
  RadioPacket kept = packet;
  kept.number = packets_++;
  constexpr std::uint32_t kChannel = 1;
  const double share = source.random.uniform(kept.number, kChannel);
  const auto before_ns =
      static_cast<std::int64_t>(share * static_cast<double>(source.params.processing_ns));
  kept.processing_ns = source.params.processing_ns - before_ns;
  // Packets of one user keep their order.
  source.arrival_ns = std::max(source.arrival_ns, packet.created_ns + before_ns);
  plan(source.arrival_ns, EventKind::kArrive, packet.source, kept.number);
  arriving_.emplace(kept.number, std::move(kept));
  return true;
}

void RadioChannel::advance(std::int64_t until_ns, LinkLosses& losses) {
  while (!events_.empty() && events_.front().time_ns <= until_ns) {
    std::pop_heap(events_.begin(), events_.end());
    const Event event = events_.back();
    events_.pop_back();
    now_ns_ = std::max(now_ns_, event.time_ns);
    happen(event, losses);
  }
  now_ns_ = std::max(now_ns_, until_ns);
}

void RadioChannel::happen(const Event& event, LinkLosses& losses) {
  switch (event.kind) {
    case EventKind::kArrive:
      return arrive(event.key);
    case EventKind::kAccess:
      // An access that was planned before its backoff was frozen has an old generation.
      if (event.key == at(event.station).generation) access(event.station, losses);
      return;
    case EventKind::kEnd:
      return end(event.key);
    case EventKind::kAck:
      return send_ack(event.station, event.key, losses);
    case EventKind::kTimeout:
      if (event.key == at(event.station).awaits) miss_ack(event.station);
      return;
  }
}

void RadioChannel::arrive(std::uint64_t number) {
  const auto packet = arriving_.find(number);
  const int source = packet->second.source;
  const auto priority = static_cast<std::size_t>(packet->second.priority);
  if (at(source).is_present) {
    drop_superseded(source, packet->second);
    at(source).queues[priority].push_back(std::move(packet->second));
  }
  arriving_.erase(packet);
  // Who finds the channel busy waits for a random time, as do all others that wait for its end.
  RadioStation& station = at(source);
  const bool is_waiting = station.access_ns != kNever_ns || station.attempt;
  const bool is_busy = station.busy > 0 || now_ns_ < station.contention_begin_ns();
  if (!is_waiting && is_busy && station.slots == 0) station.draw_backoff();
  contend(source);
}

void RadioChannel::contend(int number) {
  RadioStation& station = at(number);
  const bool is_held = station.busy > 0 || station.is_sending || station.awaits != 0;
  if (is_held || station.access_ns != kNever_ns || !station.has_work()) return;
  const std::int64_t due_ns = station.contention_begin_ns() + station.slots * vht::kSlot_ns;
  station.access_ns = std::max(now_ns_, due_ns);
  plan(station.access_ns, EventKind::kAccess, number, ++station.generation);
}

// A station that is due to send at this very moment does so: it has not heard the other yet.
void RadioChannel::set_busy(int number) {
  RadioStation& station = at(number);
  if (station.busy++ > 0 || station.access_ns == now_ns_) return;
  // A frozen backoff continues with the slots that are left (IEEE 802.11's DCF).
  station.hold_backoff(now_ns_);
  station.access_ns = kNever_ns;
  ++station.generation;
}

void RadioChannel::set_idle(int number) {
  RadioStation& station = at(number);
  if (--station.busy > 0) return;
  station.idle_from_ns = std::max(station.idle_from_ns, now_ns_);
  contend(number);
}

void RadioChannel::access(int number, LinkLosses& losses) {
  RadioStation& station = at(number);
  station.access_ns = kNever_ns;
  station.slots = 0;
  // Deadlines count when the channel is won: what waits in the queue may be too late by then.
  drop_expired(number);
  if (station.attempt && station.requests > 0) return begin(request_frame(number), losses);
  if (!prepare(number)) return;
  const bool is_broadcast = station.attempt->destination == kEverybody;
  begin(is_broadcast ? broadcast_frame(number) : unicast_frame(number), losses);
}

void RadioChannel::drop_expired(int number) {
  RadioStation& station = at(number);
  for (std::size_t priority = 0; priority < station.queues.size(); ++priority) {
    auto& queue = station.queues[priority];
    const auto is_late = [&](const RadioPacket& packet) {
      if (packet.deadline_ns >= now_ns_) return false;
      station.queued_bytes[priority] -= packet.bytes();
      ++flow(number, packet.destination).counts.expired;
      return true;
    };
    queue.erase(std::remove_if(queue.begin(), queue.end(), is_late), queue.end());
  }
}

/// A message of which a part has gone already is not dropped: a large one would never arrive.
void RadioChannel::drop_superseded(int number, const RadioPacket& newest) {
  const RadioHistory& history = newest.history;
  const auto depth = static_cast<std::uint64_t>(history.depth);
  if (depth == 0 || history.message < depth) return;
  RadioStation& station = at(number);
  const auto priority = static_cast<std::size_t>(newest.priority);
  auto& queue = station.queues[priority];
  const auto is_of_flow = [&newest](const RadioPacket& packet) {
    return packet.history.depth > 0 && packet.history.flow == newest.history.flow &&
           packet.destination == newest.destination;
  };
  const auto first = std::find_if(queue.begin(), queue.end(), is_of_flow);
  if (first == queue.end()) return;
  const bool has_begun = !first->history.is_begin;
  const std::uint64_t begun = first->history.message;
  const auto is_superseded = [&](const RadioPacket& packet) {
    const bool is_old = is_of_flow(packet) && packet.history.message + depth <= history.message;
    if (!is_old || (has_begun && packet.history.message == begun)) return false;
    station.queued_bytes[priority] -= packet.bytes();
    ++flow(number, packet.destination).counts.expired;
    return true;
  };
  queue.erase(std::remove_if(first, queue.end(), is_superseded), queue.end());
}

// What an attempt has no room for, or was not tried, stays in its queue.
bool RadioChannel::prepare(int number) {
  RadioStation& station = at(number);
  if (!station.attempt) {
    const auto queue = std::find_if(station.queues.begin(), station.queues.end(),
                                    [](const auto& q) { return !q.empty(); });
    if (queue == station.queues.end()) return false;
    station.attempt =
        Attempt{queue->front().destination, static_cast<int>(queue - station.queues.begin()), {}};
  }
  Attempt& attempt = *station.attempt;
  const bool is_alone = attempt.destination == kEverybody || station.params.max_ampdu_bytes == 0;
  const std::size_t most = is_alone ? 1 : vht::kMaxSubframes;
  auto& queue = station.queues[static_cast<std::size_t>(attempt.priority)];
  for (auto at = queue.begin(); at != queue.end() && attempt.subframes.size() < most;) {
    if (at->destination != attempt.destination) {
      ++at;
      continue;
    }
    attempt.subframes.push_back({std::move(*at)});
    at = queue.erase(at);
  }
  return true;
}

Transmission RadioChannel::broadcast_frame(int number) {
  RadioStation& station = at(number);
  RadioFlow& own = flow(number, kEverybody);
  const int rate = station.params.broadcast_mbit_s;
  Transmission frame;
  frame.source = number;
  frame.destination = kEverybody;
  frame.mcs = vht::equal_mcs(rate);
  frame.frame = own.counts.frames++;
  station.sent = {0};
  const RadioPacket& packet = station.attempt->subframes.front().packet;
  frame.end_ns = now_ns_ + vht::legacy_duration_ns(rate, frame_bytes(packet));
  own.counts.airtime_ns += frame.end_ns - now_ns_;
  return frame;
}

Transmission RadioChannel::request_frame(int number) {
  RadioStation& station = at(number);
  RadioFlow& own = flow(number, station.attempt->destination);
  const int rate = request_rate(mcs(number, station.attempt->destination), station.requests);
  Transmission frame;
  frame.kind = Transmission::Kind::kRequest;
  frame.source = number;
  frame.destination = station.attempt->destination;
  frame.mcs = vht::equal_mcs(rate);
  frame.subframes = station.sent.size();
  frame.frame = own.counts.frames++;
  frame.end_ns = now_ns_ + vht::legacy_duration_ns(rate, vht::kRequestBytes);
  own.counts.airtime_ns += frame.end_ns - now_ns_;
  return frame;
}

Transmission RadioChannel::unicast_frame(int number) {
  RadioStation& station = at(number);
  Attempt& attempt = *station.attempt;
  RadioFlow& own = flow(number, attempt.destination);
  const RadioParams& params = station.params;
  std::size_t bytes = 0;
  // Rate control wants to know the bytes before it chooses the mode that decides how many fit: they
  // are those of the fastest mode that all widths have.
  fitting(attempt.subframes, params, {vht::kModes - 2, false}, &bytes);
  const RateChoice rate = params.mcs >= 0 ? RateChoice{params.mcs, false} : own.rate.choose(bytes);
  const std::size_t count = fitting(attempt.subframes, params, rate, &bytes);
  station.sent.clear();
  for (std::size_t i = 0; station.sent.size() < count; ++i) {
    if (attempt.subframes[i].is_acknowledged) continue;
    station.sent.push_back(i);
    ++attempt.subframes[i].tries;
  }
  auto& queue = station.queues[static_cast<std::size_t>(attempt.priority)];
  // An attempt lasts until all of it has arrived or failed; what did not fit is no part of it.
  while (attempt.subframes.back().tries == 0) {
    queue.push_front(std::move(attempt.subframes.back().packet));
    attempt.subframes.pop_back();
  }
  station.sent_mcs = rate.mcs;
  Transmission frame;
  frame.source = number;
  frame.destination = attempt.destination;
  frame.mcs = rate.mcs;
  frame.subframes = count;
  frame.frame = own.counts.frames++;
  frame.end_ns =
      now_ns_ + vht::duration_ns(rate.mcs, params.width_mhz, params.has_short_guard, bytes);
  own.counts.airtime_ns += frame.end_ns - now_ns_;
  return frame;
}

}  // namespace trident::sim
