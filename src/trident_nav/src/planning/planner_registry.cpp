// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/planner_registry.h"

#include <utility>

#include "trident_nav/core/plugin_name.h"

namespace trident::nav {

Registry<PlannerFactory> builtin_planners() {
  Registry<PlannerFactory> registry("planner");
  register_builtin_planners(registry);
  return registry;
}

std::string planner_name(std::string name) { return with_slash(std::move(name)); }

}  // namespace trident::nav
