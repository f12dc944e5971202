// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Poses along straight lines between points, at most `spacing_m` apart, each point among them and
/// none twice; headings along the direction of travel. The last pose gets `last_yaw`.
Path poses_along(const std::vector<Point2>& points, double spacing_m, double last_yaw);

/// Turns each pose but the last towards the next one.
void orient_forward(Path& path);

/// The sum of the distances between consecutive poses [m].
double path_length(const Path& path);

}  // namespace trident::nav
