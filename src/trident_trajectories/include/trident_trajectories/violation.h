// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trident_trajectories/problem.h"

namespace trident::trajectories {

/// What a trajectory must keep.
enum class LimitKind {
  kVelocity,
  kAcceleration,
  kJerk,
  kTurnRate,
  kTurningRadius,
  kThrust,
  kReverseThrust,
  kHeight,
  kSeparation,
  kObstacle,
  kMovingObstacle,
  kRendezvous,
  kOrder,
};

/// "max_velocity", "separation" and so on: as the field of Limits, or the list of Problem.
const char* name_of(LimitKind kind);

/// By how much the worst instant of one limit misses it.
struct Violation {
  LimitKind limit = LimitKind::kVelocity;
  std::vector<std::size_t> robots;  ///< one, or the two of a pair
  double t = 0.0;                   ///< [s]
  double value = 0.0;               ///< what is reached: m/s, m, rad/s ...
  double bound = 0.0;               ///< what is allowed, in the same unit
  double relative = 0.0;            ///< how far beyond, over the bound; negative: how far within
};

/// "'uav1' and 'uav2' at 2.31 s: separation 0.8, legal is >= 1.5 (47 % beyond)".
std::string describe(const Violation& violation, const Problem& problem);

}  // namespace trident::trajectories
