// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace trident::estimation {

/// Channels of the random stream of Amcl.
enum Channel : std::uint32_t {
  kChoice,
  kFresh,
  kPlace,
  kHeading,
  kScatterX,
  kScatterY,
  kScatterYaw
};

/// A number in [0, 1) from the upper bits.
inline double to_unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

}  // namespace trident::estimation
