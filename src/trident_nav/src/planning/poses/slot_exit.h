// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "planning/curves/curve_checker.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// How a car leaves a slot that is hardly longer than itself: tightest arcs forwards to one side
/// and backwards to the other, each as far as there is room, until one of them leads out. The grid
/// of a search over poses is too coarse for it: each pair of arcs moves the car sideways by less
/// than a cell.
///
/// `from` and `radius` in cells. The path begins at `from`. Nothing where a single motion leads
/// out, which a search finds as well, and where the arcs lead nowhere.
std::optional<TravelPath> path_out_of_slot(const CurveChecker& checker, const Pose2& from,
                                           double radius);

}  // namespace trident::nav
