// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/receive/navsat_reader.h"

#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/nmea/units.h"

namespace trident::bridges::nmea {
namespace {

constexpr double kCourselessMs = 0.05;  ///< below which receivers leave the course empty
constexpr double kMinutesPerDegree = 60.0;

double squared(double value) { return value * value; }

}  // namespace

double NavsatReader::error_of(int quality) const {
  switch (quality) {
    case 1:
    case 3:  // encrypted signals: no worse than a single fix
      return params_.epe_quality1;
    case 2:
      return params_.epe_quality2;
    case 4:
      return params_.epe_quality4;
    case 5:
      return params_.epe_quality5;
    case 9:
      return params_.epe_quality9;
    default:
      return params_.epe_quality0;
  }
}

void NavsatReader::set_errors(const Gga& gga, NavsatFix* fix) const {
  const double epe = error_of(fix->quality);
  double east = epe, north = epe, up = 2.0 * epe, scale = gga.hdop.value_or(1.0);
  fix->errors = ErrorsKnown::kApproximately;
  if (errors_) {
    east = errors_->longitude_m.value_or(east);
    north = errors_->latitude_m.value_or(north);
    up = errors_->altitude_m.value_or(up);
    if (!params_.dop_scales_gst) {
      fix->errors = ErrorsKnown::kYes;
      fix->variance_m2 = {squared(east), squared(north), squared(up)};
      return;
    }
  }
  fix->variance_m2 = {squared(scale * east), squared(scale * north), squared(2.0 * scale * up)};
  if (fix->quality == 0) fix->errors = ErrorsKnown::kNo;
}

void NavsatReader::put_place(const std::optional<double>& latitude_deg,
                             const std::optional<double>& longitude_deg, NavsatFix* fix) const {
  if (!latitude_deg || !longitude_deg) return;
  fix->latitude_deg = *latitude_deg - offset_latitude_deg_;
  fix->longitude_deg = *longitude_deg - offset_longitude_deg_;
}

void NavsatReader::read(const Gga& gga, const Receipt& receipt) {
  has_fix_ = *gga.quality != Gga::kNoFix;
  if (params_.use_rmc) return;
  NavsatFix fix;
  fix.quality = *gga.quality;
  put_place(gga.latitude_deg, gga.longitude_deg, &fix);
  if (gga.altitude_m) fix.altitude_m = *gga.altitude_m + gga.geoid_separation_m.value_or(0.0);
  set_errors(gga, &fix);
  if (gga.time) fix.unix_ns = utc_.unix_ns(*gga.time, receipt);
  sink_.on_fix(fix);
  put_time(fix.unix_ns);
}

void NavsatReader::put_fix(const Rmc& rmc, const Receipt& receipt) {
  NavsatFix fix;
  fix.quality = rmc.status == 'A' ? Gga::kSingle : Gga::kNoFix;
  put_place(rmc.latitude_deg, rmc.longitude_deg, &fix);
  if (rmc.time) fix.unix_ns = utc_.unix_ns(*rmc.time, receipt);
  sink_.on_fix(fix);
  put_time(fix.unix_ns);
}

void NavsatReader::read(const Rmc& rmc, const Receipt& receipt) {
  if (rmc.date && rmc.time) utc_.set(*rmc.date, *rmc.time);
  const bool is_valid = rmc.status == 'A';
  if (params_.use_rmc) put_fix(rmc, receipt);
  if (!is_valid || !rmc.speed_knots) return;
  put_velocity(*rmc.speed_knots * kMetersPerSecondPerKnot, rmc.course_deg);
}

void NavsatReader::read(const Vtg& vtg, const Receipt& /*receipt*/) {
  if (params_.use_rmc || !has_fix_ || vtg.mode == 'N') return;
  if (vtg.speed_knots) {
    put_velocity(*vtg.speed_knots * kMetersPerSecondPerKnot, vtg.course_deg);
  } else if (vtg.speed_km_h) {
    put_velocity(*vtg.speed_km_h / kKilometersPerHour, vtg.course_deg);
  }
}

void NavsatReader::put_velocity(const std::optional<double>& speed_m_s,
                                const std::optional<double>& course_deg) {
  if (!course_deg && *speed_m_s > kCourselessMs) return;
  const double course = deg_to_rad(course_deg.value_or(0.0));
  sink_.on_velocity({*speed_m_s * std::sin(course), *speed_m_s * std::cos(course)});
}

void NavsatReader::read(const Gst& gst, const Receipt& /*receipt*/) { errors_ = gst; }

void NavsatReader::read(const Zda& zda, const Receipt& receipt) {
  const std::optional<CivilDate> date = zda.date();
  if (!date || !zda.time) return;
  utc_.set(*date, *zda.time);
  put_time(utc_.unix_ns(*zda.time, receipt));
}

void NavsatReader::read(const Dtm& dtm, const Receipt& /*receipt*/) {
  // Positions are those of the local datum, which lies by the offsets from the reference.
  offset_latitude_deg_ = dtm.latitude_offset_min.value_or(0.0) / kMinutesPerDegree;
  offset_longitude_deg_ = dtm.longitude_offset_min.value_or(0.0) / kMinutesPerDegree;
}

void NavsatReader::put_time(std::optional<std::int64_t> unix_ns) {
  if (!unix_ns || unix_ns == last_time_ns_) return;
  last_time_ns_ = unix_ns;
  sink_.on_time(*unix_ns);
}

}  // namespace trident::bridges::nmea
