// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_trajectories/trajectory.h"
#include "trident_trajectories/violation.h"

namespace trident::trajectories {

/// What all limits of a problem come to on given trajectories (one a robot), at all instants and
/// not at samples alone: bounds of polynomials by their hulls, halved until they are tight; for
/// obstacles by the slope of their distance. Thrust is looked at 50 times per segment.
///
/// Worst first. Those that are farther than `within` (relative) within their limit are left out.
std::vector<Violation> violations(const Problem& problem,
                                  const std::vector<Trajectory>& trajectories, double within = 0.0);

}  // namespace trident::trajectories
