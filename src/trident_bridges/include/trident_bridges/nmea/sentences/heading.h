// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences of compasses and gyros.
#pragma once

#include <optional>

#include "trident_bridges/nmea/sentences/position.h"

namespace trident::bridges::nmea {

/// Heading from true north.
struct Hdt {
  static constexpr const char* kType = "HDT";  ///< as in "$HEHDT"
  std::optional<double> heading_deg;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("heading", heading_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of heading", 'T');
  }
};

/// Heading from true north, and how it came about.
struct Ths {
  static constexpr const char* kType = "THS";  ///< as in "$HETHS"
  std::optional<double> heading_deg;
  char mode = '\0';  ///< autonomous, estimated, manual, simulator, not valid (V)

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("heading", heading_deg, kAngleLimits, kAngleFormat);
    ar.letter("mode", mode, "AEMSV");
  }
};

/// What a compass shows, its deviation and the variation of the place.
struct Hdg {
  static constexpr const char* kType = "HDG";  ///< as in "$HCHDG"
  std::optional<double> sensor_heading_deg;    ///< add deviation: magnetic; and variation: true
  std::optional<double> deviation_deg, variation_deg;  ///< east is positive

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("heading", sensor_heading_deg, kAngleLimits, kAngleFormat);
    ar.sided("deviation", deviation_deg, {0, 180}, {1, 1}, "EW");
    ar.sided("variation", variation_deg, {0, 180}, {1, 1}, "EW");
  }
};

/// Heading from magnetic north.
struct Hdm {
  static constexpr const char* kType = "HDM";  ///< as in "$HCHDM"
  std::optional<double> heading_deg;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("heading", heading_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of heading", 'M');
  }
};

/// Rate of turn.
struct Rot {
  static constexpr const char* kType = "ROT";  ///< as in "$TIROT"
  std::optional<double> rate_deg_min;          ///< to starboard is positive
  char status = '\0';                          ///< of kStatus

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("rate of turn", rate_deg_min, {-100'000, 100'000}, {2, 1});
    ar.letter("status", status, kStatus);
  }
};

}  // namespace trident::bridges::nmea
