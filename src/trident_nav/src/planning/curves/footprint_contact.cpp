// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/footprint_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trident::nav {
namespace {

constexpr double kSqrt2 = 1.41421356237309504880;
/// Touching is not covering: polygons are taken smaller by this [cells].
constexpr double kTouch = 1e-9;
/// Convex footprints over more rows of cells take the slower path.
constexpr int kMaxRows = 128;

/// A polygon in cells of the grid.
struct CellPolygon {
  std::vector<Point2> points;
  double low_y = std::numeric_limits<double>::infinity();
  double high_y = -low_y;
};

void place(const GridGeometry& g, const Footprint& footprint, const Pose2& pose,
           CellPolygon& polygon) {
  const double c = std::cos(pose.yaw) / g.resolution;
  const double s = std::sin(pose.yaw) / g.resolution;
  const double x = (pose.x - g.origin_x) / g.resolution;
  const double y = (pose.y - g.origin_y) / g.resolution;
  polygon.points.clear();
  polygon.low_y = std::numeric_limits<double>::infinity();
  polygon.high_y = -polygon.low_y;
  for (const Point2& p : footprint.points) {
    const Point2 at{x + c * p.x - s * p.y, y + s * p.x + c * p.y};
    polygon.points.push_back(at);
    polygon.low_y = std::min(polygon.low_y, at.y);
    polygon.high_y = std::max(polygon.high_y, at.y);
  }
}

/// The extent in x of the part of an edge that lies in the rows [low, high]; empty: from > to.
std::array<double, 2> clip(const Point2& a, const Point2& b, double low, double high) {
  if (std::max(a.y, b.y) <= low || std::min(a.y, b.y) >= high) return {1.0, 0.0};
  const auto x_at = [&](double y) { return a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y); };
  const double xa = a.y < low ? x_at(low) : a.y > high ? x_at(high) : a.x;
  const double xb = b.y < low ? x_at(low) : b.y > high ? x_at(high) : b.x;
  return {std::min(xa, xb), std::max(xa, xb)};
}

/// Where the line at height y crosses the polygon, in order.
void crossings(const CellPolygon& polygon, double y, std::vector<double>& xs) {
  xs.clear();
  for (std::size_t i = 0, n = polygon.points.size(); i < n; ++i) {
    const Point2& a = polygon.points[i];
    const Point2& b = polygon.points[(i + 1) % n];
    if ((a.y <= y) == (b.y <= y)) continue;
    xs.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
  }
  std::sort(xs.begin(), xs.end());
}

/// Whether all corners turn to the same side.
bool is_convex(const Footprint& footprint) {
  const std::vector<Point2>& p = footprint.points;
  bool left = false, right = false;
  for (std::size_t i = 0, n = p.size(); i < n; ++i) {
    const Point2 &a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
    const double turn = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    left |= turn > 0.0;
    right |= turn < 0.0;
  }
  return left != right;
}

/// What a convex polygon covers of each row of cells.
class ConvexRows {
 public:
  explicit ConvexRows(const CellPolygon& polygon)
      : first_(static_cast<int>(std::floor(polygon.low_y + kTouch))),
        last_(static_cast<int>(std::ceil(polygon.high_y - kTouch)) - 1) {
    for (int i = 0; i <= last_ - first_; ++i) {
      low_[i] = std::numeric_limits<double>::infinity();
      high_[i] = -low_[i];
    }
    for (std::size_t i = 0, n = polygon.points.size(); i < n; ++i) {
      add(polygon.points[i], polygon.points[i + 1 < n ? i + 1 : 0]);
    }
  }
  int first() const { return first_; }
  int last() const { return last_; }
  double low(int y) const { return low_[y - first_]; }
  double high(int y) const { return high_[y - first_]; }

 private:
  void add(const Point2& a, const Point2& b) {
    const Point2& down = a.y < b.y ? a : b;
    const Point2& up = a.y < b.y ? b : a;
    const int from = std::max(first_, static_cast<int>(std::floor(down.y + kTouch)));
    const int to = std::min(last_, static_cast<int>(std::ceil(up.y - kTouch)) - 1);
    const double slope = up.y > down.y ? (up.x - down.x) / (up.y - down.y) : 0.0;
    for (int y = from; y <= to; ++y) {
      const double x0 = y + kTouch <= down.y ? down.x : down.x + slope * (y + kTouch - down.y);
      const double x1 = y + 1 - kTouch >= up.y ? up.x : down.x + slope * (y + 1 - kTouch - down.y);
      low_[y - first_] = std::min({low_[y - first_], x0, x1});
      high_[y - first_] = std::max({high_[y - first_], x0, x1});
    }
  }

