// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "controller_cores.h"

#include <string>

namespace trident::sim {

void ControllerCores::pin(std::size_t vehicles) {
  const std::uint64_t newest = hub_.commands.newest_link();
  // Fewer vehicles than cores leave a controller room for threads that work side by side.
  const bool is_crowded = vehicles >= cores_.count();
  if (newest == newest_link_ || !is_crowded) return;
  newest_link_ = newest;
  const Lock lock(hub_.mutex);
  for (std::size_t i = 0; i < hub_.vehicles.size(); ++i) {
    const VehicleLink& vehicle = *hub_.vehicles[i];
    vehicle.assert_hub_is_locked();
    // Those that confirm set-points are of this workspace: one thread does all, so there is nothing
    // to gain, and on the server's core they are cheaper than spread out.
    if (!vehicle.lockstep.enrolled() || vehicle.confirms_setpoints()) continue;
    for (const pid_t process : vehicle.controller_processes()) {
      const int core = cores_.keep(process, i);
      if (core < 0) continue;
      hub_.events.push_back(vehicle.name() + ": controller, process " + std::to_string(process) +
                            ", is kept on core " + std::to_string(core));
    }
  }
}

}  // namespace trident::sim
