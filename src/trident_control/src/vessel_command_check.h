// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_control/vessel_controller.h"

namespace trident::control {

/// Refuses what is not finite or without waypoints, cuts what is beyond the parameters' limits.
CommandVerdict check_command(VesselCommand& command, const VesselControlParams& params);

}  // namespace trident::control
