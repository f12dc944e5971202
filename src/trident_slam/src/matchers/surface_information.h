// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_slam/match_result.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {

/// Information of points on surfaces about the pose that they are seen from, of (x, y, yaw) in the
/// reference's frame: the sum of J' J / sigma^2 with J = (n, n x R p), n the surface's normal. A
/// wall gives no information along itself, whatever the method that compares the scan with it.
/// `is_on_surface`: one entry per point, of which those count that are not 0. `sigma` [m] is that
/// of one of 200 points; more than these are not independent.
/// A. Censi, "On achievable accuracy for range-finder localization", ICRA 2007.
Eigen::Matrix3d surface_information(const PointScan& scan, const SE2& T_ref_base,
                                    const std::vector<char>& is_on_surface, double sigma);

/// Normals that err by some degrees give false information along a wall: what is left of the
/// information when a hundredth of the largest eigenvalue, yaw counted at `range` [m], is taken off
/// each.
Eigen::Matrix3d without_noise(const Eigen::Matrix3d& information, double range);

/// `T`, but with its displacement from `anchor` along directions of too small eigenvalues undone:
/// Zhang, Kaess, Singh 2016, with a ramp below their threshold.
SE2 held_where_degenerate(const SE2& T, const SE2& anchor, const Eigen::Matrix3d& information,
                          double range);

/// Removes, by the same ramp, the parts of `information` and `gradient` of a cost along directions
/// of too small eigenvalues. A prior that is independent of the scans counts alone there: errors of
/// the normals pull to the same side at every scan.
void discard_degenerate(double range, Eigen::Matrix3d* information, Eigen::Vector3d* gradient);

/// Mean distance of a scan's points from the base [m].
double mean_range(const PointScan& scan);

}  // namespace trident::slam
