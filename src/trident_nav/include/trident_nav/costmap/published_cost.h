// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// The value of a cost in a nav_msgs/OccupancyGrid, as costmap_2d publishes it: 0 free, 1 to 98 for
/// 1 to 252, 99 inscribed, 100 lethal, -1 unknown.
constexpr std::int8_t published_cost(std::uint8_t cost) {
  if (cost == kFreeCost) return 0;
  if (cost == kInscribedCost) return 99;
  if (cost == kLethalCost) return 100;
  if (cost == kUnknownCost) return -1;
  return static_cast<std::int8_t>(1 + 97 * (cost - 1) / 251);
}

}  // namespace trident::nav
