// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/footprint_checker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "trident_base/error.h"

namespace trident::nav {
namespace {

constexpr double kSqrtHalf = 0.70710678118654752;

double cross(const Point2& origin, const Point2& a, const Point2& b) {
  return (a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x);
}

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double along = length2 > 0.0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0.0;
  const double t = std::clamp(along, 0.0, 1.0);
  return distance(p.x, p.y, a.x + t * dx, a.y + t * dy);
}

bool edges_cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const bool splits_cd = (cross(a, b, c) > 0.0) != (cross(a, b, d) > 0.0);
  const bool splits_ab = (cross(c, d, a) > 0.0) != (cross(c, d, b) > 0.0);
  return splits_cd && splits_ab;
}

// Neighboring edges share a point and are left out.
bool has_crossing_edges(const std::vector<Point2>& points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (edges_cross(points[i], points[i + 1], points[j], points[(j + 1) % n])) return true;
    }
  }
  return false;
}

double signed_area(const std::vector<Point2>& points) {
  double twice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2& next = points[(i + 1) % points.size()];
    twice += points[i].x * next.y - points[i].y * next.x;
  }
  return 0.5 * twice;
}

struct Square {
  double x0, y0, x1, y1;
};

Square square_of(const GridGeometry& geometry, Cell cell) {
  const double x0 = geometry.origin_x + cell.x * geometry.resolution;
  const double y0 = geometry.origin_y + cell.y * geometry.resolution;
  return {x0, y0, x0 + geometry.resolution, y0 + geometry.resolution};
}

// Narrows [t0, t1] to where start + t * step lies in [lo, hi].
bool clip(double start, double step, double lo, double hi, double* t0, double* t1) {
  if (step == 0.0) return start >= lo && start <= hi;
  const double at_lo = (lo - start) / step;
  const double at_hi = (hi - start) / step;
  *t0 = std::max(*t0, std::min(at_lo, at_hi));
  *t1 = std::min(*t1, std::max(at_lo, at_hi));
  return *t0 <= *t1;
}

bool edge_touches(const Point2& a, const Point2& b, const Square& square) {
  double t0 = 0.0;
  double t1 = 1.0;
  return clip(a.x, b.x - a.x, square.x0, square.x1, &t0, &t1) &&
         clip(a.y, b.y - a.y, square.y0, square.y1, &t0, &t1);
}

bool polygon_touches(const std::vector<Point2>& polygon, const Square& square) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (edge_touches(polygon[i], polygon[(i + 1) % polygon.size()], square)) return true;
  }
  return contains(polygon, {0.5 * (square.x0 + square.x1), 0.5 * (square.y0 + square.y1)});
}

bool circle_touches(const Pose2& center, double radius, const Square& square) {
  const double dx = std::max({square.x0 - center.x, center.x - square.x1, 0.0});
  const double dy = std::max({square.y0 - center.y, center.y - square.y1, 0.0});
  return dx * dx + dy * dy <= radius * radius;
}

std::vector<Point2> placed(const Footprint& footprint, const Pose2& pose) {
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  std::vector<Point2> points;
  points.reserve(footprint.points.size());
  for (const Point2& p : footprint.points) {
    points.push_back({pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y});
  }
  return points;
}

Square bounds(const std::vector<Point2>& points, const Pose2& pose, double radius) {
  if (points.empty()) return {pose.x - radius, pose.y - radius, pose.x + radius, pose.y + radius};
  Square box{points[0].x, points[0].y, points[0].x, points[0].y};
  for (const Point2& p : points) {
    box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x),
           std::max(box.y1, p.y)};
  }
  return box;
}

void check_polygon(const std::vector<Point2>& points) {
  if (points.size() < 3) {
    throw Error("footprint: " + std::to_string(points.size()) +
                " points; a polygon has at least 3");
  }
  for (const Point2& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      throw Error("footprint: a point (" + std::to_string(p.x) + ", " + std::to_string(p.y) +
                  ") is not finite");
    }
  }
  if (has_crossing_edges(points)) throw Error("footprint: its edges cross");
  if (!contains(points, {0.0, 0.0})) {
    throw Error("footprint: the base's origin (0, 0) is not inside");
  }
}

