// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "planning/poses/pose_route.h"
#include "trident_nav/planning/smac_params.h"

namespace trident::nav {

/// What Smac's parameters mean on a grid of this resolution, for curves of `radius_m` [m].
/// `halves`: the obstacle heuristic looks at blocks of 2 x 2 cells.
PoseRouteOptions pose_route_options(const SmacPoseParams& params, MotionModel model,
                                    double resolution, double radius_m, bool is_quadratic,
                                    bool halves);

}  // namespace trident::nav
