// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "trident_slam/ekf_slam.h"

namespace trident::slam {

/// 2x2: covariance between the innovations of two pairs, noise of the observation included where
/// both are of one observation [m^2].
using InnovationCovariance =
    std::function<Eigen::Matrix2d(const LandmarkPair&, const LandmarkPair&)>;

/// Joint compatibility branch and bound (Neira and Tardos 2001): of all sets that pair each
/// observation with at most one landmark and each landmark with at most one observation, and whose
/// joint squared Mahalanobis distance is within `gates[size]`, the largest, and of those the one of
/// the smallest distance. `candidates[i]`: pairs of observation i, nearest first. After
/// `max_pairings` partial sets the best so far is taken.
std::vector<LandmarkPair> largest_joint_set(
    const std::vector<std::vector<LandmarkPair>>& candidates, const std::vector<double>& gates,
    const InnovationCovariance& covariance, int max_pairings);

}  // namespace trident::slam