// Where the two edges at a corner of a counter-clockwise polygon intersect once they are moved.
Point2 moved_corner(const Point2& before, const Point2& corner, const Point2& after,
                    double padding_m) {
  const double ax = corner.x - before.x;
  const double ay = corner.y - before.y;
  const double bx = after.x - corner.x;
  const double by = after.y - corner.y;
  const double a = std::hypot(ax, ay);
  const double b = std::hypot(bx, by);
  // Outward normals.
  const Point2 n{ay / a, -ax / a};
  const Point2 m{by / b, -bx / b};
  const double scale = padding_m / std::max(1.0 + n.x * m.x + n.y * m.y, 0.2);
  return {corner.x + scale * (n.x + m.x), corner.y + scale * (n.y + m.y)};
}

}  // namespace

Footprint padded(const Footprint& footprint, double padding_m) {
  if (footprint.points.empty()) {
    return make_circle_footprint(footprint.circumscribed_radius + padding_m);
  }
  std::vector<Point2> points;
  const std::size_t n = footprint.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    points.push_back(moved_corner(footprint.points[(i + n - 1) % n], footprint.points[i],
                                  footprint.points[(i + 1) % n], padding_m));
  }
  return make_polygon_footprint(std::move(points));
}

bool contains(const std::vector<Point2>& polygon, const Point2& point) {
  bool is_inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2& a = polygon[i];
    const Point2& b = polygon[j];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) is_inside = !is_inside;
  }
  return is_inside;
}

Footprint make_polygon_footprint(std::vector<Point2> points) {
  check_polygon(points);
  if (signed_area(points) < 0.0) std::reverse(points.begin(), points.end());
  Footprint footprint;
  footprint.inscribed_radius = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2& next = points[(i + 1) % points.size()];
    footprint.inscribed_radius =
        std::min(footprint.inscribed_radius, distance_to_segment({0.0, 0.0}, points[i], next));
    footprint.circumscribed_radius =
        std::max(footprint.circumscribed_radius, std::hypot(points[i].x, points[i].y));
  }
  footprint.points = std::move(points);
  return footprint;
}

Footprint make_circle_footprint(double radius_m) {
  if (!(radius_m > 0.0) || !std::isfinite(radius_m)) {
    throw Error("robot radius: " + std::to_string(radius_m) + " is out of range (> 0 m)");
  }
  return {{}, radius_m, radius_m};
}

PolygonFootprintChecker::PolygonFootprintChecker(Footprint footprint, UnknownCells unknown)
    : footprint_(std::move(footprint)), unknown_(unknown) {}

PolygonFootprintChecker::Verdict PolygonFootprintChecker::by_distance(const CostGrid& grid,
                                                                      const Pose2& pose) const {
  const Cell cell = grid.geometry.cell(pose.x, pose.y);
  if (grid.distance_m == nullptr || !grid.geometry.contains(cell)) return Verdict::kUnclear;
  const double d = grid.distance_m[grid.geometry.index(cell)];
  // The pose is up to half a diagonal from its cell's center, and the obstacle's square reaches as
  // far beyond its own.
  const double half_diagonal = kSqrtHalf * grid.geometry.resolution;
  const bool is_cut = d >= static_cast<double>(grid.max_distance_m);
  if (!is_cut && d + half_diagonal <= footprint_.inscribed_radius) return Verdict::kContact;
  const bool is_far = d > footprint_.circumscribed_radius + 2.0 * half_diagonal;
  return is_far && unknown_ == UnknownCells::kFree ? Verdict::kFree : Verdict::kUnclear;
}

bool PolygonFootprintChecker::is_occupied(const CostGrid& grid, Cell cell) const {
  const std::uint8_t cost = grid.geometry.contains(cell) ? grid.at(cell) : kUnknownCost;
  return cost == kLethalCost || (cost == kUnknownCost && unknown_ == UnknownCells::kOccupied);
}

bool PolygonFootprintChecker::touches(const std::vector<Point2>& polygon, const Pose2& pose,
                                      const CostGrid& grid, Cell cell) const {
  const Square square = square_of(grid.geometry, cell);
  return polygon.empty() ? circle_touches(pose, footprint_.circumscribed_radius, square)
                         : polygon_touches(polygon, square);
}

bool PolygonFootprintChecker::is_free(const CostGrid& grid, const Pose2& pose) const {
  const Verdict verdict = by_distance(grid, pose);
  if (verdict != Verdict::kUnclear) return verdict == Verdict::kFree;
  const std::vector<Point2> polygon = placed(footprint_, pose);
  const Square box = bounds(polygon, pose, footprint_.circumscribed_radius);
  const Cell first = grid.geometry.cell(box.x0, box.y0);
  const Cell last = grid.geometry.cell(box.x1, box.y1);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      if (is_occupied(grid, {x, y}) && touches(polygon, pose, grid, {x, y})) return false;
    }
  }
  return true;
}

}  // namespace trident::nav
