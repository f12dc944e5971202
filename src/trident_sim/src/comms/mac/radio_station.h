// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "comms/mac/radio_params.h"
#include "comms/mac/rate_control.h"
#include "trident_base/random_stream.h"

namespace trident::sim {

/// What became of the packets from one station to another, since the channel was reset.
struct LinkCounts {
  std::uint64_t sent = 0;                        ///< that the user has given
  std::uint64_t delivered = 0;                   ///< whole, each once
  std::uint64_t lost = 0;                        ///< given up after all tries
  std::uint64_t expired = 0;                     ///< too old before they could be sent
  std::uint64_t refused = 0;                     ///< the queue was full
  std::uint64_t bytes = 0;                       ///< of what was delivered
  std::uint64_t frames = 0;                      ///< on the air, of data and requests
  double delay_s = 0.0, squared_delay_s2 = 0.0;  ///< sums over what was delivered
  std::int64_t airtime_ns = 0;                   ///< of the data frames
  double snr_db = 0.0;                           ///< of the newest frame that was heard
};

/// From one station to another.
struct RadioFlow {
  RadioFlow(std::uint64_t seed, const std::string& pair, const RadioParams& params)
      : random(seed, pair), rate(params.width_mhz, params.has_short_guard) {}
  RandomStream random;
  RateControl rate;
  LinkCounts counts;
  std::int64_t delivered_ns = 0;  ///< time of the newest delivery, which none goes before
};

/// A packet that is being sent, alone or as a part of an A-MPDU.
struct Subframe {
  RadioPacket packet;
  int tries = 0;
  bool has_arrived = false;      ///< at the destination
  bool is_acknowledged = false;  ///< as the source knows
  bool is_settled = false;       ///< delivered, or given up
  bool is_done(int most_tries) const {
    return is_settled && (is_acknowledged || tries >= most_tries);
  }
};

/// Packets to one destination, until each of them is acknowledged or given up.
struct Attempt {
  int destination = kEverybody;
  int priority = 0;
  std::vector<Subframe> subframes;  ///< in the order in which they are to be delivered
};

/// A station's queues, and its part in the contention for the channel.
struct RadioStation {
  RadioStation(std::string station_name, const RadioParams& station_params, std::uint64_t seed)
      : name(std::move(station_name)), params(station_params), random(seed, "radio/" + name) {}

  std::string name;
  RadioParams params;
  RandomStream random;  ///< of the backoff
  bool is_present = true;
  bool is_out = false;  ///< neither hears nor is heard

  std::array<std::deque<RadioPacket>, kRadioPriorities> queues;
  std::array<std::size_t, kRadioPriorities> queued_bytes{};
  std::optional<Attempt> attempt;
  std::map<int, RadioFlow> flows;  ///< by destination

  int busy = 0;  ///< frames on the air that it hears, its own included
  bool is_sending = false;
  std::uint64_t awaits = 0;       ///< the frame that is to be acknowledged; 0: none
  int sent_mcs = 0;               ///< of the data that it was for
  int requests = 0;               ///< for the acknowledgement of an A-MPDU that has not come
  std::vector<std::size_t> sent;  ///< what of the attempt was in it
  std::uint64_t listens_to = 0;   ///< the frame that it receives; 0: none
  std::int64_t idle_from_ns = 0;  ///< when the channel became free, or will by what it has heard
  std::int64_t damaged_ns = -kNever_ns;  ///< end of a frame that could not be read
  int window = vht::kMinWindow;
  std::int64_t slots = 0;  ///< of the backoff that are left
  std::uint64_t draws = 0;
  std::int64_t arrival_ns = 0;         ///< of the newest packet in a queue
  std::uint64_t generation = 0;        ///< of the event that ends its contention or its waiting
  std::int64_t access_ns = kNever_ns;  ///< when that event is due

  bool has_work() const;
  /// When the backoff begins to count.
  std::int64_t contention_begin_ns() const;
  void draw_backoff();
  /// The channel has become busy: the backoff keeps what is left of it.
  void hold_backoff(std::int64_t now_ns);
};

}  // namespace trident::sim
