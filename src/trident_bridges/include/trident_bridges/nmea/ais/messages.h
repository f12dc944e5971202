// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Messages of the automatic identification system (ITU-R M.1371-5, annex 8): positions and
/// descriptions of vessels of class A and B.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "trident_bridges/nmea/ais/six_bit.h"
#include "trident_bridges/nmea/fixed.h"

namespace trident::bridges::nmea {

inline constexpr double kAisDegree = 600'000.0;  ///< units of latitude and longitude in a degree
inline constexpr std::uint32_t kMaxMmsi = 999'999'999;

/// What all messages begin with.
struct AisHeader {
  std::uint32_t type = 0;    ///< of the message, 1 to 27
  std::uint32_t repeat = 0;  ///< how often it was relayed
  std::uint32_t mmsi = 0;    ///< number of the station, up to nine digits

  /// Lists the fields in their order, for reading and writing.
  template <class Archive>
  void visit(Archive& ar) {
    ar.whole(type, 6);
    ar.whole(repeat, 2);
    ar.whole(mmsi, 30);
  }
};

/// Where a station is and how it moves.
struct AisMotion {
  std::optional<double> speed_knots;  ///< over ground, up to 102.2
  bool is_accurate = false;           ///< within 10 m
  std::optional<double> longitude_deg, latitude_deg;
  std::optional<double> course_deg;   ///< over ground, from true north
  std::optional<double> heading_deg;  ///< from true north
  std::uint32_t second = kNoSecond;   ///< of UTC; 60 and more: not available

  static constexpr std::uint32_t kNoSecond = 60;  ///< of `second`

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real(speed_knots, 10, 10.0, 1'022, 1'023);
    ar.flag(is_accurate);
    ar.signed_real(longitude_deg, 28, kAisDegree, 180.0);
    ar.signed_real(latitude_deg, 27, kAisDegree, 90.0);
    ar.real(course_deg, 12, 10.0, 3'599, 3'600);
    ar.real(heading_deg, 9, 1.0, 359, 511);
    ar.whole(second, 6);
  }
};

/// Extent of a vessel about its antenna.
struct AisExtent {
  std::uint32_t to_bow_m = 0, to_stern_m = 0;       ///< up to 511
  std::uint32_t to_port_m = 0, to_starboard_m = 0;  ///< up to 63

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.whole(to_bow_m, 9);
    ar.whole(to_stern_m, 9);
    ar.whole(to_port_m, 6);
    ar.whole(to_starboard_m, 6);
  }
};

/// Messages 1, 2 and 3: position of a vessel of class A.
struct AisPosition {
  static constexpr std::size_t kMinBits = 137;  ///< with what is read of it
  AisHeader header{1, 0, 0};
  std::uint32_t status = 15;                ///< 0: using the engine ... 15: not defined
  std::optional<double> turn_rate_deg_min;  ///< to starboard is positive
  AisMotion motion;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    header.visit(ar);
    ar.whole(status, 4);
    ar.turn_rate(turn_rate_deg_min);
    motion.visit(ar);
    ar.skip(2 + 3 + 1 + 19);  // special maneuver, spare, RAIM, state of the radio
  }
};

/// Message 5: description of a vessel of class A and its voyage.
struct AisVoyage {
  static constexpr std::size_t kMinBits = 240;  ///< up to the type of the ship
  AisHeader header{5, 0, 0};
  std::uint32_t imo = 0;  ///< number of the International Maritime Organization; 0: has none
  FixedText<7> call_sign;
  FixedText<20> name;
  std::uint32_t ship_type = 0;  ///< 0: not defined
  AisExtent extent;
  std::uint32_t positioning = 1;                             ///< 1: GPS
  std::uint32_t month = 0, day = 0, hour = 24, minute = 60;  ///< of arrival; these: not available
  std::optional<double> draft_m;
  FixedText<20> destination;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    header.visit(ar);
    ar.skip(2);  // version
    ar.whole(imo, 30);
    ar.text(call_sign);
    ar.text(name);
    ar.whole(ship_type, 8);
    extent.visit(ar);
    ar.whole(positioning, 4);
    ar.whole(month, 4);
    ar.whole(day, 5);
    ar.whole(hour, 5);
    ar.whole(minute, 6);
    ar.real(draft_m, 8, 10.0, 255, 0);
    ar.text(destination);
    ar.skip(2);  // data terminal, spare
  }
};

/// Message 18: position of a vessel of class B.
struct AisClassBPosition {
  static constexpr std::size_t kMinBits = 139;  ///< with what is read of it
  AisHeader header{18, 0, 0};
  AisMotion motion;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    header.visit(ar);
    ar.skip(8);
    motion.visit(ar);
    ar.skip(2);
    bool is_carrier_sense = true;
    ar.flag(is_carrier_sense);
    ar.skip(1 + 1 + 1 + 1 + 1 + 1 + 20);  // what the radio is able to do, its state
  }
};

/// Message 24: description of a vessel of class B, in two parts.
struct AisDescription {
  static constexpr std::size_t kMinBits = 160;  ///< of part A
  AisHeader header{24, 0, 0};
  std::uint32_t part = 0;  ///< 0: A, the name; 1: B, the rest
  FixedText<20> name;
  std::uint32_t ship_type = 0;  ///< 0: not defined
  FixedText<7> vendor;
  FixedText<7> call_sign;
  AisExtent extent;

  /// Lists the fields of the part in their order.
  template <class Archive>
  void visit(Archive& ar) {
    header.visit(ar);
    ar.whole(part, 2);
    if (part == 0) {
      ar.text(name);
      ar.skip(8);
    } else {
      ar.whole(ship_type, 8);
      ar.text(vendor);
      ar.text(call_sign);
      extent.visit(ar);
      ar.skip(6);
    }
  }
};

/// The bits of a message.
template <class T>
AisBits to_bits(T message) {
  AisBits bits;
  BitWriter writer(bits);
  message.visit(writer);
  return bits;
}

/// A message from its bits; requires that they are of its type.
template <class T>
T from_bits(const AisBits& bits) {
  T message;
  BitReader reader(bits);
  message.visit(reader);
  return message;
}

}  // namespace trident::bridges::nmea
