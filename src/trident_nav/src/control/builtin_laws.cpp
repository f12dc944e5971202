// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "laws.h"

namespace trident::nav {

ControlLawRegistry builtin_control_laws() {
  ControlLawRegistry registry("controller");
  add_dwa(registry);
  add_dwb(registry);
  add_graceful(registry);
  add_mppi(registry);
  add_pure_pursuit(registry);
  add_rotation_shim(registry);
  add_teb(registry);
  add_trajectory_planner(registry);
  return registry;
}

}  // namespace trident::nav
