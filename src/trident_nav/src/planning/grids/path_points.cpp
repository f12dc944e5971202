// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/path_points.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {

Path poses_along(const std::vector<Point2>& points, double spacing_m, double last_yaw) {
  Path path;
  if (points.empty()) return path;
  path.push_back({points.front().x, points.front().y, last_yaw});
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point2& a = points[i - 1];
    const Point2& b = points[i];
    const double length = distance(a.x, a.y, b.x, b.y);
    if (length <= 0.0) continue;
    const int parts = std::max(1, static_cast<int>(std::ceil(length / spacing_m - 1e-6)));
    for (int k = 1; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const Point2 p = k == parts ? b : Point2{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
      path.push_back({p.x, p.y, last_yaw});
    }
  }
  orient_forward(path);
  path.back().yaw = last_yaw;
  return path;
}

void orient_forward(Path& path) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double dx = path[i + 1].x - path[i].x;
    const double dy = path[i + 1].y - path[i].y;
    if (dx != 0.0 || dy != 0.0) path[i].yaw = std::atan2(dy, dx);
  }
}

double path_length(const Path& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    sum += distance(path[i - 1].x, path[i - 1].y, path[i].x, path[i].y);
  }
  return sum;
}

}  // namespace trident::nav
