// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/receive/utc_resolver.h"

#include <cmath>

namespace trident::bridges::nmea {
namespace {

constexpr std::int64_t kDayNs = 86'400LL * 1'000'000'000;

std::int64_t day_ns(const TimeOfDay& time) {
  const double seconds = time.hour * 3'600.0 + time.minute * 60.0 + time.second;
  return std::llround(seconds * 1e9);
}

std::int64_t floor_to_day(std::int64_t unix_ns) {
  const std::int64_t rest = unix_ns % kDayNs;
  return unix_ns - (rest < 0 ? rest + kDayNs : rest);
}

}  // namespace

void UtcResolver::set(const CivilDate& date, const TimeOfDay& time) {
  newest_ns_ = days_from_civil(date) * kDayNs + day_ns(time);
}

std::optional<std::int64_t> UtcResolver::unix_ns(const TimeOfDay& time, const Receipt& receipt) {
  const std::optional<std::int64_t> about_ns = newest_ns_ ? newest_ns_ : receipt.unix_ns;
  if (!about_ns) return std::nullopt;
  std::int64_t result = floor_to_day(*about_ns) + day_ns(time);
  if (result - *about_ns > kDayNs / 2) result -= kDayNs;
  if (*about_ns - result > kDayNs / 2) result += kDayNs;
  if (newest_ns_) newest_ns_ = result;
  return result;
}

}  // namespace trident::bridges::nmea
