// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "trident_base/config_types.h"
#include "trident_base/sim_time.h"
#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/ais/messages.h"
#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/sentences/ais_part.h"

namespace trident::bridges::nmea {

/// Classes of AIS stations.
enum class AisClass { kA, kB };

/// Names of the choices in parameters.
constexpr auto enum_names(AisClass /*tag*/) {
  return std::array{EnumName{AisClass::kA, "A"}, EnumName{AisClass::kB, "B"}};
}

/// What a vessel says about itself by AIS.
struct AisParams {
  std::uint32_t mmsi = 0;  ///< number of the station; 0: has no AIS
  AisClass vessel_class = AisClass::kA;
  std::string name;                              ///< up to 20 characters
  std::string call_sign;                         ///< up to 7
  std::string destination;                       ///< up to 20, of class A
  int imo = 0;                                   ///< number of the IMO; 0: has none
  int ship_type = 99;                            ///< 99: other
  int nav_status = 0;                            ///< 0: under power
  double to_bow_m = 0.0, to_stern_m = 0.0;       ///< from the antenna
  double to_port_m = 0.0, to_starboard_m = 0.0;  ///< from the antenna
  double draft_m = 0.0;                          ///< 0: is not sent
  double position_period_s = 0.0;                ///< 0: as the standard has it, by speed
  double static_period_s = 360.0;                ///< of name and size

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("mmsi", mmsi, Range{0, 999'999'999},
             "number of the station; 0: the vessel has no AIS");
    ar.field("class", vessel_class, "of the station: A sends messages 1 and 5, B 18 and 24");
    ar.field("name", name, "up to 20 characters");
    ar.field("call_sign", call_sign, "up to 7 characters");
    ar.field("destination", destination, "up to 20 characters, of class A");
    ar.field("imo", imo, Range{0, 999'999'999}, "number of the IMO, of class A; 0: has none");
    ar.field("ship_type", ship_type, Range{0, 99}, "0: not defined, 37: pleasure craft, 99: other");
    ar.field("nav_status", nav_status, Range{0, 15}, "0: under power, 1: at anchor, 5: moored");
    ar.field("to_bow", to_bow_m, Range{0.0, 511.0}, "from the antenna [m]");
    ar.field("to_stern", to_stern_m, Range{0.0, 511.0}, "[m]");
    ar.field("to_port", to_port_m, Range{0.0, 63.0}, "[m]");
    ar.field("to_starboard", to_starboard_m, Range{0.0, 63.0}, "[m]");
    ar.field("draft", draft_m, Range{0.0, 25.5}, "of class A; 0: is not sent [m]");
    ar.field("position_period", position_period_s, Range{0.0, 1e6},
             "between positions; 0: as ITU-R M.1371 has it, by speed [s]");
    ar.field("static_period", static_period_s, Range{1.0, 1e6}, "between descriptions [s]");
  }
};

/// What a vessel knows about its motion.
struct AisState {
  std::optional<double> latitude_deg, longitude_deg;
  bool is_accurate = false;                     ///< within 10 m
  std::optional<double> speed_m_s, course_rad;  ///< over ground, clockwise from true north
  std::optional<double> heading_rad;            ///< clockwise from true north
  std::optional<double> turn_rad_s;             ///< clockwise is positive
};

/// Takes the sentences of an AIS station.
class AisSink {
 public:
  virtual ~AisSink() = default;
  /// One sentence's worth of a message that the station sends.
  virtual void on_part(const AisPart& part, SimTime stamp) = 0;
};

/// A vessel's AIS station: positions as often as ITU-R M.1371-5, table 1, asks for at its speed,
/// and descriptions every six minutes. Time is simulated.
class AisTransmitter {
 public:
  /// `sink` outlives the transmitter.
  AisTransmitter(const AisParams& params, const UtcClock& clock, AisSink& sink)
      : params_(params), clock_(clock), sink_(sink) {}

  /// Sends what is due at `stamp`.
  void on_state(SimTime stamp, const AisState& state);

 private:
  double position_period_s(const AisState& state) const;
  void send_position(SimTime stamp, const AisState& state);
  void send_description(SimTime stamp);
  void send(SimTime stamp, const AisBits& bits);

  AisParams params_;
  UtcClock clock_;
  AisSink& sink_;
  std::optional<SimTime> last_position_, last_description_;
  int sequence_ = 0;      ///< of messages in several sentences
  bool is_on_b_ = false;  ///< channels take turns
};

}  // namespace trident::bridges::nmea
