// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_bridges/modbus/register_map.h"

namespace trident::bridges::modbus {

/// A map as a table, ordered by table and address: address, name, type and order, scale, unit,
/// limits, topic and field; above it the device, below it how many requests read it.
std::string map_listing(const RegisterMap& map);

}  // namespace trident::bridges::modbus
