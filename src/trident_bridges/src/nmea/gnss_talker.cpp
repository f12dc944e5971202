// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/send/gnss_talker.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/nmea/units.h"

namespace trident::bridges::nmea {
namespace {

using Fix = GnssEpoch::Fix;

constexpr int kMaxSatellitesInUse = 12;  ///< that GSA has room for
constexpr double kStandstillMs = 0.02;   ///< below which a course means nothing

int quality_of(Fix fix) {
  constexpr std::array<int, 4> kQualities{Gga::kNoFix, Gga::kSingle, Gga::kRtkFloat,
                                          Gga::kRtkFixed};
  return kQualities[static_cast<std::size_t>(fix)];
}

char mode_of(Fix fix) { return "NAFR"[static_cast<std::size_t>(fix)]; }
char status_of(Fix fix) { return fix == Fix::kNone ? 'V' : 'A'; }

TimeOfDay time_of(const UtcTime& utc) {
  return {utc.hour, utc.minute, utc.second + 1e-9 * utc.nanosecond};
}

/// HDOP of satellites that are spread evenly over the sky: the directions' east components have the
/// mean square 1/3.
double hdop_of(int satellites) { return std::sqrt(6.0 / std::max(satellites, 1)); }
/// VDOP: the variance of their up components is 1/12, as the clock takes the mean.
double vdop_of(int satellites) { return std::sqrt(12.0 / std::max(satellites, 1)); }

double course_deg_of(const GroundVelocity& velocity) {
  return bearing_deg(std::atan2(velocity.east_m_s, velocity.north_m_s));
}

/// What RMC and VTG say of a velocity.
struct Motion {
  std::optional<double> speed_knots, course_deg;
};

Motion motion_of(const std::optional<GroundVelocity>& velocity) {
  if (!velocity) return {};
  const double speed_m_s = std::hypot(velocity->east_m_s, velocity->north_m_s);
  Motion motion;
  motion.speed_knots = speed_m_s / kMetersPerSecondPerKnot;
  if (speed_m_s > kStandstillMs) motion.course_deg = course_deg_of(*velocity);
  return motion;
}

std::optional<double> magnetic_of(const std::optional<double>& true_deg, double variation_deg) {
  if (!true_deg) return std::nullopt;
  return wrap_to_360(*true_deg - variation_deg);
}

/// Puts the place of a fix into a sentence.
template <class T>
void put_place(const GnssEpoch& epoch, T* sentence) {
  if (epoch.fix == Fix::kNone) return;
  sentence->latitude_deg = epoch.latitude_deg;
  sentence->longitude_deg = epoch.longitude_deg;
}

Gsa satellites_in_use(const GnssEpoch& epoch, int count) {
  Gsa gsa;
  gsa.selection = 'A';
  gsa.dimensions = epoch.fix == Fix::kNone ? 1 : 3;
  gsa.system = '1';
  if (epoch.fix == Fix::kNone) return gsa;
  for (int i = 0; i < std::min(count, kMaxSatellitesInUse); ++i) {
    gsa.satellites[static_cast<std::size_t>(i)] = i + 1;
  }
  const int in_use = epoch.satellites.value_or(kMaxSatellitesInUse);
  gsa.hdop = hdop_of(in_use);
  gsa.vdop = vdop_of(in_use);
  gsa.pdop = std::hypot(*gsa.hdop, *gsa.vdop);
  return gsa;
}

/// The `number`th sentence of those that name `count` satellites, four each.
Gsv satellites_in_view(int number, int count) {
  Gsv gsv;
  gsv.number = number;
  gsv.in_view = count;
  for (int i = 4 * (number - 1); i < std::min(count, 4 * number); ++i) {
    SatelliteInView satellite;
    satellite.number = i + 1;
    gsv.satellites.push_back(satellite);
  }
  gsv.signal = '1';
  return gsv;
}

}  // namespace

void GnssTalker::on_epoch(const GnssEpoch& epoch) {
  send_position(epoch);
  send_velocity(epoch);
  send_satellites(epoch);
  send_errors(epoch);
}

void GnssTalker::send_position(const GnssEpoch& epoch) {
  const UtcTime utc = clock_.utc_at(epoch.stamp);
  const std::string& talker = sender_.params().talkers.gnss;
  sender_.send_if_due<Gga>(talker, epoch.stamp, [&] {
    Gga gga;
    gga.time = time_of(utc);
    put_place(epoch, &gga);
    gga.quality = quality_of(epoch.fix);
    if (epoch.satellites) gga.satellites = std::min(*epoch.satellites, 99);
    if (epoch.fix == Fix::kNone) return gga;
    gga.hdop = hdop_of(epoch.satellites.value_or(kMaxSatellitesInUse));
    gga.altitude_m = epoch.altitude_m - epoch.geoid_separation_m.value_or(0.0);
    gga.geoid_separation_m = epoch.geoid_separation_m;
    return gga;
  });
  sender_.send_if_due<Gll>(talker, epoch.stamp, [&] {
    Gll gll;
    put_place(epoch, &gll);
    gll.time = time_of(utc);
    gll.status = status_of(epoch.fix);
    gll.mode = mode_of(epoch.fix);
    return gll;
  });
  sender_.send_if_due<Zda>(talker, epoch.stamp, [&] {
    Zda zda;
    zda.time = time_of(utc);
    zda.day = utc.date.day;
    zda.month = utc.date.month;
    zda.year = utc.date.year;
    zda.zone_hours = zda.zone_minutes = 0;
    return zda;
  });
}

void GnssTalker::send_velocity(const GnssEpoch& epoch) {
  const std::string& talker = sender_.params().talkers.gnss;
  const double variation_deg = sender_.params().magnetic_variation_deg;
  const Motion motion = epoch.fix == Fix::kNone ? Motion{} : motion_of(velocity_);
  sender_.send_if_due<Rmc>(talker, epoch.stamp, [&] {
    const UtcTime utc = clock_.utc_at(epoch.stamp);
    Rmc rmc;
    rmc.time = time_of(utc);
    rmc.date = utc.date;
    rmc.status = status_of(epoch.fix);
    put_place(epoch, &rmc);
    rmc.speed_knots = motion.speed_knots;
    rmc.course_deg = motion.course_deg;
    if (variation_deg != 0.0) rmc.variation_deg = variation_deg;
    rmc.mode = mode_of(epoch.fix);
    rmc.navigation = epoch.fix == Fix::kNone ? 'V' : 'S';
    return rmc;
  });
  sender_.send_if_due<Vtg>(talker, epoch.stamp, [&] {
    Vtg vtg;
    vtg.course_deg = motion.course_deg;
    if (variation_deg != 0.0) {
      vtg.magnetic_course_deg = magnetic_of(motion.course_deg, variation_deg);
    }
    vtg.speed_knots = motion.speed_knots;
    if (motion.speed_knots) {
      vtg.speed_km_h = *motion.speed_knots * kMetersPerSecondPerKnot * kKilometersPerHour;
    }
    vtg.mode = mode_of(epoch.fix);
    return vtg;
  });
}

void GnssTalker::send_satellites(const GnssEpoch& epoch) {
  const std::string& talker = sender_.params().talkers.gnss;
  const int count = std::clamp(epoch.satellites.value_or(0), 0, 99);
  sender_.send_if_due<Gsa>(talker, epoch.stamp, [&] { return satellites_in_use(epoch, count); });
  if (!sender_.is_due<Gsv>(epoch.stamp)) return;
  const int sentences = std::max(1, (count + 3) / 4);
  for (int number = 1; number <= sentences; ++number) {
    Gsv gsv = satellites_in_view(number, count);
    gsv.total = sentences;
    sender_.send(talker, epoch.stamp, gsv);
  }
}

void GnssTalker::send_errors(const GnssEpoch& epoch) {
  const std::string& talker = sender_.params().talkers.gnss;
  const TimeOfDay time = time_of(clock_.utc_at(epoch.stamp));
  if (epoch.fix != Fix::kNone) {
    sender_.send_if_due<Gst>(talker, epoch.stamp, [&] {
      Gst gst;
      gst.time = time;
      gst.range_rms_m =
          epoch.horizontal_stddev_m / hdop_of(epoch.satellites.value_or(kMaxSatellitesInUse));
      gst.major_m = gst.minor_m = epoch.horizontal_stddev_m;
      gst.orientation_deg = 0.0;
      gst.latitude_m = gst.longitude_m = epoch.horizontal_stddev_m;
      gst.altitude_m = epoch.vertical_stddev_m;
      return gst;
    });
    sender_.send_if_due<Gbs>(talker, epoch.stamp, [&] {
      Gbs gbs;
      gbs.time = time;
      gbs.latitude_m = gbs.longitude_m = epoch.horizontal_stddev_m;
      gbs.altitude_m = epoch.vertical_stddev_m;
      return gbs;
    });
  }
  sender_.send_if_due<Dtm>(talker, epoch.stamp, [] {
    Dtm dtm;
    dtm.datum = dtm.reference = "W84";
    dtm.latitude_offset_min = dtm.longitude_offset_min = dtm.altitude_offset_m = 0.0;
    return dtm;
  });
}

GnssEpoch GnssJoin::joined(GnssEpoch fix, const Status& status) {
  fix.fix = status.fix;
  fix.horizontal_stddev_m = status.horizontal_stddev_m;
  fix.vertical_stddev_m = status.vertical_stddev_m;
  fix.satellites = status.satellites;
  fix.geoid_separation_m = status.geoid_separation_m;
  return fix;
}

std::optional<GnssEpoch> GnssJoin::add_fix(const GnssEpoch& fix, bool awaits_status) {
  if (newest_ && newest_->stamp == fix.stamp) {
    waiting_.reset();
    return joined(fix, *newest_);
  }
  if (!awaits_status) return fix;
  std::optional<GnssEpoch> late = waiting_;
  if (late && newest_) late = joined(*late, *newest_);
  waiting_ = fix;
  return late;
}

std::optional<GnssEpoch> GnssJoin::add_status(const Status& status) {
  newest_ = status;
  if (waiting_ && waiting_->stamp == status.stamp) {
    const GnssEpoch complete = joined(*waiting_, status);
    waiting_.reset();
    return complete;
  }
  if (status.fix != Fix::kNone) return std::nullopt;
  GnssEpoch without_fix;
  without_fix.stamp = status.stamp;
  return joined(without_fix, status);
}

}  // namespace trident::bridges::nmea
