// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "planning/curves/curve_checker.h"
#include "planning/curves/motion_curve.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// How paths are smoothed. Lengths in cells.
struct ShortcutOptions {
  MotionModel model = MotionModel::kDubins;
  double radius = 8.0;
  int passes = 3;
  int max_tries = 1000;     ///< Curves that are looked at.
  double min_gain = 1e-10;  ///< Of the cost, for a curve to be taken.
  double longest = 120.0;   ///< Of the parts that one curve replaces.
};

/// Replaces parts of a path by shortest curves where these are free of contact and cost no more:
/// what turns to and fro becomes smooth, and the curvature keeps its bound. The ends stay.
/// Returns the path as it is then when it is canceled.
TravelPath with_shortcuts(const TravelPath& path, const CurveChecker& checker,
                          const ShortcutOptions& options, const CancelFlag& cancel);

}  // namespace trident::nav
