// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trident_bridges/modbus/pdu.h"
#include "trident_bridges/modbus/register_map.h"

namespace trident::bridges::modbus {

/// Neighbors that are read by one request.
struct ReadBlock {
  Function function{};               ///< one of 1 to 4
  int address = 0;                   ///< of the first
  int count = 0;                     ///< registers or bits
  std::vector<std::size_t> entries;  ///< whose values are in it, in the order of their addresses
};

/// The fewest blocks that hold all values that are polled: of up to 125 registers or 2000 bits,
/// with up to MapSpec::max_gap addresses between two values that no value has.
std::vector<ReadBlock> read_blocks(const RegisterMap& map);

}  // namespace trident::bridges::modbus
