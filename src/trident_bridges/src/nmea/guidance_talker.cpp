// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/send/guidance_talker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/angle.h"
#include "trident_bridges/nmea/units.h"

namespace trident::bridges::nmea {
namespace {

constexpr std::size_t kNamesPerSentence = 4;

double nautical_miles(double meters) { return meters / kMetersPerNauticalMile; }

char flag(bool is_so) { return is_so ? 'A' : 'V'; }

}  // namespace

void GuidanceTalker::set_route(std::vector<Waypoint> route) {
  route_ = std::move(route);
  next_ = 0;
  origin_.reset();
}

GuidanceTalker::Leg GuidanceTalker::find_leg(double east_m, double north_m,
                                             const GroundVelocity& velocity) const {
  const Waypoint& end = destination();
  const double leg_east = end.east_m - origin_->east_m, leg_north = end.north_m - origin_->north_m;
  const double to_east = end.east_m - east_m, to_north = end.north_m - north_m;
  Leg leg;
  leg.range_m = std::hypot(to_east, to_north);
  leg.bearing_to_end_rad = std::atan2(to_east, to_north);
  const bool is_point = std::hypot(leg_east, leg_north) < 1e-6;
  leg.bearing_rad = is_point ? leg.bearing_to_end_rad : std::atan2(leg_east, leg_north);
  const double s = std::sin(leg.bearing_rad), c = std::cos(leg.bearing_rad);
  leg.to_go_m = s * to_east + c * to_north;
  leg.off_track_m = s * to_north - c * to_east;
  if (leg.range_m > 0.0) {
    leg.closing_m_s = (to_east * velocity.east_m_s + to_north * velocity.north_m_s) / leg.range_m;
  }
  leg.has_arrived = leg.range_m <= params_.arrival_radius_m;
  leg.has_passed = leg.to_go_m <= 0.0;
  return leg;
}

void GuidanceTalker::on_position(SimTime stamp, double east_m, double north_m,
                                 const GroundVelocity& velocity) {
  if (route_.empty()) return;
  if (!origin_) {
    origin_ = Waypoint{};
    origin_->east_m = east_m;
    origin_->north_m = north_m;
  }
  Leg leg = find_leg(east_m, north_m, velocity);
  while ((leg.has_arrived || leg.has_passed) && next_ + 1 < route_.size()) {
    origin_ = route_[next_++];
    leg = find_leg(east_m, north_m, velocity);
  }
  send_steering(stamp, leg);
  send_destination(stamp, leg);
  send_route(stamp);
}

WaypointName GuidanceTalker::origin_name() const { return WaypointName(origin_->name); }

void GuidanceTalker::send_steering(SimTime stamp, const Leg& leg) {
  const std::string& talker = sender_.params().talkers.guidance;
  const CrossTrack cross_track{nautical_miles(leg.off_track_m)};
  const double track_deg = bearing_deg(leg.bearing_rad);
  const WaypointName end(destination().name);
  sender_.send_if_due<Apb>(talker, stamp, [&] {
    Apb apb;
    apb.status = apb.warning = 'A';
    apb.cross_track = cross_track;
    apb.arrived = flag(leg.has_arrived);
    apb.passed = flag(leg.has_passed);
    apb.bearing_from_origin_deg = track_deg;
    apb.destination = end;
    apb.bearing_deg = bearing_deg(leg.bearing_to_end_rad);
    apb.heading_deg =
        bearing_deg(leg.bearing_rad - std::atan2(leg.off_track_m, params_.lookahead_m));
    apb.bearing_from_origin_reference = apb.bearing_reference = apb.heading_reference = 'T';
    apb.mode = 'A';
    return apb;
  });
  sender_.send_if_due<Apa>(talker, stamp, [&] {
    Apa apa;
    apa.status = apa.warning = 'A';
    apa.cross_track = cross_track;
    apa.arrived = flag(leg.has_arrived);
    apa.passed = flag(leg.has_passed);
    apa.bearing_from_origin_deg = track_deg;
    apa.bearing_reference = 'T';
    apa.destination = end;
    return apa;
  });
  sender_.send_if_due<Xte>(talker, stamp, [&] { return Xte{'A', 'A', cross_track, 'A'}; });
}

void GuidanceTalker::send_destination(SimTime stamp, const Leg& leg) {
  const std::string& talker = sender_.params().talkers.guidance;
  const double variation = deg_to_rad(sender_.params().magnetic_variation_deg);
  const Waypoint& end = destination();
  sender_.send_if_due<Rmb>(talker, stamp, [&] {
    Rmb rmb;
    rmb.status = 'A';
    rmb.cross_track = {nautical_miles(leg.off_track_m)};
    rmb.origin = origin_name();
    rmb.destination = WaypointName(end.name);
    rmb.latitude_deg = end.latitude_deg;
    rmb.longitude_deg = end.longitude_deg;
    rmb.range_nm = nautical_miles(leg.range_m);
    rmb.bearing_deg = bearing_deg(leg.bearing_to_end_rad);
    rmb.closing_knots = leg.closing_m_s / kMetersPerSecondPerKnot;
    rmb.arrived = flag(leg.has_arrived || leg.has_passed);
    rmb.mode = 'A';
    return rmb;
  });
  sender_.send_if_due<Bod>(talker, stamp, [&] {
    return Bod{bearing_deg(leg.bearing_rad), bearing_deg(leg.bearing_rad - variation),
               WaypointName(end.name), origin_name()};
  });
  sender_.send_if_due<Bwc>(talker, stamp, [&] {
    const UtcTime utc = clock_.utc_at(stamp);
    Bwc bwc;
    bwc.time = TimeOfDay{utc.hour, utc.minute, utc.second + 1e-9 * utc.nanosecond};
    bwc.latitude_deg = end.latitude_deg;
    bwc.longitude_deg = end.longitude_deg;
    bwc.bearing_deg = bearing_deg(leg.bearing_to_end_rad);
    bwc.magnetic_bearing_deg = bearing_deg(leg.bearing_to_end_rad - variation);
    bwc.distance_nm = nautical_miles(leg.range_m);
    bwc.waypoint = WaypointName(end.name);
    bwc.mode = 'A';
    return bwc;
  });
}

void GuidanceTalker::send_route(SimTime stamp) {
  const std::string& talker = sender_.params().talkers.guidance;
  if (sender_.is_due<Wpl>(stamp)) {
    for (const Waypoint& place : route_) {
      sender_.send(talker, stamp,
                   Wpl{place.latitude_deg, place.longitude_deg, WaypointName(place.name)});
    }
  }
  if (!sender_.is_due<Rte>(stamp)) return;
  const std::size_t total = (route_.size() + kNamesPerSentence - 1) / kNamesPerSentence;
  for (std::size_t part = 0; part < total; ++part) {
    Rte rte;
    rte.total = static_cast<int>(total);
    rte.number = static_cast<int>(part) + 1;
    rte.mode = 'c';
    rte.route = "ROUTE";
    const std::size_t end = std::min(route_.size(), (part + 1) * kNamesPerSentence);
    for (std::size_t i = part * kNamesPerSentence; i < end; ++i) {
      rte.waypoints.push_back({WaypointName(route_[i].name)});
    }
    sender_.send(talker, stamp, rte);
  }
}

}  // namespace trident::bridges::nmea
