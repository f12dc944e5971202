// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// A message of a robot's radio: to be sent (an input), or received (an output)
/// (trident_msgs/RadioPacket).
struct RadioPacketSample {
  SimTime stamp;              ///< when it was received; of one to be sent not looked at
  std::string source;         ///< name of the radio that has sent it
  std::string destination;    ///< name of a radio; "": all in reach
  std::string topic;          ///< of the user's
  std::uint8_t qos = 0;       ///< of the user's
  std::uint8_t priority = 1;  ///< 0 (first) to 3
  double deadline_s = 0.0;    ///< dropped when not sent after this time; 0: never
  std::uint64_t id = 0;       ///< of the user's
  std::string data;           ///< any bytes
};

/// How a link between two radios is (trident_msgs/LinkStatus).
struct LinkStatusSample {
  std::string source, destination;  ///< names of the radios
  double distance_m = 0.0;          ///< from antenna to antenna
  double rssi_dbm = 0.0;            ///< power at the receiver
  double snr_db = 0.0;              ///< signal over noise there
  int mcs = 0;                      ///< that frames have now
  double rate_bit_s = 0.0;          ///< of the data of such a frame
  double packet_error_rate = 0.0;   ///< of 1500 bytes at that rate, without interference
  /// Of what arrived since the last sample: mean and standard deviation of the time it took [s]
  /// (NaN: nothing arrived), bits per second.
  double latency_s = 0.0, jitter_s = 0.0, goodput_bit_s = 0.0;
  double queue_bytes = 0.0;    ///< that wait at the source
  double airtime_share = 0.0;  ///< of the time since the last sample that its frames took
  std::uint64_t sent = 0, delivered = 0;  ///< messages since the radios were reset
  /// Messages that did not arrive: no room in the queue, given up after all tries, too old.
  std::uint64_t dropped_queue = 0, dropped_air = 0, expired = 0;
  bool is_up = false;              ///< a short frame at the lowest rate arrives more often than not
  bool has_line_of_sight = false;  ///< nothing is in the path
  std::vector<std::string> route;  ///< of what rules send from the source on, both ends included
};

/// Links of one moment (trident_msgs/LinkStatusArray).
struct LinkStatusArraySample {
  SimTime stamp;                        ///< of the state that was looked at
  std::vector<LinkStatusSample> links;  ///< by source, then destination
};

}  // namespace trident::sim
