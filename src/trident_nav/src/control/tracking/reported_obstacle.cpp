// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/reported_obstacle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trident::nav {
namespace {

constexpr double kSmall_m = 0.3;    // radius of what is one disc
constexpr double kSpacing_m = 0.2;  // of discs along an edge
constexpr int kMaxDiscs = 64;       // of an obstacle with up to 32 corners

Point2 middle_of(const std::vector<Point2>& points) {
  Point2 lo = points.front(), hi = points.front();
  for (const Point2& p : points) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  return {0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y)};
}

double reach_from(const Point2& center, const std::vector<Point2>& points) {
  double reach_m = 0.0;
  for (const Point2& p : points) {
    reach_m = std::max(reach_m, distance(center.x, center.y, p.x, p.y));
  }
  return reach_m;
}

// The centers of discs along the edges, and half of the greatest distance between two of an edge.
std::vector<Point2> along_edges(const std::vector<Point2>& outline, double* half_gap_m) {
  const std::size_t edges = outline.size() > 2 ? outline.size() : outline.size() - 1;
  double length_m = 0.0;
  for (std::size_t i = 0; i < edges; ++i) {
    const Point2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    length_m += distance(a.x, a.y, b.x, b.y);
  }
  const double spacing_m = std::max(kSpacing_m, length_m / (kMaxDiscs / 2.0));
  std::vector<Point2> centers;
  *half_gap_m = 0.0;
  for (std::size_t i = 0; i < edges; ++i) {
    const Point2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double edge_m = distance(a.x, a.y, b.x, b.y);
    const int steps = 1 + static_cast<int>(edge_m / spacing_m);
    *half_gap_m = std::max(*half_gap_m, 0.5 * edge_m / steps);
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      centers.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  if (outline.size() == 2) centers.push_back(outline.back());
  return centers;
}

}  // namespace

Tracks covering_tracks(const ReportedObstacle& obstacle) {
  if (obstacle.outline.empty()) return {};
  const Point2 middle = middle_of(obstacle.outline);
  double radius_m = reach_from(middle, obstacle.outline);
  std::vector<Point2> centers{middle};
  if (radius_m > kSmall_m) centers = along_edges(obstacle.outline, &radius_m);
  // Ids stay the same from report to report, and distinct between obstacles, within what a track's
  // id can hold.
  constexpr std::int64_t kIds = 100000;
  const auto first_id = static_cast<int>(((obstacle.id % kIds) + kIds) % kIds) * kMaxDiscs;
  Tracks tracks;
  for (const Point2& center : centers) {
    Track track;
    track.id = first_id + static_cast<int>(tracks.size()) % kMaxDiscs;
    track.position = center;
    track.velocity = obstacle.velocity;
    track.radius_m = radius_m + obstacle.radius_m;
    track.covariance[10] = obstacle.velocity_variance.x;
    track.covariance[15] = obstacle.velocity_variance.y;
    tracks.push_back(track);
  }
  return tracks;
}

}  // namespace trident::nav
