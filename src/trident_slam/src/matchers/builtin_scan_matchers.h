// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "trident_slam/scan_matcher.h"

namespace trident::slam {

/// Branch and bound over a window of poses (Olson 2009, Hess 2016), then the mean of the response
/// about the best one.
std::unique_ptr<ScanMatcher> make_correlative_matcher(const ScanMatcherOptions& options);
/// Gauss-Newton over interpolated occupancy, from coarse to fine (Kohlbrecher 2011).
std::unique_ptr<ScanMatcher> make_grid_matcher(const ScanMatcherOptions& options);
/// The correlative matcher, then from its pose the line matcher.
std::unique_ptr<ScanMatcher> make_hybrid_matcher(const ScanMatcherOptions& options);
/// Gauss-Newton over distances to the nearest surfaces (Censi 2008).
std::unique_ptr<ScanMatcher> make_line_matcher(const ScanMatcherOptions& options);
/// Newton over normal distributions of the points of overlapping cells, from coarse to fine (Biber
/// and Strasser 2003).
std::unique_ptr<ScanMatcher> make_ndt_matcher(const ScanMatcherOptions& options);

}  // namespace trident::slam