  int first_, last_;
  std::array<double, kMaxRows> low_, high_;
};

}  // namespace

FootprintContact::FootprintContact(const CostGrid& grid, const Footprint& footprint,
                                   Unknown unknown)
    : grid_(grid),
      footprint_(footprint),
      unknown_blocks_(unknown == Unknown::kBlocked),
      words_((grid.geometry.width + 63) / 64) {
  if (footprint_.points.empty()) return;
  is_convex_ = is_convex(footprint_) &&
               2.0 * footprint_.circumscribed_radius < (kMaxRows - 2) * grid.geometry.resolution;
  blocked_.assign(static_cast<std::size_t>(words_) * grid.geometry.height, 0);
  for (int y = 0; y < grid.geometry.height; ++y) {
    const std::uint8_t* row = grid.cost + grid.geometry.index({0, y});
    std::uint64_t* bits = &blocked_[static_cast<std::size_t>(y) * words_];
    for (int x = 0; x < grid.geometry.width; ++x) {
      bits[x >> 6] |= std::uint64_t{blocks(row[x])} << (static_cast<unsigned>(x) & 63U);
    }
  }
}

double FootprintContact::margin(const Pose2& pose) const {
  const GridGeometry& g = grid_.geometry;
  const Cell c = g.cell(pose.x, pose.y);
  if (grid_.distance_m == nullptr || unknown_blocks_ || !g.contains(c)) return 0.0;
  // From the base to the nearest corner of the nearest lethal cell.
  const double clear = grid_.distance_m[g.index(c)] - kSqrt2 * g.resolution;
  const double border = std::min({pose.x - g.origin_x, pose.y - g.origin_y,
                                  g.origin_x + g.width * g.resolution - pose.x,
                                  g.origin_y + g.height * g.resolution - pose.y});
  return std::max(0.0, std::min(clear, border) - footprint_.circumscribed_radius);
}

bool FootprintContact::circle_in_contact(const Pose2& pose) const {
  const std::uint8_t cost = grid_.at(pose.x, pose.y);
  if (!grid_.geometry.contains(grid_.geometry.cell(pose.x, pose.y))) return true;
  if (cost == kUnknownCost) return unknown_blocks_;
  if (cost < kInscribedCost || !ignores_) return cost >= kInscribedCost;
  const double reach = footprint_.inscribed_radius * (cost == kLethalCost ? 1.0 : 2.0);
  return distance(pose.x, pose.y, ignored_.x, ignored_.y) > reach;
}

bool FootprintContact::in_contact(const Pose2& pose) const {
  if (footprint_.points.empty()) return circle_in_contact(pose);
  if (margin(pose) > 0.0) return false;
  if (is_convex_) return convex_in_contact(pose);
  return any_span(pose, [this](int y, Span span) { return row_blocked(y, span); });
}

const Footprint& FootprintContact::footprint_at(const Pose2& pose) const {
  if (smaller_.points.empty()) return footprint_;
  const double reach = 2.0 * footprint_.circumscribed_radius;
  return distance(pose.x, pose.y, left_.x, left_.y) < reach ? smaller_ : footprint_;
}

bool FootprintContact::let_leave(const Pose2& pose, double depth_m) {
  const double scale = 1.0 - depth_m / footprint_.inscribed_radius;
  if (footprint_.points.empty() || !(scale > 0.0)) return false;
  smaller_ = footprint_;
  for (Point2& p : smaller_.points) p = {scale * p.x, scale * p.y};
  left_ = pose;
  if (!in_contact(pose)) return true;
  smaller_.points.clear();
  return false;
}

