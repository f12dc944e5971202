// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace trident::nav {

/// What one cell's length through a cell costs a planner, by the cell's cost in the costmap.
/// Infinite: the cell is not entered.
struct StepCosts {
  static constexpr float kBlocked = std::numeric_limits<float>::infinity();

  std::array<float, 256> step;

  /// All cells are blocked.
  StepCosts() { step.fill(kBlocked); }
  bool blocked(std::uint8_t cost) const { return step[cost] == kBlocked; }
  /// The lowest of all; infinite when all cells are blocked.
  float least() const {
    float result = kBlocked;
    for (const float value : step) result = value < result ? value : result;
    return result;
  }
};

}  // namespace trident::nav
