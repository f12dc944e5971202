// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "trident_base/string_util.h"

namespace trident::bridges {

/// MAV_SEVERITY of what an autopilot says.
constexpr int kSeverityError = 3;
constexpr int kSeverityWarning = 4;
constexpr int kSeverityInfo = 6;

/// A share of 1 as "12.5 %".
inline std::string percent_text(double share) {
  return number_text(std::round(1000.0 * share) / 10.0) + " %";
}

}  // namespace trident::bridges
