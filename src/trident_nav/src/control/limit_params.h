// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace trident::nav {

/// Lowers a limit of the robot to the one of a law's parameter, where that is given. Its sign does
/// not matter: files give some limits, such as those of braking, as negative numbers.
inline void cap_limit(const std::optional<double>& param, double* limit) {
  if (param) *limit = std::min(*limit, std::fabs(*param));
}

}  // namespace trident::nav
