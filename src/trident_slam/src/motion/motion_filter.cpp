// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "motion_filter.h"

#include <cmath>

namespace trident::slam {

bool MotionFilter::is_due(double meters, double radians, double seconds) const {
  return meters >= options_.distance || std::abs(radians) >= options_.heading ||
         (options_.period >= 0.0 && seconds >= options_.period);
}

}  // namespace trident::slam
