// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_trajectories/optimize.h"

namespace trident::trajectories {

/// Why an infeasible problem is so. `found` are the violations of the nearest trajectories, worst
/// first. Each limit among them is relaxed alone until the problem can be solved; the limit whose
/// change is least comes first in `found` afterwards. Returns the message: limit, robots, time, by
/// how much, and which least change of that limit, or of the durations, makes it feasible.
std::string explain(const Problem& problem, const OptimizeOptions& options,
                    std::vector<Violation>& found);

}  // namespace trident::trajectories
