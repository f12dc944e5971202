// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "grids/max_pyramid.h"
#include "matchers/line_match.h"
#include "trident_slam/graph_slam_front_end.h"

namespace trident::slam {

/// The place in a whole map where a scan fits best, by branch and bound; any heading. The higher
/// `min_response` of the options, the part of its points that must lie on surfaces, the shorter the
/// search.
std::optional<MatchResult> relocalize_in_map(const SurfelMap& surfels, const PointScan& scan,
                                             const LineMatchOptions& line,
                                             const RelocalizationOptions& options);

/// The surfaces within `reach` [m] of a point as hits for a search.
void insert_surfels(const SurfelMap& surfels, const Eigen::Vector2d& about, double reach,
                    MaxPyramid* hits);

}  // namespace trident::slam
