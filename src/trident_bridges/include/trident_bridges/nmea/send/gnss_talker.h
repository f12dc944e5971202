// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "trident_base/sim_time.h"
#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/receive/events.h"
#include "trident_bridges/nmea/send/sentence_sender.h"

namespace trident::bridges::nmea {

/// What a satellite receiver knows at one instant.
struct GnssEpoch {
  /// Kinds of fixes, as in trident_msgs/GnssStatus.
  enum class Fix { kNone, kSingle, kFloat, kFixed };

  SimTime stamp;
  Fix fix = Fix::kNone;
  double latitude_deg = 0.0, longitude_deg = 0.0;             ///< of a fix
  double altitude_m = 0.0;                                    ///< above the ellipsoid
  double horizontal_stddev_m = 0.0, vertical_stddev_m = 0.0;  ///< one sigma, per axis
  std::optional<int> satellites;                              ///< in view
  std::optional<double> geoid_separation_m;                   ///< of the geoid above the ellipsoid
};

/// Sends GGA, GLL, RMC, VTG, ZDA, GSA, GSV, GST, GBS and DTM. Satellites have numbers, but no
/// places in the sky, as the simulation gives their number alone: HDOP and VDOP are those of so
/// many spread evenly over it. Where the height of the geoid is not known, its field is empty and
/// the altitude is above the ellipsoid.
class GnssTalker {
 public:
  /// `sender` outlives the talker.
  GnssTalker(SentenceSender& sender, const UtcClock& clock) : sender_(sender), clock_(clock) {}

  void set_velocity(const GroundVelocity& velocity) { velocity_ = velocity; }  ///< the newest
  void on_epoch(const GnssEpoch& epoch);  ///< sends what is due

 private:
  void send_position(const GnssEpoch& epoch);
  void send_velocity(const GnssEpoch& epoch);
  void send_satellites(const GnssEpoch& epoch);
  void send_errors(const GnssEpoch& epoch);

  SentenceSender& sender_;
  UtcClock clock_;
  std::optional<GroundVelocity> velocity_;
};

/// Joins fixes with the status messages of the same stamp, in whichever order they come.
class GnssJoin {
 public:
  /// A receiver's status.
  struct Status {
    SimTime stamp;
    GnssEpoch::Fix fix = GnssEpoch::Fix::kNone;
    double horizontal_stddev_m = 0.0, vertical_stddev_m = 0.0;
    int satellites = 0;
    std::optional<double> geoid_separation_m;
  };

  /// The epoch that is complete with this fix, or one before that has waited in vain.
  /// `awaits_status`: somebody sends status messages.
  std::optional<GnssEpoch> add_fix(const GnssEpoch& fix, bool awaits_status);
  /// The epoch that is complete with this status. One without a fix is complete alone.
  std::optional<GnssEpoch> add_status(const Status& status);

 private:
  static GnssEpoch joined(GnssEpoch fix, const Status& status);

  std::optional<GnssEpoch> waiting_;  ///< a fix without its status
  std::optional<Status> newest_;
};

}  // namespace trident::bridges::nmea