// Calls visit(row, span) for the cells that the polygon covers, until it returns true.
template <class Visit>
bool FootprintContact::any_span(const Pose2& pose, Visit&& visit) const {
  static thread_local CellPolygon polygon;
  static thread_local std::vector<double> xs;
  place(grid_.geometry, footprint_at(pose), pose, polygon);
  const int first = static_cast<int>(std::floor(polygon.low_y + kTouch));
  const int last = static_cast<int>(std::ceil(polygon.high_y - kTouch)) - 1;
  const auto to_span = [](double low, double high) {
    return Span{static_cast<int>(std::floor(low + kTouch)),
                std::max(static_cast<int>(std::ceil(high - kTouch)) - 1,
                         static_cast<int>(std::floor(low + kTouch)))};
  };
  for (int y = first; y <= last; ++y) {
    for (std::size_t i = 0, n = polygon.points.size(); i < n; ++i) {
      const auto part =
          clip(polygon.points[i], polygon.points[(i + 1) % n], y + kTouch, y + 1 - kTouch);
      if (part[0] <= part[1] && visit(y, to_span(part[0], part[1]))) return true;
    }
    crossings(polygon, y + 0.5, xs);
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      if (visit(y, to_span(xs[i], xs[i + 1]))) return true;
    }
  }
  return false;
}

bool FootprintContact::convex_in_contact(const Pose2& pose) const {
  static thread_local CellPolygon polygon;
  place(grid_.geometry, footprint_at(pose), pose, polygon);
  const ConvexRows rows(polygon);
  for (int y = rows.first(); y <= rows.last(); ++y) {
    const int from = static_cast<int>(std::floor(rows.low(y) + kTouch));
    const int to = static_cast<int>(std::ceil(rows.high(y) - kTouch)) - 1;
    if (row_blocked(y, {from, std::max(from, to)})) return true;
  }
  return false;
}

bool FootprintContact::row_blocked(int y, Span span) const {
  const GridGeometry& g = grid_.geometry;
  if (y < 0 || y >= g.height || span.from < 0 || span.to >= g.width) return true;
  const std::uint64_t* bits = &blocked_[static_cast<std::size_t>(y) * words_];
  const int first = span.from >> 6;
  const int last = span.to >> 6;
  const std::uint64_t head = ~std::uint64_t{0} << (static_cast<unsigned>(span.from) & 63U);
  const std::uint64_t tail = ~std::uint64_t{0} >> (63U - (static_cast<unsigned>(span.to) & 63U));
  if (first == last) return (bits[first] & head & tail) != 0;
  for (int w = first + 1; w < last; ++w) {
    if (bits[w] != 0) return true;
  }
  return (bits[first] & head) != 0 || (bits[last] & tail) != 0;
}

void FootprintContact::ignore_under(const Pose2& pose) {
  ignores_ = true;
  ignored_ = pose;
  if (footprint_.points.empty()) return;
  any_span(pose, [this](int y, Span span) {
    const GridGeometry& g = grid_.geometry;
    if (y < 0 || y >= g.height) return false;
    for (int x = std::max(0, span.from); x <= std::min(g.width - 1, span.to); ++x) {
      blocked_[static_cast<std::size_t>(y) * words_ + static_cast<std::size_t>(x >> 6)] &=
          ~(std::uint64_t{1} << (static_cast<unsigned>(x) & 63U));
    }
    return false;
  });
}

Footprint completed(Footprint footprint) {
  if (footprint.points.size() < 3) return footprint;
  double area = 0.0;
  footprint.circumscribed_radius = 0.0;
  footprint.inscribed_radius = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, n = footprint.points.size(); i < n; ++i) {
    const Point2& a = footprint.points[i];
    const Point2& b = footprint.points[(i + 1) % n];
    area += a.x * b.y - b.x * a.y;
    const double length = distance(a.x, a.y, b.x, b.y);
    footprint.circumscribed_radius = std::max(footprint.circumscribed_radius, std::hypot(a.x, a.y));
    if (length <= 0.0) continue;
    const double t =
        std::clamp(-(a.x * (b.x - a.x) + a.y * (b.y - a.y)) / (length * length), 0.0, 1.0);
    footprint.inscribed_radius = std::min(footprint.inscribed_radius,
                                          std::hypot(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)));
  }
  if (area < 0.0) std::reverse(footprint.points.begin(), footprint.points.end());
  return footprint;
}

}  // namespace trident::nav
