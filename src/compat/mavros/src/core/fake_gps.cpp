// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fake_gps.h"

#include <cmath>

#include "trident_base/utc_clock.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/whole_number.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::centimeters;
using bridges::mavlink::to_whole;

constexpr double kStanding_m_s = 0.01;  // slower than that has no course
constexpr double kEarlyFix = 0.99;      // of a period: stamps of a pose at twice the rate jitter

/// Clockwise from north [0.01 deg]; UINT16_MAX: not known.
std::uint16_t course_of(const Eigen::Vector3d& v_ned_m_s) {
  if (!(v_ned_m_s.head<2>().norm() >= kStanding_m_s)) return UINT16_MAX;
  return bridges::mavlink::centidegrees(std::atan2(v_ned_m_s.y(), v_ned_m_s.x()));
}

template <class Payload>
void write_common(const FakeFix& fix, const FakeGpsParams& params, Payload& to) {
  to.time_usec = fix.time_us;
  to.lat = bridges::mavlink::degrees_e7(fix.place.latitude_deg);
  to.lon = bridges::mavlink::degrees_e7(fix.place.longitude_deg);
  to.fix_type = static_cast<std::uint8_t>(params.fix_type);
  to.satellites_visible = static_cast<std::uint8_t>(params.satellites_visible);
}

/// A dilution of precision; 0: not known.
std::uint16_t centi_or_unknown(double value) {
  return value > 0.0 ? to_whole<std::uint16_t>(100.0 * value) : UINT16_MAX;
}

std::uint16_t ignored(const FakeFix& fix, const FakeGpsParams& params) {
  unsigned flags = 0;
  if (!(params.speed_accuracy > 0.0)) flags |= GPS_INPUT_IGNORE_FLAG_SPEED_ACCURACY;
  if (!(params.eph > 0.0)) flags |= GPS_INPUT_IGNORE_FLAG_HDOP;
  if (!(params.epv > 0.0)) flags |= GPS_INPUT_IGNORE_FLAG_VDOP;
  if (!fix.v_ned_m_s) flags |= GPS_INPUT_IGNORE_FLAG_VEL_HORIZ | GPS_INPUT_IGNORE_FLAG_VEL_VERT;
  return static_cast<std::uint16_t>(flags);
}

}  // namespace

FakeGps::FakeGps(const FakeGpsParams& params)
    : params_(params),
      map_({params.geo_origin.lat, params.geo_origin.lon, params.geo_origin.alt}) {}

std::optional<FakeFix> FakeGps::at(SimTime stamp, const Eigen::Vector3d& p_map_m) {
  if (before_ && stamp < before_->stamp) before_.reset();
  FakeFix fix;
  if (before_) {
    const double since_s = (stamp - before_->stamp).seconds();
    if (since_s * params_.gps_rate < kEarlyFix) return std::nullopt;
    fix.v_ned_m_s = bridges::mavlink::swap_world((p_map_m - before_->p_map_m) / since_s);
  }
  before_ = Before{stamp, p_map_m};
  fix.time_us = static_cast<std::uint64_t>(stamp.ns / 1000);
  fix.place = map_.to_geo(p_map_m);
  fix.horizontal_accuracy_m = params_.horiz_accuracy;
  fix.vertical_accuracy_m = params_.vert_accuracy;
  return fix;
}

mavlink_hil_gps_t hil_gps_payload(const FakeFix& fix, const FakeGpsParams& params,
                                  double geoid_separation_m) {
  mavlink_hil_gps_t payload{};
  write_common(fix, params, payload);
  const Eigen::Vector3d v = fix.v_ned_m_s.value_or(Eigen::Vector3d::Zero());
  payload.alt = bridges::mavlink::millimeters(fix.place.altitude_m - geoid_separation_m);
  payload.eph = centi_or_unknown(params.eph);
  payload.epv = centi_or_unknown(params.epv);
  payload.vel = fix.v_ned_m_s ? to_whole<std::uint16_t>(100.0 * v.head<2>().norm()) : UINT16_MAX;
  payload.vn = centimeters(v.x());
  payload.ve = centimeters(v.y());
  payload.vd = centimeters(v.z());
  payload.cog = course_of(v);
  return payload;
}

mavlink_gps_input_t gps_input_payload(const FakeFix& fix, const FakeGpsParams& params,
                                      double geoid_separation_m) {
  mavlink_gps_input_t payload{};
  write_common(fix, params, payload);
  const Eigen::Vector3d v = fix.v_ned_m_s.value_or(Eigen::Vector3d::Zero());
  const GpsTime time = gps_time_of(gps_ns_of(utc_of_unix(fix.unix_ns)));
  constexpr std::int64_t kPerMillisecond = 1'000'000;
  payload.gps_id = static_cast<std::uint8_t>(params.gps_id);
  payload.ignore_flags = ignored(fix, params);
  payload.time_week = static_cast<std::uint16_t>(time.week);
  payload.time_week_ms = static_cast<std::uint32_t>(time.time_of_week_ns / kPerMillisecond);
  payload.alt = static_cast<float>(fix.place.altitude_m - geoid_separation_m);
  payload.hdop = static_cast<float>(params.eph);
  payload.vdop = static_cast<float>(params.epv);
  payload.vn = static_cast<float>(v.x());
  payload.ve = static_cast<float>(v.y());
  payload.vd = static_cast<float>(v.z());
  payload.speed_accuracy = static_cast<float>(params.speed_accuracy);
  payload.horiz_accuracy = static_cast<float>(fix.horizontal_accuracy_m);
  payload.vert_accuracy = static_cast<float>(fix.vertical_accuracy_m);
  return payload;
}

}  // namespace trident::mavros
