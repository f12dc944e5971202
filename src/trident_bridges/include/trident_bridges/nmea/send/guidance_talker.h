// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_base/sim_time.h"
#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/receive/events.h"
#include "trident_bridges/nmea/send/sentence_sender.h"

namespace trident::bridges::nmea {

/// How a route is followed by the guidance that sends.
struct GuidanceParams {
  double arrival_radius_m = 5.0;  ///< of the circle about a waypoint in which it is reached
  double lookahead_m = 20.0;      ///< along the track to the point that is steered to

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("arrival_radius", arrival_radius_m, Range::positive(),
             "about a waypoint, in which it is reached [m]");
    ar.field("lookahead", lookahead_m, Range::positive(),
             "along the track to the point that is steered to [m]");
  }
};

/// A place of a route, on the earth and on a level map.
struct Waypoint {
  std::string name;  ///< such as "WP01"
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double east_m = 0.0, north_m = 0.0;  ///< on a map of the surroundings
};

/// Sends what a route planner sends to an autopilot while a vehicle follows a route: APB, APA, RMB,
/// XTE, BOD and BWC of the leg, WPL and RTE of the route. A waypoint is reached within its circle,
/// or past the perpendicular through it.
class GuidanceTalker {
 public:
  /// `sender` outlives the talker.
  GuidanceTalker(SentenceSender& sender, const UtcClock& clock, const GuidanceParams& params = {})
      : sender_(sender), clock_(clock), params_(params) {}

  /// A new route from the place where the vehicle is then. Empty: nothing is sent.
  void set_route(std::vector<Waypoint> route);
  /// Where the vehicle is on the map, and how it moves: sends what is due.
  void on_position(SimTime stamp, double east_m, double north_m, const GroundVelocity& velocity);

 private:
  /// Where the vehicle is with respect to the leg.
  struct Leg {
    double bearing_rad = 0.0;  ///< of the track
    double off_track_m = 0.0;  ///< right of it is positive
    double to_go_m = 0.0;      ///< along it
    double range_m = 0.0;      ///< to its end
    double bearing_to_end_rad = 0.0;
    double closing_m_s = 0.0;
    bool has_arrived = false, has_passed = false;
  };

  Leg find_leg(double east_m, double north_m, const GroundVelocity& velocity) const;
  void send_steering(SimTime stamp, const Leg& leg);
  void send_destination(SimTime stamp, const Leg& leg);
  void send_route(SimTime stamp);
  const Waypoint& destination() const { return route_[next_]; }
  WaypointName origin_name() const;

  SentenceSender& sender_;
  UtcClock clock_;
  GuidanceParams params_;
  std::vector<Waypoint> route_;
  std::size_t next_ = 0;            ///< index of the leg's end
  std::optional<Waypoint> origin_;  ///< of the leg; absent: the vehicle's place is not known yet
};

}  // namespace trident::bridges::nmea
