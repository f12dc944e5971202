// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_base/sim_time.h"
#include "trident_base/span.h"
#include "trident_bridges/nmea/receive/events.h"
#include "trident_bridges/nmea/send/sentence_sender.h"

namespace trident::bridges::nmea {

/// How a vehicle lies and turns.
struct Attitude {
  double heading_rad = 0.0;          ///< clockwise from true north
  double roll_rad = 0.0;             ///< starboard down is positive
  double pitch_rad = 0.0;            ///< bow down is positive
  std::optional<double> turn_rad_s;  ///< counter-clockwise is positive
};

/// Sends HDT, THS, HDG, HDM, ROT, XDR, VHW, VBW, VLW, DBT, DPT, MTW, MWV, MWD, VWR, VWT, RPM and
/// RSA.
class InstrumentTalker {
 public:
  /// `sender` outlives the talker.
  explicit InstrumentTalker(SentenceSender& sender) : sender_(sender) {}

  void set_ground_velocity(const GroundVelocity& velocity) { ground_ = velocity; }  ///< the newest
  void on_attitude(SimTime stamp, const Attitude& attitude);  ///< HDT, THS, HDG, HDM, ROT, XDR
  void on_water_velocity(SimTime stamp, const WaterVelocity& velocity);  ///< VHW, VBW, VLW
  void on_depth(SimTime stamp, const DepthReading& depth);               ///< DBT, DPT
  void on_wind(SimTime stamp, const WindEvent& wind);                    ///< MWV, MWD, VWR, VWT
  void on_water_temperature(SimTime stamp, double celsius);              ///< MTW
  /// RPM of a single shaft, or of starboard and port ones in turn.
  void on_shafts(SimTime stamp, Span<const double> rpm);
  void on_rudder(SimTime stamp, double angle_rad);  ///< RSA; to starboard is positive

 private:
  std::optional<WindEvent> other_wind(const WindEvent& wind) const;
  void add_water_distance(SimTime stamp, const WaterVelocity& velocity);
  void send_wind(SimTime stamp, const WindEvent& apparent_or_true);

  SentenceSender& sender_;
  std::optional<Attitude> attitude_;      ///< the newest
  std::optional<GroundVelocity> ground_;  ///< the newest
  std::optional<SimTime> last_water_stamp_;
  double water_distance_m_ = 0.0;  ///< since the beginning
};

}  // namespace trident::bridges::nmea
