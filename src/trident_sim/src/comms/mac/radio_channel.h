// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "comms/mac/radio_params.h"
#include "comms/mac/radio_station.h"
#include "comms/mac/transmission.h"

namespace trident::sim {

/// The air that radios share: carrier sense with backoff (DCF of IEEE 802.11, best effort),
/// collisions, hidden stations, A-MPDUs, acknowledgements, retries and rate control, event by event
/// in whole nanoseconds. Waves take no time from antenna to antenna.
///
/// A value: a copy continues as the original would. Whether a frame arrives is a pure function of
/// (seed, pair of names, number of the frame) and of what else is on the air then.
class RadioChannel {
 public:
  explicit RadioChannel(std::uint64_t seed) : seed_(seed) {}

  /// Returns the station's number, which is not given again. Throws Error when there is one of that
  /// name.
  int add(const std::string& name, const RadioParams& params);
  /// What it has in its queues is lost with it.
  void remove(int station);
  /// A station that is out neither hears nor is heard from its next frame on.
  void set_out(int station, bool is_out) { at(station).is_out = is_out; }

  /// Gives a packet to its source to send; false: the queue of its priority is full. The packet's
  /// time of creation is now.
  bool send(const RadioPacket& packet);
  /// Lets happen what happens until then, and at that time.
  void advance(std::int64_t until_ns, LinkLosses& losses);
  /// Whether nothing will happen until somebody sends.
  bool is_idle() const { return events_.empty(); }
  /// What has arrived since this was called last, by time.
  std::vector<RadioDelivery> take_deliveries();

  /// Removed ones included.
  std::size_t size() const { return stations_.size(); }
  const RadioStation& station(int number) const {
    return stations_[static_cast<std::size_t>(number)];
  }
  /// Zeros when nothing was ever sent.
  LinkCounts counts(int source, int destination) const;
  /// What a frame has now, but for probes of faster modes.
  int mcs(int source, int destination) const;
  /// All that has been decided so far, for hashes.
  std::uint64_t digest() const { return digest_; }

 private:
  enum class EventKind { kArrive, kAccess, kEnd, kAck, kTimeout };
  struct Event {
    std::int64_t time_ns;
    std::uint64_t order;  ///< of two at one time the one that was planned first
    EventKind kind;
    int station;
    std::uint64_t key;                          ///< of a packet, a contention, or a frame
    bool operator<(const Event& other) const {  // for a heap with the earliest on top
      return time_ns != other.time_ns ? time_ns > other.time_ns : order > other.order;
    }
  };
  struct Answer {
    int to, mcs;
    std::size_t subframes;
    std::uint64_t frame;
  };

  RadioStation& at(int number) { return stations_[static_cast<std::size_t>(number)]; }
  RadioFlow& flow(int source, int destination);
  Transmission* find(std::uint64_t id);
  void plan(std::int64_t time_ns, EventKind kind, int station, std::uint64_t key);
  void happen(const Event& event, LinkLosses& losses);
  void note(std::uint64_t what);

  // Queues and contention.
  void arrive(std::uint64_t number);
  void contend(int number);
  void access(int number, LinkLosses& losses);
  void drop_expired(int number);
  void drop_superseded(int number, const RadioPacket& newest);
  bool prepare(int number);
  Transmission unicast_frame(int number);
  Transmission broadcast_frame(int number);
  Transmission request_frame(int number);
  void set_busy(int number);
  void set_idle(int number);

  // A frame begins.
  void begin(Transmission frame, LinkLosses& losses);
  void hear(Transmission& frame, int listener, double loss_db);
  void listen(const Transmission& frame, Reception& reception);
  void stop_listening(int number);

  // A frame ends.
  void end(std::uint64_t id);
  void overhear(const Transmission& frame, const Reception& reception);
  void end_unicast(Transmission& frame);
  void end_broadcast(Transmission& frame);
  void end_ack(Transmission& frame);
  std::size_t receive(const Transmission& frame, const Reception& reception);
  void settle(int number, double snr_db);
  void deliver(const RadioPacket& packet, int receiver, double snr_db);
  void send_ack(int number, std::uint64_t frame, LinkLosses& losses);
  bool has_heard_request(const Transmission& frame, const Reception& reception);
  void miss_ack(int number);
  void finish(int number, bool is_acknowledged);

  std::uint64_t seed_;
  std::vector<RadioStation> stations_;
  std::vector<Event> events_;                      ///< a heap
  std::map<std::uint64_t, RadioPacket> arriving_;  ///< on their path from the user to the queue
  std::vector<Transmission> on_air_;
  std::map<std::uint64_t, Answer> answers_;  ///< to frames, that are about to be given
  std::vector<RadioDelivery> deliveries_;
  std::uint64_t planned_ = 0, frames_ = 0, packets_ = 0, digest_ = 0;
  std::int64_t now_ns_ = 0;
};

}  // namespace trident::sim
