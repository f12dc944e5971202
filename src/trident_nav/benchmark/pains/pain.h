// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace trident::nav::pains {

/// One issue that users of other navigation stacks report, measured here.
struct Pain {
  std::string scene;  ///< "P4": the group of issues.
  std::string rival;  ///< An issue of theirs: "navigation#267".
  std::string what;   ///< What was measured.
  double measured = 0.0;
  double limit = 0.0;
  std::string unit;
  bool is_least = false;  ///< The limit is the least that is allowed, not the most.
  std::string note;       ///< What the number does not say; may be empty.

  bool has_passed() const { return is_least ? measured >= limit : measured <= limit; }
};
using Pains = std::vector<Pain>;

/// Boxes that come and go in a costmap of beams.
Pains obstacle_pains(bool is_quick);
/// Paths that flip, and paths that are refused though there is room.
Pains path_pains(bool is_quick);
/// MPPI's defaults on robots of several sizes.
Pains tuning_pains(bool is_quick);
/// The timed elastic band in places that it is known to fail in.
Pains band_pains(bool is_quick);
/// Planted causes of failure, and whether the texts name them.
Pains reason_pains(bool is_quick);

}  // namespace trident::nav::pains
