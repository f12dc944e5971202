// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "laws.h"

#include <string>

#include "trident_nav/core/plugin_name.h"

namespace trident::nav {
std::string controller_name(const std::string& name) {
  const ControlLawRegistry registry = builtin_control_laws();
  for (const std::string& known : registry.names()) {
    if (with_slash(known) == with_slash(name)) return known;
  }
  return name;
}

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
