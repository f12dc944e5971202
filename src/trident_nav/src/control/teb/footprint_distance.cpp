// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "footprint_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::nav {
namespace {

constexpr double kOnRim = 1e-9;  // [m]

}  // namespace

FootprintDistance::FootprintDistance(const Footprint& footprint)
    : corners_(footprint.points), reach_m_(footprint.circumscribed_radius) {
  const std::vector<Point2>& points = footprint.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2& a = points[i];
    const Point2& b = points[(i + 1) % points.size()];
    const double length_m = distance(a.x, a.y, b.x, b.y);
    edges_.push_back({a, {(b.x - a.x) / length_m, (b.y - a.y) / length_m}, length_m});
  }
}

bool FootprintDistance::contains(const Point2& point) const {
  bool is_inside = false;
  for (const Edge& edge : edges_) {
    const double y1 = edge.start.y + edge.along.y * edge.length_m;
    if ((edge.start.y > point.y) == (y1 > point.y)) continue;
    const double t = (point.y - edge.start.y) / edge.along.y;
    if (point.x < edge.start.x + edge.along.x * t) is_inside = !is_inside;
  }
  return is_inside;
}

SignedDistance FootprintDistance::to(const Point2& point) const {
  if (edges_.empty()) {
    const double d = std::hypot(point.x, point.y);
    if (d < kOnRim) return {-reach_m_, {1.0, 0.0}};
    return {d - reach_m_, {point.x / d, point.y / d}};
  }
  double nearest = std::numeric_limits<double>::infinity();
  Point2 off, along;
  for (const Edge& edge : edges_) {
    const double px = point.x - edge.start.x;
    const double py = point.y - edge.start.y;
    const double t = std::clamp(px * edge.along.x + py * edge.along.y, 0.0, edge.length_m);
    const Point2 to_point{px - t * edge.along.x, py - t * edge.along.y};
    const double square = to_point.x * to_point.x + to_point.y * to_point.y;
    if (square >= nearest) continue;
    nearest = square;
    off = to_point;
    along = edge.along;
  }
  const double d = std::sqrt(nearest);
  // On the rim the direction out is square to the edge.
  if (d < kOnRim) return {0.0, {along.y, -along.x}};
  const double sign = contains(point) ? -1.0 : 1.0;
  return {sign * d, {sign * off.x / d, sign * off.y / d}};
}

}  // namespace trident::nav
