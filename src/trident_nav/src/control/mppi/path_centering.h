// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Moves a path to the middle of narrow places, and for a little before and behind them. Narrow is
/// where even the middle between the obstacles on both sides has less than `narrow_m` of distance
/// from them. A path that is shortest for a circle leads slantwise through a door that a rectangle
/// fits through only straight; a middle line it can follow. Points move sideways by at most twice
/// `narrow_m`; the first and the last one stay. `grid` has distances.
void center_path(const CostGrid& grid, double narrow_m, std::vector<Pose2>* path);

}  // namespace trident::nav
