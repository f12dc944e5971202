// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trident_base/mutex.h"
#include "trident_ros/process_cores.h"
#include "vehicle_link.h"

namespace trident::sim {

/// Pins each controller's process to one core where there is not a core for each of them.
class ControllerCores {
 public:
  explicit ControllerCores(LockstepHub& hub) : hub_(hub) {}

  /// Pins the controllers that came since the last call; `vehicles` is the number of links.
  void pin(std::size_t vehicles) TRIDENT_EXCLUDES(hub_.mutex);

 private:
  LockstepHub& hub_;
  ros_utils::ProcessCores cores_;
  std::uint64_t newest_link_ = 0;  ///< Of the controllers that were seen.
};

}  // namespace trident::sim
