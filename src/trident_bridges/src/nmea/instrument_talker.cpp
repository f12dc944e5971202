// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/send/instrument_talker.h"

#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/nmea/units.h"

namespace trident::bridges::nmea {
namespace {

constexpr double kLongestGapS = 10.0;  ///< between samples of a speed that still make a distance

double knots(double m_s) { return m_s / kMetersPerSecondPerKnot; }

Measurement tilt(const char* name, double angle_rad) {
  Measurement measured;
  measured.type = 'A';
  measured.value = rad_to_deg(angle_rad);
  measured.unit = 'D';
  measured.name = name;
  return measured;
}

SidedWind sided(const WindEvent& wind) {
  SidedWind result;
  result.angle_deg = rad_to_deg(wrap_to_pi(wind.angle_rad));
  result.speed_knots = knots(wind.speed_m_s);
  result.speed_m_s = wind.speed_m_s;
  result.speed_km_h = wind.speed_m_s * kKilometersPerHour;
  return result;
}

template <class T>
T with_side(const WindEvent& wind) {
  T result;
  static_cast<SidedWind&>(result) = sided(wind);
  return result;
}

}  // namespace

void InstrumentTalker::on_attitude(SimTime stamp, const Attitude& attitude) {
  attitude_ = attitude;
  const TalkerParams& params = sender_.params();
  const std::string& talker = params.talkers.heading;
  const double heading_deg = bearing_deg(attitude.heading_rad);
  const double magnetic_deg =
      bearing_deg(attitude.heading_rad - deg_to_rad(params.magnetic_variation_deg));
  sender_.send_if_due<Hdt>(talker, stamp, [&] { return Hdt{heading_deg}; });
  sender_.send_if_due<Ths>(talker, stamp, [&] { return Ths{heading_deg, 'A'}; });
  sender_.send_if_due<Hdg>(talker, stamp, [&] {
    return Hdg{magnetic_deg, {}, params.magnetic_variation_deg};
  });
  sender_.send_if_due<Hdm>(talker, stamp, [&] { return Hdm{magnetic_deg}; });
  if (attitude.turn_rad_s) {
    sender_.send_if_due<Rot>(talker, stamp, [&] {
      return Rot{-rad_to_deg(*attitude.turn_rad_s) * kSecondsPerMinute, 'A'};
    });
  }
  sender_.send_if_due<Xdr>(params.talkers.transducers, stamp, [&] {
    Xdr xdr;
    xdr.measurements.push_back(tilt("ROLL", attitude.roll_rad));
    xdr.measurements.push_back(tilt("PTCH", -attitude.pitch_rad));  // there bow up is positive
    return xdr;
  });
}

void InstrumentTalker::add_water_distance(SimTime stamp, const WaterVelocity& velocity) {
  if (last_water_stamp_) {
    const double dt_s = (stamp - *last_water_stamp_).seconds();
    const double speed_m_s = std::hypot(velocity.ahead_m_s, velocity.port_m_s);
    if (dt_s > 0.0 && dt_s < kLongestGapS) water_distance_m_ += speed_m_s * dt_s;
  }
  last_water_stamp_ = stamp;
}

void InstrumentTalker::on_water_velocity(SimTime stamp, const WaterVelocity& velocity) {
  const std::string& talker = sender_.params().talkers.water;
  add_water_distance(stamp, velocity);
  sender_.send_if_due<Vhw>(talker, stamp, [&] {
    Vhw vhw;
    if (attitude_) vhw.heading_deg = bearing_deg(attitude_->heading_rad);
    vhw.speed_knots = knots(velocity.ahead_m_s);
    vhw.speed_km_h = velocity.ahead_m_s * kKilometersPerHour;
    return vhw;
  });
  sender_.send_if_due<Vbw>(talker, stamp, [&] {
    Vbw vbw;
    vbw.water_ahead_knots = knots(velocity.ahead_m_s);
    vbw.water_starboard_knots = -knots(velocity.port_m_s);
    vbw.water_status = 'A';
    vbw.ground_status = vbw.water_stern_status = vbw.ground_stern_status = 'V';
    if (!ground_ || !attitude_) return vbw;
    const double c = std::cos(attitude_->heading_rad), s = std::sin(attitude_->heading_rad);
    vbw.ground_ahead_knots = knots(s * ground_->east_m_s + c * ground_->north_m_s);
    vbw.ground_starboard_knots = knots(c * ground_->east_m_s - s * ground_->north_m_s);
    vbw.ground_status = 'A';
    return vbw;
  });
  sender_.send_if_due<Vlw>(talker, stamp, [&] {
    const double distance_nm = water_distance_m_ / kMetersPerNauticalMile;
    return Vlw{distance_nm, distance_nm, {}, {}};
  });
}

void InstrumentTalker::on_depth(SimTime stamp, const DepthReading& depth) {
  const std::string& talker = sender_.params().talkers.depth;
  sender_.send_if_due<Dbt>(talker, stamp, [&] {
    return Dbt{depth.depth_m * kFeetPerMeter, depth.depth_m, depth.depth_m * kFathomsPerMeter};
  });
  sender_.send_if_due<Dpt>(talker, stamp, [&] {
    return Dpt{depth.depth_m, depth.offset_m, depth.max_range_m};
  });
}

/// The true wind of an apparent one, and the other one round: the difference is the vessel's
/// velocity.
std::optional<WindEvent> InstrumentTalker::other_wind(const WindEvent& wind) const {
  if (!attitude_ || !ground_) return std::nullopt;
  // Where it comes from, in east and north.
  const double from = wind.angle_rad + attitude_->heading_rad;
  const double sign = wind.is_true ? 1.0 : -1.0;
  const double east = wind.speed_m_s * std::sin(from) + sign * ground_->east_m_s;
  const double north = wind.speed_m_s * std::cos(from) + sign * ground_->north_m_s;
  WindEvent other;
  other.is_true = !wind.is_true;
  other.speed_m_s = std::hypot(east, north);
  other.angle_rad = deg_to_rad(bearing_deg(std::atan2(east, north) - attitude_->heading_rad));
  return other;
}

void InstrumentTalker::send_wind(SimTime stamp, const WindEvent& wind) {
  const std::string& talker = sender_.params().talkers.wind;
  if (!wind.is_true) {
    sender_.send_if_due<Vwr>(talker, stamp, [&] { return with_side<Vwr>(wind); });
    return;
  }
  sender_.send_if_due<Vwt>(talker, stamp, [&] { return with_side<Vwt>(wind); });
  if (!attitude_) return;
  sender_.send_if_due<Mwd>(talker, stamp, [&] {
    const double from = wind.angle_rad + attitude_->heading_rad;
    const double variation = deg_to_rad(sender_.params().magnetic_variation_deg);
    return Mwd{bearing_deg(from), bearing_deg(from - variation), knots(wind.speed_m_s),
               wind.speed_m_s};
  });
}

void InstrumentTalker::on_wind(SimTime stamp, const WindEvent& wind) {
  const std::string& talker = sender_.params().talkers.wind;
  const std::optional<WindEvent> other = other_wind(wind);
  const bool is_due = sender_.is_due<Mwv>(stamp);
  for (const WindEvent* event : {&wind, other ? &*other : nullptr}) {
    if (event == nullptr) continue;
    if (is_due) {
      sender_.send(talker, stamp,
                   Mwv{rad_to_deg(event->angle_rad), event->is_true ? 'T' : 'R', event->speed_m_s,
                       'M', 'A'});
    }
    send_wind(stamp, *event);
  }
}

void InstrumentTalker::on_water_temperature(SimTime stamp, double celsius) {
  sender_.send_if_due<Mtw>(sender_.params().talkers.transducers, stamp,
                           [&] { return Mtw{celsius}; });
}

void InstrumentTalker::on_shafts(SimTime stamp, Span<const double> rpm) {
  if (!sender_.is_due<Rpm>(stamp)) return;
  // 0 is a single one, odd numbers are starboard, even ones port.
  int number = rpm.size() == 1 ? 0 : 1;
  for (const double value : rpm) {
    sender_.send(sender_.params().talkers.engine, stamp, Rpm{'S', number++, value, {}, 'A'});
  }
}

void InstrumentTalker::on_rudder(SimTime stamp, double angle_rad) {
  sender_.send_if_due<Rsa>(sender_.params().talkers.engine, stamp, [&] {
    return Rsa{rad_to_deg(angle_rad), 'A', {}, 'V'};
  });
}

}  // namespace trident::bridges::nmea
