// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "motion_filter.h"

#include <cmath>

namespace trident::slam {

bool MotionFilter::is_due(double metres, double radians, double seconds) const {
  return metres >= options_.distance || std::abs(radians) >= options_.heading ||
         (options_.period >= 0.0 && seconds >= options_.period);
}

}  // namespace trident::slam
