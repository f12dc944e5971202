// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// What sentences say, in SI units.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "trident_bridges/nmea/ais/target_table.h"
#include "trident_bridges/nmea/refusal.h"
#include "trident_bridges/nmea/sentence.h"

namespace trident::bridges::nmea {

/// When bytes came.
struct Receipt {
  double now_s = 0.0;                   ///< a clock that does not go back
  std::optional<std::int64_t> unix_ns;  ///< about what UTC it is; absent: not known
};

/// Whether a fix's errors are known.
enum class ErrorsKnown { kNo, kApproximately, kYes };

/// A fix of a satellite receiver.
struct NavsatFix {
  int quality = 0;  ///< of GGA; 1 where RMC alone is read
  double latitude_deg = std::numeric_limits<double>::quiet_NaN();   ///< NaN: there is no fix
  double longitude_deg = std::numeric_limits<double>::quiet_NaN();  ///< NaN: there is no fix
  double altitude_m = std::numeric_limits<double>::quiet_NaN();     ///< above the ellipsoid
  std::array<double, 3> variance_m2{};                              ///< east, north, up
  ErrorsKnown errors = ErrorsKnown::kNo;                            ///< of `variance_m2`
  std::optional<std::int64_t> unix_ns;  ///< when it was, absent: no date is known
};

/// Velocity over ground.
struct GroundVelocity {
  double east_m_s = 0.0, north_m_s = 0.0;
};

/// Velocity through the water, in the vessel's axes.
struct WaterVelocity {
  double ahead_m_s = 0.0;
  double port_m_s = 0.0;  ///< to the left
};

/// Of an echo sounder.
struct DepthReading {
  double depth_m = 0.0;  ///< below the transducer
  std::optional<double>
      offset_m;  ///< of the transducer: below the waterline, or (-) above the keel
  std::optional<double> max_range_m;  ///< of the scale in use
};

/// Wind by the bow.
struct WindEvent {
  bool is_true = false;  ///< over ground; else apparent
  double speed_m_s = 0.0;
  double angle_rad = 0.0;  ///< where it comes from, from the bow clockwise, [0, 2 pi)
};

/// Roll and pitch as REP-103 has them: starboard down and bow down are positive.
struct Tilt {
  std::optional<double> roll_rad, pitch_rad;
};

/// A number that has a name: of a transducer, a shaft, a rudder.
struct NamedNumber {
  std::string_view name;  ///< such as "rpm/shaft_1"; valid during the call
  double value = 0.0;     ///< SI, temperatures in degrees Celsius, shafts in 1/min
};

/// What an autopilot is to do.
struct SteeringEvent {
  std::optional<double> heading_rad;    ///< to steer, clockwise from true north
  std::optional<double> cross_track_m;  ///< right of the track is positive
};

/// A place of a route.
struct RoutePlace {
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

/// Takes what a Receiver refuses.
class ProblemSink {
 public:
  virtual ~ProblemSink() = default;
  /// Something is not used; `sentence` is what it stood in. Both are valid during the call.
  virtual void on_problem(const Refusal& refusal, const Sentence& sentence) = 0;
};

/// Takes what a Receiver reads; what is not overridden is ignored.
class ReceiverSink {
 public:
  virtual ~ReceiverSink() = default;
  virtual void on_fix(const NavsatFix& /*fix*/) {}                 ///< GGA, or RMC
  virtual void on_velocity(const GroundVelocity& /*velocity*/) {}  ///< RMC, VTG
  virtual void on_time(std::int64_t /*unix_ns*/) {}                ///< GGA, RMC, ZDA
  virtual void on_heading(double /*heading_rad*/) {}               ///< clockwise from true north
  virtual void on_turn_rate(double /*rad_s*/) {}  ///< counter-clockwise is positive
  virtual void on_tilt(const Tilt& /*tilt*/) {}   ///< XDR
  virtual void on_water_velocity(const WaterVelocity& /*velocity*/) {}  ///< VHW, VBW
  virtual void on_depth(const DepthReading& /*depth*/) {}               ///< DBT, DPT
  virtual void on_wind(const WindEvent& /*wind*/) {}                    ///< MWV, MWD, VWR, VWT
  virtual void on_number(const NamedNumber& /*number*/) {}              ///< XDR, MTW, RPM, RSA, VLW
  virtual void on_steering(const SteeringEvent& /*steering*/) {}        ///< APB, APA, RMB, XTE
  virtual void on_route(const std::vector<RoutePlace>& /*places*/) {}   ///< WPL and RTE
  /// VDM and VDO; `is_own`: of the vessel that sends the sentences.
  virtual void on_ais(const AisVessel& /*vessel*/, bool /*is_own*/) {}
};

}  // namespace trident::bridges::nmea
