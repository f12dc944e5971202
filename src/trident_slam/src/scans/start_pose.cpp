// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "start_pose.h"

#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

constexpr double kFarFromMap = 1000.0;  // [m]
constexpr double kFarFromOrigin = 1e5;  // [m]; single floats resolve 8 mm there

}  // namespace

void check_start_pose(const SE2& T_map_base, const Eigen::AlignedBox2d& mapped) {
  const std::string pose = "pose (" + number_text(T_map_base.p.x()) + ", " +
                           number_text(T_map_base.p.y()) + ") m, " + number_text(T_map_base.angle) +
                           " rad";
  const bool is_near =
      std::abs(T_map_base.p.x()) <= kFarFromOrigin && std::abs(T_map_base.p.y()) <= kFarFromOrigin;
  if (!is_near || !std::isfinite(T_map_base.angle)) {
    throw Error(pose + ", legal: finite, up to " + number_text(kFarFromOrigin) +
                " m from the map's origin");
  }
  if (mapped.isEmpty()) return;
  const double away = mapped.exteriorDistance(T_map_base.p);
  if (away <= kFarFromMap) return;
  throw Error(pose + " is " + number_text(std::round(away)) + " m from the map, legal: up to " +
              number_text(kFarFromMap) + " m");
}

}  // namespace trident::slam
