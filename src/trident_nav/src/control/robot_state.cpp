// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/robot_state.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {

double Track::position_sigma(double after_s) const {
  const auto variance = [&](std::size_t row, std::size_t column) {
    return covariance[4 * row + column] +
           after_s * (covariance[4 * row + column + 2] + covariance[4 * (row + 2) + column]) +
           after_s * after_s * covariance[4 * (row + 2) + column + 2];
  };
  const double xx = variance(0, 0);
  const double yy = variance(1, 1);
  const double xy = variance(0, 1);
  // The greater eigenvalue of the predicted position's covariance.
  const double greater = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  return std::sqrt(std::max(greater, 0.0));
}

}  // namespace trident::nav
