// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// What a cell's length of travel costs, in lengths of cells.
struct TravelCosts {
  std::array<float, 256> factor{};  ///< By the costmap's cost at the base.
  float turning = 1.0F;             ///< Factor of arcs.
  float change = 0.0F;              ///< Added to it where the side of turning changes.
  float reversing = 1.0F;           ///< Factor of backward motion.

  /// `base` + `penalty` times the share of 252, or of its square; unknown cells count 252.
  void fill(double base, double penalty, bool is_quadratic) {
    for (int c = 0; c < 256; ++c) {
      const double share = c >= kInscribedCost ? 1.0 : c / 252.0;
      factor[static_cast<std::size_t>(c)] =
          static_cast<float>(base + penalty * (is_quadratic ? share * share : share));
    }
  }
  float direction(bool turns, bool reverses) const {
    return (turns ? turning : 1.0F) * (reverses ? reversing : 1.0F);
  }
};

}  // namespace trident::nav
