// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/utc.h"

#include <ros/param.h>

namespace trident::bridges {

std::string read_utc_start() {
  std::string start = UtcClock::kDefaultStart;
  ros::param::get("/gazebo/utc_start", start);
  return start;
}

std::int64_t unix_ns_of(const UtcClock& clock, const ros::Time& stamp) {
  const auto ns = static_cast<std::int64_t>(stamp.toNSec());
  return ros::Time::isSimTime() ? clock.unix_ns_at({ns}) : ns;
}

}  // namespace trident::bridges
