// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/poses/slot_exit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "planning/curves/motion_curve.h"

namespace trident::nav {
namespace {

/// A motion that is free for so many turning radii leads out.
constexpr double kOut = 0.8;
constexpr int kMaxMoves = 32;
/// What is left free at the end of a motion: as much of it as the slot allows [steps].
constexpr std::array<int, 3> kMargins{2, 1, 0};
/// A motion that is shorter leads nowhere [steps].
constexpr int kMinSteps = 2;

/// The moves of a car from one place.
class Shuffle {
 public:
  Shuffle(const CurveChecker& checker, const Pose2& from, double radius)
      : checker_(checker),
        from_(from),
        radius_(radius),
        step_(CurveChecker::kCheckSpacing / checker.grid().geometry.resolution) {}

  /// Whether no single motion leads out.
  bool is_tight() const {
    for (const int turn : {-1, 0, 1}) {
      for (const int gear : {-1, 1}) {
        if (free_steps(from_, segment(turn, gear)) >= out_steps()) return false;
      }
    }
    return true;
  }

  /// Turns to a side (1: left) whatever the gear, beginning with a gear (1: forwards).
  std::optional<TravelPath> leave(int side, int first_gear, int margin) const {
    TravelPath path;
    path.points.push_back({from_, false, false});
    int gear = first_gear;
    for (int move = 0; move < kMaxMoves; ++move, gear = -gear) {
      const CurveSegment arc = segment(side * gear, gear);
      const int free = free_steps(path.points.back().pose, arc);
      const bool is_out = free >= out_steps();
      const int steps = is_out ? free : free - margin;
      if (steps < kMinSteps) {
        // There may be room in the other direction yet.
        if (move == 0) continue;
        return std::nullopt;
      }
      append(arc, steps, path);
      if (is_out) return path;
    }
    return std::nullopt;
  }

 private:
  static CurveSegment segment(int turn, int gear) { return {turn, static_cast<double>(gear)}; }
  int out_steps() const { return static_cast<int>(kOut * radius_ / step_); }

  /// How many steps along a segment are free, as far as that leads out.
  int free_steps(const Pose2& from, const CurveSegment& arc) const {
    for (int i = 1; i <= out_steps(); ++i) {
      if (!checker_.is_free(pose_along(from, arc, radius_, i * step_))) return i - 1;
    }
    return out_steps();
  }

  /// Adds points at most a cell apart.
  void append(const CurveSegment& arc, int steps, TravelPath& path) const {
    const Pose2 from = path.points.back().pose;
    const double length = steps * step_;
    const int count = std::max(1, static_cast<int>(std::ceil(length)));
    for (int k = 1; k <= count; ++k) {
      path.points.push_back(
          {pose_along(from, arc, radius_, length * k / count), arc.turn != 0, arc.length < 0.0});
    }
  }

  const CurveChecker& checker_;
  Pose2 from_;
  double radius_, step_;  ///< In cells.
};

std::optional<TravelPath> shortest_exit(const Shuffle& shuffle, int margin) {
  std::optional<TravelPath> shortest;
  for (const int side : {-1, 1}) {
    for (const int gear : {-1, 1}) {
      auto path = shuffle.leave(side, gear, margin);
      if (!path) continue;
      if (!shortest || path->points.size() < shortest->points.size()) shortest = std::move(path);
    }
  }
  return shortest;
}

}  // namespace

std::optional<TravelPath> path_out_of_slot(const CurveChecker& checker, const Pose2& from,
                                           double radius) {
  const Shuffle shuffle(checker, from, radius);
  if (!checker.is_free(from) || !shuffle.is_tight()) return std::nullopt;
  for (const int margin : kMargins) {
    if (auto path = shortest_exit(shuffle, margin)) return path;
  }
  return std::nullopt;
}

}  // namespace trident::nav
