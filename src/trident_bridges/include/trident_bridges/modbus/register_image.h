// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trident_bridges/modbus/pdu.h"
#include "trident_bridges/modbus/register_map.h"

namespace trident::bridges::modbus {

/// The four tables of a device: what each address holds, and which entry of a map it belongs to.
class RegisterImage {
 public:
  /// All entries with their initial values.
  explicit RegisterImage(const std::vector<RegisterEntry>& entries);

  /// First address of [address, address + count) that no entry has; -1: all are there.
  int first_missing(Table table, int address, int count) const;
  /// Number of the entry that an address belongs to; -1: it belongs to no entry.
  int owner(Table table, int address) const;
  /// What an entry holds, as on the wire: two bytes a register, one byte a bit.
  Span<std::uint8_t> wire(const RegisterEntry& entry);
  Bytes wire(const RegisterEntry& entry) const;  ///< see above
  /// Registers in the order of the wire. All addresses must be there.
  Bytes registers(Table table, int address, int count) const;
  /// Packs bits, the first into the lowest bit of `packed`[0], which is zero before.
  void pack_bits(Table table, int address, int count, Span<std::uint8_t> packed) const;

 private:
  struct Content {
    void find_run_ends();

    std::vector<std::uint8_t> bytes;    ///< two for each register, one for each bit
    std::vector<std::int32_t> owner;    ///< of each address; -1: no entry
    std::vector<std::int32_t> run_end;  ///< behind the last address without a gap; 0: not there
  };
  static std::size_t bytes_per_address(Table table);
  const Content& content(Table table) const { return tables_[static_cast<std::size_t>(table)]; }

  std::array<Content, 4> tables_;
};

}  // namespace trident::bridges::modbus
