// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_nav/control/braking_guard.h"
#include "trident_nav/control/control_law.h"

namespace trident::nav {

/// The slow motion that leads a robot that is in a tight place farthest from obstacles, among those
/// that the guard admits; nothing if none leads away.
std::optional<Twist2> escape_twist(const ControlSetup& setup, const BrakingGuard& guard,
                                   const RobotState& state, const CostGrid& grid,
                                   const Tracks& tracks);

}  // namespace trident::nav
