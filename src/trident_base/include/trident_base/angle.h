// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace trident {

constexpr double deg_to_rad(double angle_deg) { return angle_deg * (std::numbers::pi / 180.0); }
constexpr double rad_to_deg(double angle) { return angle * (180.0 / std::numbers::pi); }

/// The same angle in (-pi, pi] [rad].
inline double wrap_to_pi(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped == -std::numbers::pi ? std::numbers::pi : wrapped;
}

/// The shortest turn that leads from angle `from` to angle `to`, in (-pi, pi] [rad].
inline double angle_difference(double to, double from) { return wrap_to_pi(to - from); }

}  // namespace trident
