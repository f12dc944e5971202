// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/angle.h"

namespace trident::bridges::nmea {

inline constexpr double kMetersPerNauticalMile = 1'852.0;
inline constexpr double kMetersPerSecondPerKnot = kMetersPerNauticalMile / 3'600.0;
inline constexpr double kKilometersPerHour = 3.6;  ///< in one meter per second
inline constexpr double kMetersPerStatuteMile = 1'609.344;
inline constexpr double kFeetPerMeter = 1.0 / 0.3048;
inline constexpr double kFathomsPerMeter = 1.0 / 1.8288;
inline constexpr double kSecondsPerMinute = 60.0;

/// [0, 360) degrees of a bearing, or of another angle, in radians.
inline double bearing_deg(double angle_rad) { return wrap_to_360(rad_to_deg(angle_rad)); }

}  // namespace trident::bridges::nmea
