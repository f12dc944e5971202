// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace trident {

inline constexpr double kPi = 3.14159265358979323846;  ///< C++17 has no std::numbers::pi

/// For the edges of the system: angles are radians everywhere else.
constexpr double deg_to_rad(double angle_deg) { return angle_deg * (kPi / 180.0); }
/// The inverse of deg_to_rad(). Neither wraps: 720 degrees are 4 pi.
constexpr double rad_to_deg(double angle) { return angle * (180.0 / kPi); }

/// The same angle in (-pi, pi] [rad].
inline double wrap_to_pi(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped == -kPi ? kPi : wrapped;
}

/// The same angle in [0, 360) degrees, as bearings are given [deg].
inline double wrap_to_360(double angle_deg) {
  const double wrapped = std::fmod(angle_deg, 360.0);
  return wrapped < 0.0 ? std::fmod(wrapped + 360.0, 360.0) : wrapped;
}

/// The shortest turn that leads from angle `from` to angle `to`, in (-pi, pi] [rad].
inline double angle_difference(double to, double from) { return wrap_to_pi(to - from); }

}  // namespace trident
