// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// The registry of planners. A new planner is a header, a source that ends with
/// TRIDENT_NAV_PLANNER, and a line in the list of planners of planning.cmake.
#pragma once

#include <memory>
#include <string>

#include "trident_base/config_fields.h"
#include "trident_base/registry.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

/// Makes a planner from its parameters, a map; `source` names where they come from in errors.
/// Throws ConfigError naming source, key, value and legal range.
using PlannerFactory = DescribedFactory<std::unique_ptr<Planner>(const ConfigNode& parameters,
                                                                 const std::string& source)>;

/// The factory of a planner that is made from its parameters alone.
template <class PlannerType, class Params>
PlannerFactory planner_factory() {
  PlannerFactory factory = [](const ConfigNode& parameters,
                              const std::string& source) -> std::unique_ptr<Planner> {
    return std::make_unique<PlannerType>(load_config_node<Params>(parameters, source));
  };
  factory.fields = config_fields<Params>();
  return factory;
}

/// Registers a planner under a name in the form `package/Class`. Stands in namespace trident::nav
/// of its source, which planning.cmake lists; `file` is the name of that source without its ending.
#define TRIDENT_NAV_PLANNER(file, name, PlannerType, Params)    \
  void add_##file(Registry<PlannerFactory>& registry);          \
  void add_##file(Registry<PlannerFactory>& registry) {         \
    registry.add(name, planner_factory<PlannerType, Params>()); \
  }

/// Adds the planners of this package; `Registry::names` lists them.
void register_builtin_planners(Registry<PlannerFactory>& registry);
/// A registry with the planners of this package.
Registry<PlannerFactory> builtin_planners();
/// The registered form of a plugin's name: `nav2_x::Y` and `nav2_x/Y` are the same planner.
std::string planner_name(std::string name);

}  // namespace trident::nav
