// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_bridges/nmea/receive/events.h"
#include "trident_bridges/nmea/receive/instrument_reader.h"
#include "trident_bridges/nmea/sentences/route.h"
#include "trident_bridges/nmea/sentences/steering.h"

namespace trident::bridges::nmea {

/// How autopilot sentences are followed.
struct SteeringParams {
  double lookahead_m = 20.0;  ///< to the point of the track that APA is steered to
  double precedence_s = 5.0;  ///< for which APB silences APA and RMB, and APA silences RMB

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("lookahead", lookahead_m, Range::positive(),
             "along the track to the point that APA is steered to [m]");
    ar.field("precedence", precedence_s, Range::non_negative(),
             "for which APB silences APA and RMB, and APA silences RMB [s]");
  }
};

/// Makes headings to steer of APB, APA and RMB, which route planners send together. APB says what
/// to steer. APA says the bearing of the track and how far off it the vessel is: it is steered
/// to a point of the track `lookahead` ahead (Fossen, "Handbook of Marine Craft Hydrodynamics and
/// Motion Control", 2011, eq. 10.73). RMB says where the destination is.
class SteeringReader {
 public:
  /// `magnetic` and `sink` outlive the reader.
  SteeringReader(const SteeringParams& params, const Magnetic& magnetic, ReceiverSink& sink)
      : params_(params), magnetic_(magnetic), sink_(sink) {}

  void read(const Apb& apb, const Receipt& receipt);  ///< heading to steer
  void read(const Apa& apa, const Receipt& receipt);  ///< along the track
  void read(const Rmb& rmb, const Receipt& receipt);  ///< to the destination
  void read(const Xte& xte, const Receipt& receipt);  ///< cross-track error alone

 private:
  std::optional<double> true_deg(const std::optional<double>& bearing_deg, char reference) const;
  void put(const CrossTrack& cross_track, std::optional<double> heading_deg);
  bool is_silenced(const std::optional<double>& by_s, const Receipt& receipt) const;

  SteeringParams params_;
  const Magnetic& magnetic_;
  ReceiverSink& sink_;
  std::optional<double> apb_s_, apa_s_;  ///< when the last usable ones came
};

/// Puts routes together from WPL and RTE, in whichever order they come. A route is handed on whole
/// when all of its places are known, and again only when something of it has changed.
class RouteReader {
 public:
  /// `sink` outlives the reader.
  explicit RouteReader(ReceiverSink& sink) : sink_(sink) {}

  void read(const Wpl& wpl, const Receipt& receipt);  ///< a place
  void read(const Rte& rte, const Receipt& receipt);  ///< a route, or a part of it

  static constexpr std::size_t kMaxPlaces = 2'000;   ///< that are kept, the first ones
  static constexpr std::size_t kMaxEntries = 2'000;  ///< of a route

 private:
  void begin_again();
  bool continues(const Rte& rte) const;
  void hand_on();

  ReceiverSink& sink_;
  std::map<std::string, RoutePlace, std::less<>> places_;
  std::vector<WaypointName> coming_;  ///< names of the parts that have come
  int next_part_ = 1;
  std::vector<WaypointName> route_;    ///< names of the whole one
  std::vector<RoutePlace> handed_on_;  ///< the last one
  std::vector<RoutePlace> candidate_;  ///< kept to save its memory
};

}  // namespace trident::bridges::nmea
