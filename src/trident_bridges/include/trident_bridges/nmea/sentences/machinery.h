// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences of transducers, engines and rudders.
#pragma once

#include <optional>

#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/sentences/position.h"

namespace trident::bridges::nmea {

/// What one transducer measures.
struct Measurement {
  static constexpr std::size_t kFields = 4;  ///< of a group
  char type = '\0';                          ///< angle A, temperature C, pressure P, ...
  std::optional<double> value;
  char unit = '\0';  ///< degrees D, Celsius C, bar B, pascal P, ...
  FixedText<16> name;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.letter("type", type, "ABCDEFGHILNPQRSTUVW");
    ar.real("value", value, {-1e9, 1e9}, {3, 1});
    ar.letter("unit", unit, "ABCDFHIKLMNPRSV");
    ar.text("name", name);
  }
};

/// Transducers.
struct Xdr {
  static constexpr const char* kType = "XDR";  ///< as in "$YXXDR"
  FixedList<Measurement, 15> measurements;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.groups("measurements", measurements);
  }
};

/// Speed of a shaft or an engine.
struct Rpm {
  static constexpr const char* kType = "RPM";  ///< as in "$ERRPM"
  char source = '\0';                          ///< shaft S, engine E
  std::optional<int> number;                   ///< 0: single, odd: starboard, even: port
  std::optional<double> speed_rpm;             ///< counter-clockwise is negative
  std::optional<double> pitch_percent;         ///< of the propeller; astern is negative
  char status = '\0';                          ///< of kStatus

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.letter("source", source, "SE");
    ar.whole("number", number, {0, 99});
    ar.real("speed", speed_rpm, {-1e6, 1e6}, {1, 1});
    ar.real("pitch", pitch_percent, {-100, 100}, {1, 1});
    ar.letter("status", status, kStatus);
  }
};

/// Angles of the rudders.
struct Rsa {
  static constexpr const char* kType = "RSA";  ///< as in "$ERRSA"
  std::optional<double> starboard_deg;         ///< or the only one; turns to starboard: positive
  char starboard_status = '\0';                ///< of kStatus
  std::optional<double> port_deg;
  char port_status = '\0';  ///< of kStatus

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("starboard rudder", starboard_deg, {-180, 180}, {2, 1});
    ar.letter("status of starboard rudder", starboard_status, kStatus);
    ar.real("port rudder", port_deg, {-180, 180}, {2, 1});
    ar.letter("status of port rudder", port_status, kStatus);
  }
};

}  // namespace trident::bridges::nmea
