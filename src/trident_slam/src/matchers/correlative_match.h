// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "grids/max_pyramid.h"

namespace trident::slam {

/// Where a pose is searched for: within `linear` of the guess along both axes and within `angular`
/// of its yaw.
struct SearchWindow {
  double linear = 0.3;   ///< [m]
  double angular = 0.2;  ///< [rad]; pi or more: every direction
};

struct CorrelativeMatch {
  SE2 T_ref_base;
  double score = 0.0;  ///< mean value of the cells under the points, 0 to 1
};

/// What one search may cost: points looked up. It is cut short there, and what it has found until
/// then counts; searches that find anything need a small part of it.
constexpr std::int64_t kMaxLookups = 500'000'000;

/// The pose of highest score within the window, by branch and bound: exact for the grid of poses
/// (one cell, and turns that move the farthest point by one cell). Nothing if no pose reaches
/// `min_score`.
/// E. Olson, "Real-time correlative scan matching", ICRA 2009; W. Hess et al., ICRA 2016.
std::optional<CorrelativeMatch> match_by_branch_and_bound(
    const MaxPyramid& reference, const std::vector<Eigen::Vector2f>& points, const SE2& guess,
    const SearchWindow& window, double min_score);

/// The points of a scan, at most about `max_points`, evenly spread over the beams.
std::vector<Eigen::Vector2f> thinned_points(const PointScan& scan, std::size_t max_points);

}  // namespace trident::slam
