// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// CRC-16/MCRF4XX (X.25 without the final inversion) of bytes behind those that gave `crc`. See
/// https://mavlink.io/en/guide/serialization.html#checksum.
std::uint16_t checksum(Bytes bytes, std::uint16_t crc = 0xFFFF);

/// The same of one byte: CRC_EXTRA.
std::uint16_t checksum(std::uint8_t byte, std::uint16_t crc);

}  // namespace trident::bridges::mavlink
