// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_base/laser_scan.h"
#include "trident_slam/ekf_slam_2d.h"

namespace trident::slam {

/// Middles of the posts that a scan shows, in the base frame. An object of n beams at distance d is
/// taken for a cylinder whose tangents enclose n increments: r = d sin(a) / (1 - sin(a)) with a
/// half of that angle and d the nearest range.
std::vector<PointObservation> find_posts(const LaserScan& scan, const PostParams& params);

}  // namespace trident::slam
