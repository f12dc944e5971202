// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Numbers as whole ones in the units of MAVLink's fields.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "trident_base/angle.h"

namespace trident::bridges::mavlink {

/// The nearest whole number that a field of at most 32 bits holds; NaN is 0.
template <class Integer>
Integer to_whole(double value) {
  static_assert(sizeof(Integer) <= 4, "a double holds the limits of wider types not exactly");
  constexpr auto kMin = static_cast<double>(std::numeric_limits<Integer>::min());
  constexpr auto kMax = static_cast<double>(std::numeric_limits<Integer>::max());
  if (std::isnan(value)) return 0;
  return static_cast<Integer>(std::llround(std::max(kMin, std::min(kMax, value))));
}

/// Latitude or longitude [1e-7 deg].
inline std::int32_t degrees_e7(double angle_deg) { return to_whole<std::int32_t>(1e7 * angle_deg); }
/// Altitude or height [mm].
inline std::int32_t millimeters(double height_m) { return to_whole<std::int32_t>(1e3 * height_m); }
/// Part of a velocity [cm/s].
inline std::int16_t centimeters(double v_m_s) { return to_whole<std::int16_t>(100.0 * v_m_s); }
/// Course or heading, clockwise from north, 0 to 35999 [0.01 deg].
inline std::uint16_t centidegrees(double bearing_rad) {
  constexpr int kTurn = 36'000;
  const double degrees = wrap_to_360(rad_to_deg(bearing_rad));
  return static_cast<std::uint16_t>(to_whole<std::uint16_t>(100.0 * degrees) % kTurn);
}

}  // namespace trident::bridges::mavlink
