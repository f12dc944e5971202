// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/line_cost.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

/// Walks along a line from cell to cell (Amanatides and Woo, "A fast voxel traversal algorithm for
/// ray tracing", Eurographics 1987), one axis of it. Parameters are fractions of the line.
struct Axis {
  Axis(double from, double to, int cell) {
    const double delta = to - from;
    step = delta > 0.0 ? 1 : -1;
    if (delta == 0.0) return;
    per_cell = 1.0 / std::abs(delta);
    next = (delta > 0.0 ? cell + 1 - from : from - cell) * per_cell;
  }
  static constexpr double kNever = 1e300;
  int step = 1;
  double per_cell = kNever;
  double next = kNever;  ///< Where the line leaves the cell along this axis.
};

/// The line's ends in cells, and the cells that it passes.
class LineWalk {
 public:
  LineWalk(const CostGrid& grid, const StepCosts& costs, Point2 from, Point2 to)
      : grid_(grid),
        costs_(costs),
        a_(in_cells(from)),
        b_(in_cells(to)),
        cell_{static_cast<int>(std::floor(a_.x)), static_cast<int>(std::floor(a_.y))},
        x_(a_.x, b_.x, cell_.x),
        y_(a_.y, b_.y, cell_.y) {}

  double integral(double limit) {
    const double length = std::hypot(b_.x - a_.x, b_.y - a_.y);
    double sum = 0.0;
    double at = 0.0;
    while (true) {
      const double step = cost(cell_);
      const double next = std::min({x_.next, y_.next, 1.0});
      if (step == StepCosts::kBlocked) return StepCosts::kBlocked;
      sum += (next - at) * length * step;
      if (next >= 1.0 || sum > limit) return sum > limit ? StepCosts::kBlocked : sum;
      at = next;
      if (!advance()) return StepCosts::kBlocked;
    }
  }

 private:
  Point2 in_cells(Point2 p) const {
    const GridGeometry& g = grid_.geometry;
    return {(p.x - g.origin_x) / g.resolution, (p.y - g.origin_y) / g.resolution};
  }
  double cost(Cell c) const {
    return grid_.geometry.contains(c) ? costs_.step[grid_.at(c)] : StepCosts::kBlocked;
  }
  /// To the next cell; through a corner only if both cells at its sides are free.
  bool advance() {
    constexpr double kSame = 1e-9;
    const bool corner = std::abs(x_.next - y_.next) < kSame;
    if (corner && (cost({cell_.x + x_.step, cell_.y}) == StepCosts::kBlocked ||
                   cost({cell_.x, cell_.y + y_.step}) == StepCosts::kBlocked)) {
      return false;
    }
    const bool along_x = corner || x_.next < y_.next;
    const bool along_y = corner || !along_x;
    if (along_x) {
      cell_.x += x_.step;
      x_.next += x_.per_cell;
    }
    if (along_y) {
      cell_.y += y_.step;
      y_.next += y_.per_cell;
    }
    return true;
  }

  const CostGrid& grid_;
  const StepCosts& costs_;
  Point2 a_, b_;
  Cell cell_;
  Axis x_, y_;
};

/// Costs along a path up to each point.
std::vector<double> sums(const CostGrid& grid, const StepCosts& costs,
                         const std::vector<Point2>& points) {
  std::vector<double> result(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    result[i] = result[i - 1] + line_cost(grid, costs, points[i - 1], points[i]);
  }
  return result;
}

/// Finds how far a straight line from a point can replace the path.
class Shortcut {
 public:
  Shortcut(const CostGrid& grid, const StepCosts& costs, const std::vector<Point2>& points)
      : grid_(grid), costs_(costs), points_(points), sums_(sums(grid, costs, points)) {}

  /// The index of the farthest point found by doubling, then by bisection.
  std::size_t farthest(std::size_t from) const {
    const std::size_t last = points_.size() - 1;
    std::size_t good = from + 1;
    std::size_t bad = last + 1;
    for (std::size_t reach = 2; good < last; reach *= 2) {
      const std::size_t to = std::min(from + reach, last);
      if (!possible(from, to)) {
        bad = to;
        break;
      }
      good = to;
    }
    while (good + 1 < bad) {
      const std::size_t middle = good + (bad - good) / 2;
      (possible(from, middle) ? good : bad) = middle;
    }
    return good;
  }

 private:
  bool possible(std::size_t from, std::size_t to) const {
    const double now = sums_[to] - sums_[from];
    const double allowed = now * (1.0 + 1e-9);
    return line_cost(grid_, costs_, points_[from], points_[to], allowed) <= allowed;
  }

  const CostGrid& grid_;
  const StepCosts& costs_;
  const std::vector<Point2>& points_;
  std::vector<double> sums_;
};

}  // namespace

double line_cost(const CostGrid& grid, const StepCosts& costs, Point2 from, Point2 to,
                 double limit) {
  return LineWalk(grid, costs, from, to).integral(limit);
}

double path_cost(const CostGrid& grid, const StepCosts& costs, const std::vector<Point2>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    sum += line_cost(grid, costs, points[i - 1], points[i]);
  }
  return sum;
}

std::vector<Point2> pull_taut(const CostGrid& grid, const StepCosts& costs,
                              const std::vector<Point2>& points) {
  if (points.size() < 3) return points;
  const Shortcut shortcut(grid, costs, points);
  std::vector<Point2> result{points.front()};
  for (std::size_t i = 0; i + 1 < points.size();) {
    i = shortcut.farthest(i);
    result.push_back(points[i]);
  }
  return result;
}

}  // namespace trident::nav
