// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "footprint_distance.h"
#include "normal_equations.h"
#include "teb_band.h"
#include "teb_obstacles.h"

namespace trident::nav {

/// The motion from a pose of a band to the next one, in the axes of the heading halfway: on an arc
/// of constant curvature the chord has that direction, so that nothing is across.
struct SegmentMotion {
  TebQuantity<2> along;   ///< Signed: forward is positive [m].
  TebQuantity<2> across;  ///< To the left [m].
  TebQuantity<2> turn;    ///< [rad]
};

/// Whether `along` is the length of the chord or of the arc.
enum class ArcLength { kChord, kExact };

SegmentMotion segment_motion(const TebNode& from, const TebNode& to, ArcLength length);

/// A distance or an angle by the duration of its segment [m/s or rad/s].
TebQuantity<2> rate(const TebQuantity<2>& path, double dt_s);

/// The acceleration between two segments in a row: the change of the rate by the time between their
/// middles. `first`: of poses 0 and 1, `second`: of poses 1 and 2.
TebQuantity<3> acceleration(const TebQuantity<2>& first, const TebQuantity<2>& second, double dt0_s,
                            double dt1_s);

/// The acceleration from a known rate at a segment's beginning (`sign` 1) or to one at its end
/// (-1).
TebQuantity<2> end_acceleration(const TebQuantity<2>& segment, double known, double dt_s,
                                double sign);

/// By how much a turn is tighter than a radius allows [m]: radius * |turn| - |along|.
TebQuantity<2> turning_excess(const SegmentMotion& motion, double radius_m);

/// The length of a segment [m].
TebQuantity<2> length(const SegmentMotion& motion);

/// From a footprint at a pose to the rim of a disc about a point [m]; negative where they overlap.
TebQuantity<1> clearance(const FootprintDistance& footprint, const Pose2& pose, double cosine,
                         double sine, const Point2& center, double radius_m);

/// From a corner of the footprint at a pose to a plane [m]; negative beyond it.
TebQuantity<1> clearance(const Pose2& pose, double cosine, double sine, const TebPlane& plane);

/// From a pose to a point [m].
TebQuantity<1> separation(const Pose2& pose, const Point2& point);

/// How a quantity lies to the interval that it shall stay in: it exceeds the upper or the lower
/// end, by a value that is positive, or neither.
enum class TebSide : signed char { kUnder = -1, kWithin = 0, kOver = 1 };

template <std::size_t kNodes>
TebSide side_of(const TebQuantity<kNodes>& quantity, double lo, double hi) {
  if (quantity.value > hi) return TebSide::kOver;
  return quantity.value < lo ? TebSide::kUnder : TebSide::kWithin;
}

/// What a quantity exceeds an end of its interval by; negative within.
template <std::size_t kNodes>
TebQuantity<kNodes> excess(const TebQuantity<kNodes>& quantity, TebSide side, double lo,
                           double hi) {
  if (side == TebSide::kOver) {
    TebQuantity<kNodes> over = quantity;
    over.value -= hi;
    return over;
  }
  TebQuantity<kNodes> under;
  under.value = lo - quantity.value;
  for (std::size_t i = 0; i < under.slopes.size(); ++i) under.slopes[i] = -quantity.slopes[i];
  return under;
}

}  // namespace trident::nav
