// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {

Registry<PlannerFactory> builtin_planners() {
  Registry<PlannerFactory> registry("planner");
  register_builtin_planners(registry);
  return registry;
}

std::string planner_name(std::string name) {
  const std::size_t at = name.find("::");
  if (at != std::string::npos) name.replace(at, 2, "/");
  return name;
}

}  // namespace trident::nav
