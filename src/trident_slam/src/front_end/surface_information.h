// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_slam/match_result.h"
#include "trident_slam/point_scan.h"

namespace trident {

/// What points on surfaces tell of the pose that they are seen from, of (x, y, yaw) in the
/// reference's frame: the sum of J' J / sigma^2 with J = (n, n x R p), n the surface's normal. A
/// wall tells nothing along itself, whatever the method that compares the scan with it.
/// `is_on_surface`: one entry per point, of which those count that are not 0. `sigma` [m] is that
/// of one of 200 points; more than these are not independent.
/// A. Censi, "On achievable accuracy for range-finder localization", ICRA 2007.
Eigen::Matrix3d surface_information(const PointScan& scan, const SE2& T_ref_base,
                                    const std::vector<char>& is_on_surface, double sigma);

/// Mean distance of a scan's points from the base [m].
double mean_range(const PointScan& scan);

}  // namespace trident
