// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vrx_hull.h"

#include <algorithm>

#include "hull.h"

namespace trident::sim {
namespace {

constexpr double kVrxGravity = 9.815;

}  // namespace

VrxHull::VrxHull(const HullParams& params, double water_density) : density_(water_density) {
  for (const double y : params.offsets) {
    for (const HullSection& section : params.sections) {
      const bool is_circle = section.shape == SectionShape::kCircle;
      points_.push_back({section,
                         {section.x, y, -section.draft},
                         is_circle ? 0.5 * section.breadth : section.draft + section.freeboard});
    }
  }
}

Vector6d VrxHull::wrench(const SE3& T_world_link, const SE3& T_link_co, const Water& water,
                         double time_s) const {
  Vector6d sum = Vector6d::Zero();
  for (const Point& point : points_) {
    HullSection section = point.section;
    section.freeboard = std::max(0.0, point.highest_m - section.draft);
    const Eigen::Vector3d p_link = T_link_co * point.p_co_keel;
    const Eigen::Vector3d p_world = T_world_link * p_link;
    const double surface = water.column(p_world.head<2>(), {0.0, 0.0}, time_s).elevation_m;
    const double height = std::clamp(surface - p_world.z(), 0.0, point.highest_m);
    const double lift =
        immersion(section, height).area_m2 * section.length * density_ * kVrxGravity;
    const Eigen::Vector3d force(0.0, 0.0, lift);
    sum.head<3>() += force;
    sum.tail<3>() += (T_world_link.R * p_link).cross(force);
  }
  return sum;
}

}  // namespace trident::sim
