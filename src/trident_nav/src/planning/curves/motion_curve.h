// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

#include "trident_nav/core/geometry.h"

namespace trident::nav {

constexpr double kPi = 3.14159265358979323846;

/// How a vehicle of bounded curvature moves.
enum class MotionModel { kDubins, kReedsShepp };

/// A part of a curve: an arc of the turning radius, or a straight line.
struct CurveSegment {
  int turn = 0;         ///< 1: to the left, 0: straight, -1: to the right.
  double length = 0.0;  ///< In turning radii; negative: backwards.
};

/// A shortest curve of bounded curvature between two poses.
class MotionCurve {
 public:
  static constexpr int kMaxSegments = 5;

  MotionCurve() = default;
  /// `radius`: of the arcs, in the unit of all positions.
  explicit MotionCurve(double radius) : radius_(radius) {}

  int size() const { return size_; }
  const CurveSegment& operator[](int i) const { return segments_[static_cast<std::size_t>(i)]; }
  double radius() const { return radius_; }
  /// The length of the curve, in the unit of the radius.
  double length() const { return radius_ * sum_; }
  /// Adds a segment; one that is shorter than 1e-9 radii is left out.
  void add(int turn, double length);

 private:
  double radius_ = 1.0;
  double sum_ = 0.0;
  int size_ = 0;
  std::array<CurveSegment, kMaxSegments> segments_{};
};

/// The pose at `length` >= 0 [unit of the radius] along a segment that begins at `from`.
Pose2 pose_along(const Pose2& from, const CurveSegment& segment, double radius, double length);

/// The shortest curve that drives forwards (Dubins, Am. J. Math. 79, 1957).
MotionCurve dubins_curve(const Pose2& from, const Pose2& to, double radius);
/// The shortest curve that drives forwards and backwards (Reeds and Shepp, Pacific J. Math. 145,
/// 1990, formulas 8.1 to 8.11 with their reflections).
MotionCurve reeds_shepp_curve(const Pose2& from, const Pose2& to, double radius);

inline MotionCurve motion_curve(MotionModel model, const Pose2& from, const Pose2& to,
                                double radius) {
  return model == MotionModel::kDubins ? dubins_curve(from, to, radius)
                                       : reeds_shepp_curve(from, to, radius);
}

/// How many radii a shortest curve may be longer than the straight line between its ends. Dubins:
/// Savla, Frazzoli, Bullo, IEEE Trans. Automatic Control 53, 2008 (2.658 pi). Reeds and Shepp: a
/// turn on the spot, there along the line and another turn, forwards or backwards, take less than
/// pi each.
constexpr double max_excess(MotionModel model) {
  return model == MotionModel::kDubins ? 2.658 * kPi : 2.0 * kPi;
}

}  // namespace trident::nav
