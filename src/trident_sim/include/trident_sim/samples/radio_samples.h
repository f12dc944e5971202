// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_sim/comms/radio.h"

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
  RadioLink link;  ///< at that moment, counts since the radios were reset
  /// Of what arrived since the last sample: mean and standard deviation of the time it took [s]
  /// (NaN: nothing arrived), bits per second.
  double latency_s = 0.0, jitter_s = 0.0, goodput_bit_s = 0.0;
  double airtime_share = 0.0;      ///< of the time since the last sample that its frames took
  std::vector<std::string> route;  ///< of what rules send from the source on, both ends included
};

/// A topic of another robot that has come by rules (trident_msgs/HeardTopic).
struct HeardTopicSample {
  std::string topic;           ///< below the robot's namespace: from/<source>/<topic>
  std::uint64_t messages = 0;  ///< since the radios were reset
};

/// Links of one moment (trident_msgs/LinkStatusArray).
struct LinkStatusArraySample {
  SimTime stamp;                        ///< of the state that was looked at
  std::vector<LinkStatusSample> links;  ///< by source, then destination
  std::vector<HeardTopicSample> heard;  ///< of one robot, by topic; of all robots' links empty
};

}  // namespace trident::sim
