// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Moves the points of a path sideways, away from obstacles, until each has `room_m` of distance
/// from them or lies in the middle between those on both sides, by no more than `room_m`. A path
/// that is shortest for a circle leads slantwise through a door that a rectangle fits through only
/// straight: the middle lines of narrow places are what a rectangle can follow. The first and the
/// last point stay; near them points move less. `grid` has distances.
void center_path(const CostGrid& grid, double room_m, std::vector<Pose2>* path);

}  // namespace trident::nav
