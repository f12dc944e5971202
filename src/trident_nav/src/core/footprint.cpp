// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/core/footprint.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::nav {
namespace {

constexpr int kCircleCorners = 16;
constexpr double kFarthest_m = 1000.0;  // of a corner, in each coordinate

std::string corner_text(const Point2& p) {
  return '[' + number_text(p.x) + ", " + number_text(p.y) + ']';
}

double cross(const Point2& o, const Point2& a, const Point2& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

bool is_between(const Point2& p, const Point2& a, const Point2& b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Whether two points lie on different sides of a line, and neither on it.
bool are_apart(double side, double other_side) {
  return side != 0 && other_side != 0 && (side > 0) != (other_side > 0);
}

/// Whether a point is on a segment; `side`: of the line through the segment, 0 on it.
bool is_on(const Point2& p, double side, const Point2& a, const Point2& b) {
  return side == 0 && is_between(p, a, b);
}

/// True when two segments have a point in common.
bool segments_intersect(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const double c_side = cross(a, b, c), d_side = cross(a, b, d);
  const double a_side = cross(c, d, a), b_side = cross(c, d, b);
  if (are_apart(c_side, d_side) && are_apart(a_side, b_side)) return true;
  return is_on(c, c_side, a, b) || is_on(d, d_side, a, b) || is_on(a, a_side, c, d) ||
         is_on(b, b_side, c, d);
}

double twice_area(const std::vector<Point2>& points) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2& next = points[(i + 1) % points.size()];
    sum += points[i].x * next.y - next.x * points[i].y;
  }
  return sum;
}

double distance_to_segment(const Point2& a, const Point2& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double along = square > 0.0 ? std::clamp(-(a.x * dx + a.y * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(a.x + along * dx, a.y + along * dy);
}

/// Even-odd rule for the origin.
bool contains_origin(const std::vector<Point2>& points) {
  bool inside = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 &a = points[i], &b = points[(i + 1) % points.size()];
    if ((a.y > 0) != (b.y > 0) && a.x - a.y * (b.x - a.x) / (b.y - a.y) > 0) inside = !inside;
  }
  return inside;
}

void require_corners(const std::vector<Point2>& points) {
  if (points.size() < 3) {
    throw Error("a footprint polygon must have at least 3 corners, this one has " +
                std::to_string(points.size()));
  }
  for (const Point2& p : points) {
    if (!(std::fabs(p.x) <= kFarthest_m) || !(std::fabs(p.y) <= kFarthest_m)) {
      throw Error("the footprint corner " + corner_text(p) + " must be finite, up to +-1000 m");
    }
  }
}

void require_simple(const std::vector<Point2>& points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbors share a corner
      const Point2 &a = points[i], &b = points[i + 1], &c = points[j], &d = points[(j + 1) % n];
      if (segments_intersect(a, b, c, d)) {
        throw Error("the footprint's edge from " + corner_text(a) + " to " + corner_text(b) +
                    " touches that from " + corner_text(c) + " to " + corner_text(d) +
                    "; edges must not cross");
      }
    }
  }
}

double sign(double value) { return value > 0.0 ? 1.0 : (value < 0.0 ? -1.0 : 0.0); }

/// Reads "[x, y]" and "[[x, y], ...]".
class PolygonText {
 public:
  explicit PolygonText(const std::string& text) : text_(text) {}

  /// A list of [x, y], as the parameter `footprint` of costmap_2d holds it in a string.
  std::vector<Point2> read() {
    std::vector<Point2> points;
    expect('[');
    if (!accept(']')) {
      do {
        points.push_back(read_corner());
      } while (accept(','));
      expect(']');
    }
    skip_blanks();
    if (at_ != text_.size()) fail("the end");
    return points;
  }

