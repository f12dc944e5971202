// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/receive/steering_reader.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/nmea/units.h"

namespace trident::bridges::nmea {
namespace {

bool is_usable(char status) { return status == 'A'; }

bool is_same(const std::vector<RoutePlace>& a, const std::vector<RoutePlace>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const RoutePlace& p, const RoutePlace& q) {
                      return p.latitude_deg == q.latitude_deg && p.longitude_deg == q.longitude_deg;
                    });
}

}  // namespace

std::optional<double> SteeringReader::true_deg(const std::optional<double>& bearing_deg,
                                               char reference) const {
  if (!bearing_deg || reference != 'M') return bearing_deg;
  return magnetic_.to_true_deg(*bearing_deg);
}

void SteeringReader::put(const CrossTrack& cross_track, std::optional<double> heading_deg) {
  SteeringEvent event;
  if (heading_deg) event.heading_rad = deg_to_rad(wrap_to_360(*heading_deg));
  if (cross_track.distance_nm) {
    event.cross_track_m = *cross_track.distance_nm * kMetersPerNauticalMile;
  }
  sink_.on_steering(event);
}

bool SteeringReader::is_silenced(const std::optional<double>& by_s, const Receipt& receipt) const {
  return by_s && receipt.now_s - *by_s <= params_.precedence_s;
}

void SteeringReader::read(const Apb& apb, const Receipt& receipt) {
  if (!is_usable(apb.status) || !is_usable(apb.warning)) return;
  apb_s_ = receipt.now_s;
  put(apb.cross_track, true_deg(apb.heading_deg, apb.heading_reference));
}

void SteeringReader::read(const Apa& apa, const Receipt& receipt) {
  if (!is_usable(apa.status) || !is_usable(apa.warning) || is_silenced(apb_s_, receipt)) return;
  const std::optional<double> track_deg =
      true_deg(apa.bearing_from_origin_deg, apa.bearing_reference);
  if (!track_deg || !apa.cross_track.distance_nm) return;
  apa_s_ = receipt.now_s;
  const double off_track_m = *apa.cross_track.distance_nm * kMetersPerNauticalMile;
  put(apa.cross_track, *track_deg - rad_to_deg(std::atan2(off_track_m, params_.lookahead_m)));
}

void SteeringReader::read(const Rmb& rmb, const Receipt& receipt) {
  if (!is_usable(rmb.status) || rmb.mode == 'N') return;
  if (is_silenced(apb_s_, receipt) || is_silenced(apa_s_, receipt)) return;
  if (rmb.bearing_deg) put(rmb.cross_track, rmb.bearing_deg);
}

void SteeringReader::read(const Xte& xte, const Receipt& /*receipt*/) {
  if (is_usable(xte.status) && is_usable(xte.warning)) put(xte.cross_track, std::nullopt);
}

void RouteReader::read(const Wpl& wpl, const Receipt& /*receipt*/) {
  const RoutePlace place{*wpl.latitude_deg, *wpl.longitude_deg};
  const auto known = places_.find(wpl.name.view());
  if (known != places_.end()) {
    known->second = place;
  } else if (places_.size() < kMaxPlaces) {
    places_.emplace(wpl.name.view(), place);
  }
  hand_on();
}

void RouteReader::begin_again() {
  coming_.clear();
  next_part_ = 1;
}

bool RouteReader::continues(const Rte& rte) const {
  return *rte.number == next_part_ && coming_.size() + rte.waypoints.size() <= kMaxEntries;
}

void RouteReader::read(const Rte& rte, const Receipt& /*receipt*/) {
  if (*rte.number == 1) begin_again();
  if (!continues(rte)) return begin_again();  // A part was lost: the next whole one counts.
  for (const RouteEntry& entry : rte.waypoints) {
    if (!entry.name.empty()) coming_.push_back(entry.name);
  }
  ++next_part_;
  if (*rte.number < *rte.total) return;
  route_ = coming_;
  begin_again();
  hand_on();
}

void RouteReader::hand_on() {
  if (route_.empty()) return;
  candidate_.clear();
  for (const WaypointName& name : route_) {
    const auto known = places_.find(name.view());
    if (known == places_.end()) return;
    candidate_.push_back(known->second);
  }
  if (is_same(candidate_, handed_on_)) return;
  handed_on_ = candidate_;
  sink_.on_route(handed_on_);
}

}  // namespace trident::bridges::nmea
