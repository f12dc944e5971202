// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace trident {

/// Simulated time, or a span of it, in whole nanoseconds. Integer, so that step k of period dt has
/// the one stamp k * dt, on every machine and after any number of steps.
struct SimTime {
  std::int64_t ns = 0;  ///< [ns], negative only for spans and "none"

  /// Rounds to the nearest nanosecond. Not for times beyond 292 years.
  static SimTime from_seconds(double seconds) {
    return {static_cast<std::int64_t>(std::llround(seconds * 1e9))};
  }
  /// Exact to 53 bits: about 0.1 us after 30 years.
  double seconds() const { return static_cast<double>(ns) / 1e9; }

  friend constexpr bool operator==(SimTime a, SimTime b) { return a.ns == b.ns; }
  friend constexpr bool operator!=(SimTime a, SimTime b) { return a.ns != b.ns; }
  friend constexpr bool operator<(SimTime a, SimTime b) { return a.ns < b.ns; }
  friend constexpr bool operator<=(SimTime a, SimTime b) { return a.ns <= b.ns; }
  friend constexpr bool operator>(SimTime a, SimTime b) { return a.ns > b.ns; }
  friend constexpr bool operator>=(SimTime a, SimTime b) { return a.ns >= b.ns; }
  SimTime operator+(SimTime other) const { return {ns + other.ns}; }  ///< overflow is not checked
  SimTime operator-(SimTime other) const { return {ns - other.ns}; }  ///< overflow is not checked
  /// E.g. a period, so many times.
  SimTime operator*(std::int64_t factor) const { return {ns * factor}; }
};

}  // namespace trident
