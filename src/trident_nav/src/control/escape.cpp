// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "escape.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mppi/mppi_model.h"

namespace trident::nav {
namespace {

// Between the footprint's cover and the nearest obstacle, negative where they overlap.
double cover_clearance(const std::vector<CoverCircle>& cover, const CostGrid& grid,
                       const Pose2& pose) {
  double least_m = static_cast<double>(grid.max_distance_m);
  for (const CoverCircle& circle : cover) {
    const Point2 p =
        transform(pose, {static_cast<double>(circle.x), static_cast<double>(circle.y)});
    const Cell cell = grid.geometry.cell(p.x, p.y);
    if (!grid.geometry.contains(cell)) continue;
    const double d = static_cast<double>(grid.distance_m[grid.geometry.index(cell)]);
    least_m = std::min(least_m, d - static_cast<double>(circle.radius));
  }
  return least_m;
}

std::vector<Twist2> slow_twists(const ControlSetup& setup) {
  constexpr double kShare = 0.2;
  const double v = kShare * setup.limits.vx_max;
  const double back = std::max(setup.limits.vx_min, -v);
  const double w = setup.can_turn_on_spot() ? 0.5 * kShare * setup.limits.wz_max
                                            : v / setup.limits.min_turning_radius;
  std::vector<double> sideways{0.0};
  if (setup.limits.vy_max > 0.0) sideways.insert(sideways.end(), {v, -v});
  std::vector<Twist2> twists;
  for (const double vx : {v, 0.0, back}) {
    for (const double wz : {0.0, w, -w}) {
      for (const double vy : sideways) twists.push_back({vx, vy, wz});
    }
  }
  return twists;
}

}  // namespace

std::optional<Twist2> escape_twist(const ControlSetup& setup, const BrakingGuard& guard,
                                   const RobotState& state, const CostGrid& grid,
                                   const Tracks& tracks) {
  if (grid.distance_m == nullptr) return std::nullopt;
  const auto cover = cover_footprint(setup.footprint);
  const double ahead_s = 10.0 * setup.period_s;
  const TwistWindow window = reachable_window(setup.limits, state.twist, setup.period_s);
  std::optional<Twist2> best;
  double best_m = cover_clearance(cover, grid, state.pose);
  for (const Twist2& wanted : slow_twists(setup)) {
    const Pose2 end = integrate(state.pose, wanted, ahead_s);
    const double clear_m = cover_clearance(cover, grid, end);
    if (clear_m <= best_m) continue;
    const Twist2 twist = admissible_twist(setup.limits, window, wanted);
    if (guard.first_contact(state, twist, grid, tracks)) continue;
    best_m = clear_m;
    best = twist;
  }
  return best;
}

}  // namespace trident::nav
