// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/fence.h"

#include <algorithm>

#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

bool contains(const Fence::Region& region, const Eigen::Vector2d& point) {
  if (region.corners_m.empty()) return (point - region.center_m).norm() <= region.radius_m;
  return is_inside(region.corners_m, point);
}

std::string text_of(const Eigen::Vector2d& p) {
  return "(" + number_text(p.x()) + ", " + number_text(p.y()) + ") m";
}

/// The first region that is not kept.
std::optional<std::string> region_breach(const std::vector<Fence::Region>& regions,
                                         const Eigen::Vector2d& point) {
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (contains(regions[i], point) == regions[i].is_inclusion) continue;
    return "fence: " + text_of(point) + " is " +
           (regions[i].is_inclusion ? "outside of inclusion " : "inside of exclusion ") +
           std::to_string(i);
  }
  return std::nullopt;
}

}  // namespace

bool is_inside(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) inside = !inside;
  }
  return inside;
}

std::optional<std::string> Fence::breach(const Eigen::Vector3d& p_world_m) const {
  const Eigen::Vector3d from_home = p_world_m - home_m;
  const double distance = from_home.head<2>().norm();
  if (radius_m > 0.0 && distance > radius_m) {
    return "fence: " + number_text(distance) + " m from home, limit " + number_text(radius_m) +
           " m";
  }
  if (height_m > 0.0 && from_home.z() > height_m) {
    return "fence: " + number_text(from_home.z()) + " m above home, limit " +
           number_text(height_m) + " m";
  }
  return region_breach(regions, p_world_m.head<2>());
}

std::string problem_of(const Fence::Region& region) {
  const auto& corners = region.corners_m;
  if (corners.empty()) {
    if (region.radius_m > 0.0 && region.center_m.allFinite()) return "";
    return "radius " + number_text(region.radius_m) + " m, legal: above 0, around a finite center";
  }
  if (corners.size() < 3) return std::to_string(corners.size()) + " corners, legal: 3 or more";
  const bool are_finite = std::all_of(corners.begin(), corners.end(),
                                      [](const auto& corner) { return corner.allFinite(); });
  return are_finite ? "" : "a corner is not finite";
}

}  // namespace trident::bridges
