// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "trident_trajectories/problem.h"
#include "trident_trajectories/violation.h"

namespace trident::benchmarks {

/// UAVs that change places across a circle of 8 m in 6 s: 1.5 m apart, 6 m/s, 5 m/s^2.
trajectories::Problem antipodal_swap(int robots);

/// A UAV, a ground robot and a vessel that gather at a place that is chosen.
trajectories::Problem three_platform_rendezvous();

/// A UAV that lands on a boat under path in a swell of 0.3 m, at a time that is chosen.
trajectories::Problem moving_boat_landing();

/// Eight ground robots that cross a field of 50 round obstacles, whose distances lie in a grid.
trajectories::Problem field_crossing();

/// 2 - 20 robots of three kinds among up to ten obstacles, with starts and goals that are clear of
/// each other. Whether it can be solved is not known.
trajectories::Problem random_team(std::uint64_t seed);

/// A problem that cannot be solved, and why.
struct InfeasibleTeam {
  trajectories::Problem problem;
  trajectories::LimitKind limit;  ///< the one that is to blame
  std::size_t robot;              ///< one of those who miss it
};

/// A small random team with one planted limit that mathematics forbids to keep: the mean speed, the
/// least possible acceleration or jerk from rest to rest, goals that are too near each other, or
/// one inside an obstacle.
InfeasibleTeam infeasible_team(std::uint64_t seed);

}  // namespace trident::benchmarks
