// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <string>

#include "trident_base/utc_clock.h"

namespace trident::bridges {

/// UTC at simulated time 0: what /gazebo/utc_start says, else UtcClock::kDefaultStart.
std::string read_utc_start();
/// The UTC of a stamp: that of simulated time, or of the machine where time is not simulated
/// [ns since 1970].
std::int64_t unix_ns_of(const UtcClock& clock, const ros::Time& stamp);

}  // namespace trident::bridges
