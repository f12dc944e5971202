// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "mavlink/checksum.h"

#include <array>

namespace trident::bridges::mavlink {
namespace {

constexpr std::size_t kSlices = 8;
using Tables = std::array<std::array<std::uint16_t, 256>, kSlices>;

/// Table s is the checksum of a byte that s zero bytes follow.
constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0x8408U : crc >> 1;
    tables[0][byte] = static_cast<std::uint16_t>(crc);
  }
  for (std::size_t slice = 1; slice < kSlices; ++slice) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint16_t before = tables[slice - 1][byte];
      tables[slice][byte] = static_cast<std::uint16_t>((before >> 8) ^ tables[0][before & 0xFF]);
    }
  }
  return tables;
}

constexpr Tables kTables = make_tables();

}  // namespace

std::uint16_t checksum(std::uint8_t byte, std::uint16_t crc) {
  return static_cast<std::uint16_t>((crc >> 8) ^ kTables[0][(crc ^ byte) & 0xFF]);
}

std::uint16_t checksum(Bytes bytes, std::uint16_t crc) {
  const std::uint8_t* at = bytes.data();
  std::size_t rest = bytes.size();
  // Eight bytes at a time, each by the table of what follows it (Kounavis and Berry 2005).
  for (; rest >= kSlices; rest -= kSlices, at += kSlices) {
    crc = static_cast<std::uint16_t>(kTables[7][at[0] ^ (crc & 0xFF)] ^
                                     kTables[6][at[1] ^ (crc >> 8)] ^ kTables[5][at[2]] ^
                                     kTables[4][at[3]] ^ kTables[3][at[4]] ^ kTables[2][at[5]] ^
                                     kTables[1][at[6]] ^ kTables[0][at[7]]);
  }
  for (; rest > 0; --rest, ++at) crc = checksum(*at, crc);
  return crc;
}

}  // namespace trident::bridges::mavlink
