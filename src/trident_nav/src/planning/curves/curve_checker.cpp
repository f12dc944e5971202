// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/curve_checker.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::nav {
namespace {

/// Poses along a curve at even distances within each segment; calls visit(pose, segment, step in
/// cells) until it returns false.
template <class Visit>
bool walk(const MotionCurve& curve, const Pose2& from, double spacing, Visit&& visit) {
  Pose2 start = from;
  for (int i = 0; i < curve.size(); ++i) {
    const double length = curve.radius() * std::abs(curve[i].length);
    const int count = std::max(1, static_cast<int>(std::ceil(length / spacing)));
    for (int k = 1; k <= count; ++k) {
      const Pose2 pose = pose_along(start, curve[i], curve.radius(), length * k / count);
      if (!visit(pose, curve[i], length / count)) return false;
      if (k == count) start = pose;
    }
  }
  return true;
}

}  // namespace

bool CurveChecker::is_free(const Pose2& from, const Pose2* poses, std::size_t count, double cos,
                           double sin) const {
  const double resolution = grid_.geometry.resolution;
  // From the end backwards: it is the likeliest to be in contact.
  for (std::size_t i = count; i > 0;) {
    const Pose2& p = poses[--i];
    const Pose2 pose = to_metric(
        {from.x + cos * p.x - sin * p.y, from.y + sin * p.x + cos * p.y, from.yaw + p.yaw});
    const double margin = contact_.margin(pose) / resolution;
    if (margin <= 0.0 && contact_.in_contact(pose)) return false;
    const double margin2 = margin * margin;
    const auto gap2 = [&](const Pose2& q) {
      return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
    };
    while (i > 0 && gap2(poses[i - 1]) < margin2) --i;
  }
  return true;
}

bool CurveChecker::is_free(const MotionCurve& curve, const Pose2& from) const {
  const double spacing = kCheckSpacing / grid_.geometry.resolution;
  double clear = 0.0;  // Cells that can be travelled without a look.
  return walk(curve, from, spacing, [&](const Pose2& pose, const CurveSegment&, double step) {
    clear -= step;
    if (clear > 0.0) return true;
    const Pose2 metric = to_metric(pose);
    clear = contact_.margin(metric) / grid_.geometry.resolution;
    return clear > 0.0 || !contact_.in_contact(metric);
  });
}

double CurveChecker::cost(const MotionCurve& curve, const Pose2& from, int max_cost) const {
  double sum = 0.0;
  const bool inside =
      walk(curve, from, 1.0, [&](const Pose2& pose, const CurveSegment& segment, double step) {
        const Cell cell{static_cast<int>(std::floor(pose.x)), static_cast<int>(std::floor(pose.y))};
        if (!grid_.geometry.contains(cell)) return false;
        const std::uint8_t cost = grid_.at(cell);
        if (cost > max_cost && cost != kUnknownCost) return false;
        sum +=
            step * static_cast<double>(costs_.factor[cost] *
                                       costs_.direction(segment.turn != 0, segment.length < 0.0));
        return true;
      });
  return inside ? sum : std::numeric_limits<double>::infinity();
}

double CurveChecker::cost(const Pose2& from, const TravelPath::Point& to) const {
  const Cell cell{static_cast<int>(std::floor(to.pose.x)), static_cast<int>(std::floor(to.pose.y))};
  if (!grid_.geometry.contains(cell)) return std::numeric_limits<double>::infinity();
  return distance(from.x, from.y, to.pose.x, to.pose.y) *
         static_cast<double>(costs_.factor[grid_.at(cell)] *
                             costs_.direction(to.turns, to.reverses));
}

void CurveChecker::append(const MotionCurve& curve, TravelPath& path) const {
  const Pose2 from = path.points.back().pose;
  walk(curve, from, 1.0, [&](const Pose2& pose, const CurveSegment& segment, double) {
    path.points.push_back({pose, segment.turn != 0, segment.length < 0.0});
    return true;
  });
}

}  // namespace trident::nav