 private:
  Point2 read_corner() {
    Point2 p;
    expect('[');
    p.x = read_number();
    expect(',');
    p.y = read_number();
    expect(']');
    return p;
  }
  double read_number() {
    skip_blanks();
    const char* begin = text_.c_str() + at_;
    char* end = nullptr;
    const double value = std::strtod(begin, &end);
    if (end == begin || !std::isfinite(value)) fail("a finite number");
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool accept(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(std::string("'") + c + "'");
  }
  [[noreturn]] void fail(const std::string& wanted) const {
    const std::string rest = at_ < text_.size() ? "'" + text_.substr(at_, 20) + "'" : "its end";
    throw Error("the footprint '" + text_ + "' must have the form [[x, y], [x, y], ...]: " +
                wanted + " is expected, not " + rest);
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

/// Where the two edges at a corner of a counter-clockwise polygon intersect once they are moved.
Point2 moved_corner(const Point2& before, const Point2& corner, const Point2& after,
                    double distance) {
  const double ax = corner.x - before.x, ay = corner.y - before.y;
  const double bx = after.x - corner.x, by = after.y - corner.y;
  const double a = std::hypot(ax, ay), b = std::hypot(bx, by);
  // Outward normals.
  const Point2 n{ay / a, -ax / a}, m{by / b, -bx / b};
  constexpr double kSharpest = 0.2;
  const double scale = distance / std::max(1.0 + n.x * m.x + n.y * m.y, kSharpest);
  return {corner.x + scale * (n.x + m.x), corner.y + scale * (n.y + m.y)};
}

}  // namespace

/// Corners are turned counter-clockwise. The inscribed radius is the distance from the base's
/// origin to the nearest side, the circumscribed one that to the farthest corner, as costmap_2d has
/// them.
Footprint polygon_footprint(std::vector<Point2> points) {
  require_corners(points);
  require_simple(points);
  const double area = twice_area(points);
  if (area == 0.0) throw Error("the footprint polygon has no area");
  if (area < 0.0) std::reverse(points.begin(), points.end());
  Footprint result;
  result.inscribed_radius = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 &a = points[i], &b = points[(i + 1) % points.size()];
    result.inscribed_radius = std::min(result.inscribed_radius, distance_to_segment(a, b));
    result.circumscribed_radius = std::max(result.circumscribed_radius, std::hypot(a.x, a.y));
  }
  if (!contains_origin(points) || result.inscribed_radius <= 0.0) {
    throw Error("the footprint polygon must have the base's origin [0, 0] inside");
  }
  result.points = std::move(points);
  return result;
}

Footprint circle_footprint(double radius) {
  if (!(radius > 0.0) || !std::isfinite(radius)) {
    throw Error("the robot's radius is " + number_text(radius) + " m; it must be > 0");
  }
  return {{}, radius, radius};
}

std::vector<Point2> parse_polygon(const std::string& text) { return PolygonText(text).read(); }

Footprint padded_footprint(const Footprint& footprint, double padding) {
  if (!std::isfinite(padding)) throw Error("footprint_padding must be a finite number");
  if (footprint.points.empty()) return circle_footprint(footprint.inscribed_radius + padding);
  std::vector<Point2> points = footprint.points;
  for (Point2& p : points) {
    p.x += sign(p.x) * padding;
    p.y += sign(p.y) * padding;
  }
  return polygon_footprint(std::move(points));
}

namespace {

/// Nothing where the moved sides are no polygon.
std::optional<Footprint> with_moved_sides(const std::vector<Point2>& points, double distance) {
  const std::size_t n = points.size();
  std::vector<Point2> moved;
  for (std::size_t i = 0; i < n; ++i) {
    moved.push_back(
        moved_corner(points[(i + n - 1) % n], points[i], points[(i + 1) % n], distance));
  }
  try {
    return polygon_footprint(std::move(moved));
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Counter-clockwise; the monotone chain of A. Andrew, "Another efficient algorithm for convex
/// hulls in two dimensions", Information Processing Letters 9(5), 1979.
std::vector<Point2> convex_hull(std::vector<Point2> points) {
  std::sort(points.begin(), points.end(), [](const Point2& a, const Point2& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  });
  std::vector<Point2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();  // the other side begins there
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace

// The sides of a notch that is narrower than twice the distance cross each other once moved.
Footprint grown_footprint(const Footprint& footprint, double distance) {
  if (footprint.points.empty()) return circle_footprint(footprint.circumscribed_radius + distance);
  if (const auto grown = with_moved_sides(footprint.points, distance)) return *grown;
  if (const auto grown = with_moved_sides(convex_hull(footprint.points), distance)) return *grown;
  return circle_footprint(footprint.circumscribed_radius + distance);
}

std::vector<Point2> footprint_corners(const Footprint& footprint, const Pose2& pose) {
  std::vector<Point2> corners;
  for (const Point2& p : footprint.points) corners.push_back(transform(pose, p));
  if (!corners.empty()) return corners;
  constexpr double kTurn = 2.0 * 3.14159265358979323846 / kCircleCorners;
  for (int i = 0; i < kCircleCorners; ++i) {
    const double r = footprint.inscribed_radius;
    corners.push_back(transform(pose, {r * std::cos(i * kTurn), r * std::sin(i * kTurn)}));
  }
  return corners;
}

}  // namespace trident::nav
