// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/send/ais_transmitter.h"

#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/nmea/units.h"

namespace trident::bridges::nmea {
namespace {

constexpr std::size_t kCharactersPerSentence = 60;
constexpr std::size_t kBitsPerCharacter = 6;
constexpr double kAtRestPeriodS = 180.0;
constexpr std::uint32_t kAtAnchor = 1, kMoored = 5;

std::optional<double> course_deg(const std::optional<double>& angle_rad) {
  if (!angle_rad) return std::nullopt;
  return bearing_deg(*angle_rad);
}

AisMotion motion_of(const AisState& state, const UtcTime& utc) {
  AisMotion motion;
  if (state.speed_m_s) motion.speed_knots = *state.speed_m_s / kMetersPerSecondPerKnot;
  motion.is_accurate = state.is_accurate;
  motion.latitude_deg = state.latitude_deg;
  motion.longitude_deg = state.longitude_deg;
  motion.course_deg = course_deg(state.course_rad);
  motion.heading_deg = course_deg(state.heading_rad);
  motion.second = static_cast<std::uint32_t>(utc.second % 60);
  return motion;
}

std::uint32_t whole_meters(double meters) {
  return static_cast<std::uint32_t>(std::lround(meters));
}

AisExtent extent_of(const AisParams& params) {
  return {whole_meters(params.to_bow_m), whole_meters(params.to_stern_m),
          whole_meters(params.to_port_m), whole_meters(params.to_starboard_m)};
}

bool is_due(const std::optional<SimTime>& last, SimTime now, double period_s) {
  // A time that went back begins again.
  return !last || now < *last || (now - *last).seconds() >= period_s;
}

}  // namespace

double AisTransmitter::position_period_s(const AisState& state) const {
  if (params_.position_period_s > 0.0) return params_.position_period_s;
  const double knots = state.speed_m_s.value_or(0.0) / kMetersPerSecondPerKnot;
  if (params_.vessel_class == AisClass::kB) return knots > 2.0 ? 30.0 : kAtRestPeriodS;
  const auto status = static_cast<std::uint32_t>(params_.nav_status);
  if ((status == kAtAnchor || status == kMoored) && knots < 3.0) return kAtRestPeriodS;
  if (knots <= 14.0) return 10.0;
  return knots <= 23.0 ? 6.0 : 2.0;
}

void AisTransmitter::on_state(SimTime stamp, const AisState& state) {
  if (params_.mmsi == 0) return;
  if (is_due(last_description_, stamp, params_.static_period_s)) {
    last_description_ = stamp;
    send_description(stamp);
  }
  if (is_due(last_position_, stamp, position_period_s(state))) {
    last_position_ = stamp;
    send_position(stamp, state);
  }
}

void AisTransmitter::send_position(SimTime stamp, const AisState& state) {
  const AisMotion motion = motion_of(state, clock_.utc_at(stamp));
  if (params_.vessel_class == AisClass::kB) {
    AisClassBPosition message;
    message.header.mmsi = params_.mmsi;
    message.motion = motion;
    send(stamp, to_bits(message));
    return;
  }
  AisPosition message;
  message.header.mmsi = params_.mmsi;
  message.status = static_cast<std::uint32_t>(params_.nav_status);
  if (state.turn_rad_s) message.turn_rate_deg_min = rad_to_deg(*state.turn_rad_s) * 60.0;
  message.motion = motion;
  send(stamp, to_bits(message));
}

void AisTransmitter::send_description(SimTime stamp) {
  if (params_.vessel_class == AisClass::kB) {
    AisDescription message;
    message.header.mmsi = params_.mmsi;
    message.name = FixedText<20>(params_.name);
    send(stamp, to_bits(message));
    message.part = 1;
    message.ship_type = static_cast<std::uint32_t>(params_.ship_type);
    message.call_sign = FixedText<7>(params_.call_sign);
    message.extent = extent_of(params_);
    send(stamp, to_bits(message));
    return;
  }
  AisVoyage message;
  message.header.mmsi = params_.mmsi;
  message.imo = static_cast<std::uint32_t>(params_.imo);
  message.call_sign = FixedText<7>(params_.call_sign);
  message.name = FixedText<20>(params_.name);
  message.ship_type = static_cast<std::uint32_t>(params_.ship_type);
  message.extent = extent_of(params_);
  if (params_.draft_m > 0.0) message.draft_m = params_.draft_m;
  message.destination = FixedText<20>(params_.destination);
  send(stamp, to_bits(message));
}

void AisTransmitter::send(SimTime stamp, const AisBits& bits) {
  const std::size_t per_sentence = kCharactersPerSentence * kBitsPerCharacter;
  const auto total = static_cast<int>((bits.size() + per_sentence - 1) / per_sentence);
  is_on_b_ = !is_on_b_;
  if (total > 1) sequence_ = (sequence_ + 1) % 10;
  for (int number = 1; number <= total; ++number) {
    const std::size_t at = static_cast<std::size_t>(number - 1) * per_sentence;
    AisPart part;
    part.total = total;
    part.number = number;
    if (total > 1) part.sequence = sequence_;
    part.channel = is_on_b_ ? 'B' : 'A';
    part.payload = payload_of(bits, at, kCharactersPerSentence);
    part.fill_bits = fill_bits_of(bits, at, kCharactersPerSentence);
    sink_.on_part(part, stamp);
  }
}

}  // namespace trident::bridges::nmea
