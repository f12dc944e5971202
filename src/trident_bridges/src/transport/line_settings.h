// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trident_bridges/transport/endpoint.h"

namespace trident::bridges {

/// How a terminal device carries bytes, all eight bits of them and nothing translated.
struct LineSettings {
  std::uint32_t baud = 57600;      ///< [bit/s], any that the device can
  Parity parity = Parity::kNone;   ///< of each byte
  int stop_bits = 1;               ///< 1 or 2
  bool has_hardware_flow = false;  ///< by RTS and CTS
};

/// Sets up a terminal device and drops what it has received. False, with errno, when it is no
/// terminal or cannot do so.
bool set_up_line(int descriptor, const LineSettings& settings);

/// Drops what a terminal device has received and what waits to be sent.
void flush_line(int descriptor);

}  // namespace trident::bridges
