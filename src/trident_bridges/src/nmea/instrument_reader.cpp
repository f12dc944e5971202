// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/receive/instrument_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/units.h"

namespace trident::bridges::nmea {
namespace {

constexpr double kPascalsPerBar = 1e5;

std::string_view text_of(const FixedText<16>& text) { return text.view(); }

bool is_named(std::string_view name, std::string_view wanted) {
  return name.size() == wanted.size() &&
         std::equal(name.begin(), name.end(), wanted.begin(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
}

/// What a transducer's unit is multiplied by.
double factor_of(char unit) {
  switch (unit) {
    case 'D':
      return deg_to_rad(1.0);
    case 'B':
      return kPascalsPerBar;
    default:
      return 1.0;
  }
}

/// "xdr/outside_temp" of "Outside Temp".
FixedText<20> topic_name(std::string_view name) {
  std::array<char, 20> result{'x', 'd', 'r', '/'};
  std::size_t size = 4;
  for (const char c : name.substr(0, result.size() - size)) {
    const auto byte = static_cast<unsigned char>(c);
    result[size++] = std::isalnum(byte) != 0 ? static_cast<char>(std::tolower(byte)) : '_';
  }
  return FixedText<20>({result.data(), size});
}

double wind_factor(char unit) {
  switch (unit) {
    case 'K':
      return 1.0 / kKilometersPerHour;
    case 'N':
      return kMetersPerSecondPerKnot;
    case 'S':
      return kMetersPerStatuteMile / 3'600.0;
    default:
      return 1.0;
  }
}

std::optional<double> in_m_s(const std::optional<double>& speed_m_s,
                             const std::optional<double>& speed_knots) {
  if (speed_m_s || !speed_knots) return speed_m_s;
  return *speed_knots * kMetersPerSecondPerKnot;
}

}  // namespace

std::optional<double> Magnetic::to_true_deg(double magnetic_deg) const {
  if (!variation_deg) return std::nullopt;
  return wrap_to_360(magnetic_deg + *variation_deg);
}

void InstrumentReader::put_heading(const std::optional<double>& heading_deg) {
  if (!heading_deg) return;
  heading_deg_ = heading_deg;
  sink_.on_heading(deg_to_rad(*heading_deg));
}

void InstrumentReader::read(const Hdt& hdt, const Receipt& /*receipt*/) {
  put_heading(hdt.heading_deg);
}

void InstrumentReader::read(const Ths& ths, const Receipt& /*receipt*/) {
  if (ths.mode != 'V') put_heading(ths.heading_deg);
}

void InstrumentReader::read(const Hdg& hdg, const Receipt& /*receipt*/) {
  if (hdg.variation_deg) magnetic_.variation_deg = hdg.variation_deg;
  if (!hdg.sensor_heading_deg) return;
  put_heading(magnetic_.to_true_deg(*hdg.sensor_heading_deg + hdg.deviation_deg.value_or(0.0)));
}

void InstrumentReader::read(const Hdm& hdm, const Receipt& /*receipt*/) {
  if (hdm.heading_deg) put_heading(magnetic_.to_true_deg(*hdm.heading_deg));
}

void InstrumentReader::read(const Rot& rot, const Receipt& /*receipt*/) {
  if (rot.status != 'A' || !rot.rate_deg_min) return;
  sink_.on_turn_rate(-deg_to_rad(*rot.rate_deg_min) / kSecondsPerMinute);
}

void InstrumentReader::read(const Vhw& vhw, const Receipt& /*receipt*/) {
  if (vhw.speed_knots) {
    sink_.on_water_velocity({*vhw.speed_knots * kMetersPerSecondPerKnot, 0.0});
  } else if (vhw.speed_km_h) {
    sink_.on_water_velocity({*vhw.speed_km_h / kKilometersPerHour, 0.0});
  }
}

void InstrumentReader::read(const Vbw& vbw, const Receipt& /*receipt*/) {
  if (vbw.water_status != 'A' || !vbw.water_ahead_knots) return;
  sink_.on_water_velocity({*vbw.water_ahead_knots * kMetersPerSecondPerKnot,
                           -vbw.water_starboard_knots.value_or(0.0) * kMetersPerSecondPerKnot});
}

void InstrumentReader::put_number(std::string_view name, const std::optional<double>& value,
                                  double factor) {
  if (value) sink_.on_number({name, *value * factor});
}

void InstrumentReader::read(const Vlw& vlw, const Receipt& /*receipt*/) {
  put_number("distance_through_water", vlw.water_total_nm, kMetersPerNauticalMile);
  put_number("distance_over_ground", vlw.ground_total_nm, kMetersPerNauticalMile);
}

void InstrumentReader::read(const Dbt& dbt, const Receipt& /*receipt*/) {
  if (dbt.depth_m) {
    sink_.on_depth({*dbt.depth_m, {}, {}});
  } else if (dbt.depth_feet) {
    sink_.on_depth({*dbt.depth_feet / kFeetPerMeter, {}, {}});
  } else if (dbt.depth_fathoms) {
    sink_.on_depth({*dbt.depth_fathoms / kFathomsPerMeter, {}, {}});
  }
}

void InstrumentReader::read(const Dpt& dpt, const Receipt& /*receipt*/) {
  if (dpt.depth_m) sink_.on_depth({*dpt.depth_m, dpt.offset_m, dpt.max_range_m});
}

void InstrumentReader::read(const Mtw& mtw, const Receipt& /*receipt*/) {
  put_number("water_temperature", mtw.temperature_c, 1.0);
}

void InstrumentReader::put_wind(bool is_true, const std::optional<double>& angle_deg,
                                const std::optional<double>& speed_m_s) {
  if (!angle_deg || !speed_m_s) return;
  sink_.on_wind({is_true, *speed_m_s, deg_to_rad(wrap_to_360(*angle_deg))});
}

void InstrumentReader::read(const Mwv& mwv, const Receipt& /*receipt*/) {
  if (mwv.status != 'A' || mwv.reference == '\0' || mwv.unit == '\0' || !mwv.speed) return;
  put_wind(mwv.reference == 'T', mwv.angle_deg, *mwv.speed * wind_factor(mwv.unit));
}

void InstrumentReader::read(const Mwd& mwd, const Receipt& /*receipt*/) {
  std::optional<double> direction_deg = mwd.direction_deg;
  if (!direction_deg && mwd.magnetic_direction_deg) {
    direction_deg = magnetic_.to_true_deg(*mwd.magnetic_direction_deg);
  }
  if (!direction_deg || !heading_deg_) return;
  put_wind(true, *direction_deg - *heading_deg_, in_m_s(mwd.speed_m_s, mwd.speed_knots));
}

void InstrumentReader::put_wind(bool is_true, const SidedWind& wind) {
  std::optional<double> speed_m_s = in_m_s(wind.speed_m_s, wind.speed_knots);
  if (!speed_m_s && wind.speed_km_h) speed_m_s = *wind.speed_km_h / kKilometersPerHour;
  put_wind(is_true, wind.angle_deg, speed_m_s);
}

void InstrumentReader::read(const Vwr& vwr, const Receipt& /*receipt*/) { put_wind(false, vwr); }

void InstrumentReader::read(const Vwt& vwt, const Receipt& /*receipt*/) { put_wind(true, vwt); }

/// Into the tilt, or on a topic of its name.
void InstrumentReader::put_measurement(const Measurement& measured, Tilt* tilt) {
  const double value = *measured.value * factor_of(measured.unit);
  const std::string_view name = text_of(measured.name);
  if (is_named(name, "roll")) {
    tilt->roll_rad = value;
  } else if (is_named(name, "ptch") || is_named(name, "pitch")) {
    tilt->pitch_rad = -value;  // there bow up is positive
  } else if (!name.empty()) {
    const FixedText<20> topic = topic_name(name);
    sink_.on_number({topic.view(), value});
  }
}

void InstrumentReader::read(const Xdr& xdr, const Receipt& /*receipt*/) {
  Tilt tilt;
  for (const Measurement& measured : xdr.measurements) {
    if (measured.value) put_measurement(measured, &tilt);
  }
  if (tilt.roll_rad || tilt.pitch_rad) sink_.on_tilt(tilt);
}

void InstrumentReader::read(const Rpm& rpm, const Receipt& /*receipt*/) {
  if (rpm.status != 'A' || !rpm.number || rpm.source == '\0') return;
  std::array<char, 16> name{};
  CharWriter text(name.data(), name.size());
  text.put(rpm.source == 'S' ? "rpm/shaft_" : "rpm/engine_");
  text.put_digits(*rpm.number, 1);
  put_number(text.view(), rpm.speed_rpm, 1.0);
}

void InstrumentReader::read(const Rsa& rsa, const Receipt& /*receipt*/) {
  const double factor = deg_to_rad(1.0);
  if (rsa.starboard_status == 'A') put_number("rudder_angle", rsa.starboard_deg, factor);
  if (rsa.port_status == 'A') put_number("rudder_angle_port", rsa.port_deg, factor);
}

}  // namespace trident::bridges::nmea
