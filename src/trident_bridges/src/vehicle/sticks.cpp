// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/sticks.h"

#include <algorithm>
#include <limits>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

constexpr std::int16_t kNoAxis = std::numeric_limits<std::int16_t>::max();
constexpr std::uint16_t kIgnored = std::numeric_limits<std::uint16_t>::max();

double axis(std::int16_t value) {
  return value == kNoAxis ? 0.0 : std::clamp(value / 1000.0, -1.0, 1.0);
}

double from_middle(std::uint16_t channel_us) {
  return channel_us == 0 ? 0.0 : std::clamp((channel_us - 1500.0) / 500.0, -1.0, 1.0);
}

}  // namespace

std::optional<Sticks> StickReader::read(const Message& message) {
  if (is<mavlink_manual_control_t>(message)) return read_manual(message);
  if (is<mavlink_rc_channels_override_t>(message)) return read_channels(message);
  return std::nullopt;
}

std::optional<Sticks> StickReader::read_manual(const Message& message) const {
  const auto payload = unpack<mavlink_manual_control_t>(message);
  if (payload.target != self_.system) return std::nullopt;
  Sticks sticks;
  sticks.pitch = axis(payload.x);
  sticks.roll = axis(payload.y);
  sticks.yaw = axis(payload.r);
  // Rotors push in one direction, from 0. Wheels and propellers go astern below 0.
  const bool flies = vehicle_ == VehicleClass::kMultirotor;
  if (payload.z != kNoAxis) {
    sticks.throttle = flies ? std::max(axis(payload.z), 0.0) : 0.5 + 0.5 * axis(payload.z);
  }
  return sticks;
}

std::optional<Sticks> StickReader::read_channels(const Message& message) {
  const auto payload = unpack<mavlink_rc_channels_override_t>(message);
  if (!is_for({payload.target_system, payload.target_component}, self_)) return std::nullopt;
  const std::array<std::uint16_t, 4> given_us{payload.chan1_raw, payload.chan2_raw,
                                              payload.chan3_raw, payload.chan4_raw};
  for (std::size_t i = 0; i < given_us.size(); ++i) {
    if (given_us[i] != kIgnored) channels_us_[i] = given_us[i];
  }
  const auto is_released = [](std::uint16_t channel_us) { return channel_us == 0; };
  if (std::all_of(channels_us_.begin(), channels_us_.end(), is_released)) return std::nullopt;
  Sticks sticks;
  sticks.roll = from_middle(channels_us_[0]);
  sticks.pitch = -from_middle(channels_us_[1]);
  sticks.throttle = 0.5 + 0.5 * from_middle(channels_us_[2]);
  sticks.yaw = from_middle(channels_us_[3]);
  return sticks;
}

}  // namespace trident::bridges::mavlink
