// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Points of a path that are nearer to each other are one [m].
inline constexpr double kPointApart = 1e-6;

/// A pose at which the direction of travel is reversed.
struct Cusp {
  std::size_t index = 0;  ///< Of the path's pose; of several in one place, the last.
  /// A robot that stands no farther away has passed it: a part of what is driven before and after,
  /// so that motions of centimeters are driven, too [m].
  double tolerance_m = 0.0;

  /// Whether it is passed by a robot that has `left_m` of the path to it, and had `last_left_m`
  /// a control period ago.
  bool is_passed(double left_m, double last_left_m) const;
};

/// Whether a path has headings of its own, which fit its direction: most poses look along it or
/// against it. A planner without headings leaves all of them at zero, but perhaps the last.
bool has_own_headings(const Path& path);

/// Where a path reverses its direction of travel, in order; none for a path without headings of its
/// own.
std::vector<Cusp> cusps_of(const Path& path);

}  // namespace trident::nav
