// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_bridges/autopilot/parameter_table.h"

namespace trident::bridges {

/// The parameters of a kind of vehicle in one flavor, with their defaults; in no order.
std::vector<Parameter> default_parameters(Flavor flavor, VehicleClass vehicle);

}  // namespace trident::bridges
