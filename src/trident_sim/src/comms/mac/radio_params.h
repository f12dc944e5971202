// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "trident_sim/comms/radio.h"

namespace trident::sim {

/// What a radio is set to: IEEE 802.11ac with one antenna.
struct RadioParams {
  int channel = 36;                     ///< radios hear those of their own channel only
  int width_mhz = 20;                   ///< 20, 40 or 80
  double tx_power_dbm = 20.0;           ///< into the antenna
  double noise_figure_db = 7.0;         ///< of the receiver
  double carrier_sense_dbm = -82.0;     ///< what is stronger keeps the channel busy
  int mcs = -1;                         ///< 0 to 9; -1: adaptive
  bool has_short_guard = false;         ///< symbols of 3.6 us instead of 4
  std::size_t max_ampdu_bytes = 65535;  ///< 0: each frame alone
  int broadcast_mbit_s = 6;             ///< 6, 12 or 24
  int tries = 7;                        ///< before a packet is given up
  std::size_t queue_bytes = 1000000;    ///< of each priority
  std::int64_t processing_ns = 200000;  ///< from the air to the user
  bool is_base_station = false;         ///< routes rather lead over it
};

constexpr int kRadioPriorities = 4;  ///< 0 goes first
constexpr int kEverybody = -1;       ///< as a destination: a broadcast, which nobody acknowledges
constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

/// What is sent, with its addresses.
struct RadioPacket {
  std::uint64_t number = 0;                 ///< counts what the source was given to send
  int source = 0;                           ///< station
  int destination = kEverybody;             ///< station
  int priority = 1;                         ///< 0 to 3
  std::int64_t created_ns = 0;              ///< simulated time
  std::int64_t deadline_ns = kNever_ns;     ///< after which it is not worth sending
  std::int64_t processing_ns = 0;           ///< that is left for the receiver's end
  int port = 0;                             ///< of the receiver
  RadioHistory history;                     ///< that it is part of
  std::shared_ptr<const std::string> data;  ///< never nullptr

  std::size_t bytes() const { return data->size(); }
};

/// A packet that has arrived.
struct RadioDelivery {
  std::int64_t time_ns = 0;  ///< at which the receiver's user has it
  int receiver = 0;          ///< station
  double snr_db = 0.0;       ///< signal over noise, without others
  RadioPacket packet;
};

/// How strongly stations hear each other, antennas included.
class LinkLosses {
 public:
  virtual ~LinkLosses() = default;
  /// From one antenna's connector to the other's, the same both paths [dB]; infinite: not at all.
  virtual double loss_db(int a, int b) = 0;
};

}  // namespace trident::sim
