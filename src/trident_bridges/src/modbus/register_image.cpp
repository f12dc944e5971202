// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/register_image.h"

#include <algorithm>

namespace trident::bridges::modbus {

std::size_t RegisterImage::bytes_per_address(Table table) {
  return table == Table::kCoil || table == Table::kDiscrete ? 1 : 2;
}

RegisterImage::RegisterImage(const std::vector<RegisterEntry>& entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const RegisterEntry& entry = entries[i];
    Content& content = tables_[static_cast<std::size_t>(entry.table)];
    const auto end = static_cast<std::size_t>(entry.end());
    if (content.owner.size() < end) {
      content.owner.resize(end, -1);
      content.bytes.resize(end * bytes_per_address(entry.table));
    }
    std::fill_n(content.owner.begin() + entry.address, entry.addresses(),
                static_cast<std::int32_t>(i));
    write_value(entry, entry.initial, wire(entry));
  }
  for (Content& content : tables_) content.find_run_ends();
}

void RegisterImage::Content::find_run_ends() {
  run_end.resize(owner.size());
  std::int32_t end = 0;
  for (std::size_t i = owner.size(); i-- > 0;) {
    if (owner[i] < 0) {
      end = 0;
    } else if (end == 0) {
      end = static_cast<std::int32_t>(i) + 1;
    }
    run_end[i] = end;
  }
}

int RegisterImage::first_missing(Table table, int address, int count) const {
  const std::vector<std::int32_t>& run_end = content(table).run_end;
  if (address >= static_cast<int>(run_end.size()) || run_end[address] == 0) return address;
  return run_end[address] >= address + count ? -1 : run_end[address];
}

int RegisterImage::owner(Table table, int address) const {
  const std::vector<std::int32_t>& owner = content(table).owner;
  return address < static_cast<int>(owner.size()) ? owner[address] : -1;
}

Span<std::uint8_t> RegisterImage::wire(const RegisterEntry& entry) {
  const std::size_t width = bytes_per_address(entry.table);
  return Span<std::uint8_t>(tables_[static_cast<std::size_t>(entry.table)].bytes)
      .subspan(width * entry.address, width * entry.addresses());
}

Bytes RegisterImage::wire(const RegisterEntry& entry) const {
  const std::size_t width = bytes_per_address(entry.table);
  return Bytes(content(entry.table).bytes)
      .subspan(width * entry.address, width * entry.addresses());
}

Bytes RegisterImage::registers(Table table, int address, int count) const {
  return Bytes(content(table).bytes).subspan(2U * address, 2U * count);
}

void RegisterImage::pack_bits(Table table, int address, int count,
                              Span<std::uint8_t> packed) const {
  const Bytes bits = Bytes(content(table).bytes).subspan(address, count);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i] != 0) packed[i / 8] |= static_cast<std::uint8_t>(1U << (i % 8));
  }
}

}  // namespace trident::bridges::modbus
