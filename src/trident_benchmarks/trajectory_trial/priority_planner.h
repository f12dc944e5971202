// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "sampled_check.h"

namespace trident::benchmarks {

/// A yardstick that shares nothing with the optimizer: one robot after another takes the first of a
/// set of paths (straight or bowed to a side or upwards, quintic in time, at once or later) that
/// keeps its limits and is clear of those before it. Nothing where one robot finds none.
std::optional<std::vector<Path>> plan_by_priorities(const trajectories::Problem& problem);

}  // namespace trident::benchmarks
