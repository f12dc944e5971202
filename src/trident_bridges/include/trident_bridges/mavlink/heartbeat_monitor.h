// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// The content of a HEARTBEAT.
struct Heartbeat {
  std::uint8_t type = 0;                                    ///< MAV_TYPE
  std::uint8_t autopilot = 0;                               ///< MAV_AUTOPILOT
  std::uint8_t base_mode = 0;                               ///< MAV_MODE_FLAG; 128: armed
  std::uint32_t custom_mode = 0;                            ///< by the autopilot
  std::uint8_t system_status = 0;                           ///< MAV_STATE
  bool is_ground_station() const { return type == 6; }      ///< MAV_TYPE_GCS
  bool is_armed() const { return (base_mode & 128) != 0; }  ///< MAV_MODE_FLAG_SAFETY_ARMED
};

/// nullopt: another message.
std::optional<Heartbeat> read_heartbeat(const Message& message);

/// The present, by both clocks. A vehicle's timeouts are those of simulated time; a client that
/// knows the wall's alone beats by that, so what counts is the smaller of both ages: a simulation
/// that is fast or pauses loses nobody.
struct BothTimes {
  SimTime simulated;            ///< of the world
  std::optional<SimTime> wall;  ///< monotonic; not given: simulated time alone counts
};

/// [s] since then: the smaller of both ages, where both are known.
double age_s(const BothTimes& then, const BothTimes& now);

/// Who is there, by HEARTBEAT.
class HeartbeatMonitor {
 public:
  /// `appeared` and `lost` may be empty.
  HeartbeatMonitor(double timeout_s, std::function<void(Address, const Heartbeat&)> appeared,
                   std::function<void(Address, double age_s)> lost);

  /// True when the message is a HEARTBEAT.
  bool handle(const Message& message, const BothTimes& now);
  /// Finds out who is lost.
  void update(const BothTimes& now);
  /// [s] since the last one of that sender; infinite: none was heard.
  double age_s(Address source, const BothTimes& now) const;
  /// [s] since the last one of any ground station; infinite: none was heard.
  double ground_station_age_s(const BothTimes& now) const;
  /// The last one of that sender, also of one that is lost; nullptr: none was heard.
  const Heartbeat* find(Address source) const;

 private:
  struct Heard {
    Heartbeat heartbeat;
    BothTimes when;
    bool is_there = true;
  };

  double timeout_s_;
  std::function<void(Address, const Heartbeat&)> appeared_;
  std::function<void(Address, double)> lost_;
  std::map<Address, Heard> heard_;
};

}  // namespace trident::bridges::mavlink
