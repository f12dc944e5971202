// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/read_blocks.h"

#include <algorithm>
#include <utility>

namespace trident::bridges::modbus {
namespace {

Function read_function(Table table) {
  switch (table) {
    case Table::kCoil:
      return Function::kReadCoils;
    case Table::kDiscrete:
      return Function::kReadDiscreteInputs;
    case Table::kInput:
      return Function::kReadInputRegisters;
    case Table::kHolding:
      break;
  }
  return Function::kReadHoldingRegisters;
}

bool fits(const ReadBlock& block, const RegisterEntry& entry, int max_gap) {
  const int most = entry.is_bit() ? kMaxReadBits : kMaxReadRegisters;
  return block.function == read_function(entry.table) && entry.end() - block.address <= most &&
         entry.address - (block.address + block.count) <= max_gap;
}

}  // namespace

std::vector<ReadBlock> read_blocks(const RegisterMap& map) {
  std::vector<std::size_t> polled;
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    if (map.entries[i].is_polled()) polled.push_back(i);
  }
  std::sort(polled.begin(), polled.end(), [&map](std::size_t a, std::size_t b) {
    return std::make_pair(map.entries[a].table, map.entries[a].address) <
           std::make_pair(map.entries[b].table, map.entries[b].address);
  });
  std::vector<ReadBlock> blocks;
  for (const std::size_t index : polled) {
    const RegisterEntry& entry = map.entries[index];
    if (blocks.empty() || !fits(blocks.back(), entry, map.spec.max_gap)) {
      blocks.push_back({read_function(entry.table), entry.address, 0, {}});
    }
    blocks.back().count = entry.end() - blocks.back().address;
    blocks.back().entries.push_back(index);
  }
  return blocks;
}

}  // namespace trident::bridges::modbus
