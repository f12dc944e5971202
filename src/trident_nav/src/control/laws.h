// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_nav/control/control_law.h"

namespace trident::nav {

// One line per source that registers control laws, here and in builtin_laws.cpp.
void add_dwa(ControlLawRegistry& registry);
void add_dwb(ControlLawRegistry& registry);
void add_graceful(ControlLawRegistry& registry);
void add_mppi(ControlLawRegistry& registry);
void add_pure_pursuit(ControlLawRegistry& registry);
void add_rotation_shim(ControlLawRegistry& registry);
void add_teb(ControlLawRegistry& registry);
void add_trajectory_planner(ControlLawRegistry& registry);

}  // namespace trident::nav
