// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace trident::nav {

/// Of a diagonal step [cells].
constexpr double kDiagonal = 1.41421356237309504880;

// Directions in a grid: east, north, west, south, then north-east, north-west, south-west,
// south-east.
constexpr std::array<int, 8> kDx{1, 0, -1, 0, 1, -1, -1, 1};
constexpr std::array<int, 8> kDy{0, 1, 0, -1, 1, 1, -1, -1};
/// The directions of the two cells that diagonal step 4 + i passes between.
constexpr std::array<std::array<int, 2>, 4> kCut{{{0, 1}, {2, 1}, {2, 3}, {0, 3}}};

constexpr int opposite(int direction) {
  return direction < 4 ? (direction + 2) % 4 : 4 + (direction - 2) % 4;
}

/// The diagonal direction between two straight ones next to each other.
constexpr int between(int a, int b) {
  const int least = a < b ? a : b;
  const int most = a < b ? b : a;
  return least == 0 && most == 3 ? 7 : 4 + least;
}

}  // namespace trident::nav
