// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "../rays/ray_packet.h"

namespace trident::sim {

/// Standard normal numbers for the pixels of pictures, sixteen at a time: a few instructions each,
/// from a table of 4096 quantiles (so none is beyond 3.7) that is looked up by a hash of key,
/// packet and lane. Each packet's numbers depend on nothing else.
class PixelNoise {
 public:
  /// `key`: 64 random bits of this picture's own, see RandomStream::bits().
  explicit PixelNoise(std::uint64_t key) : key_(key) {}
  PacketFloats normals(std::uint64_t packet) const;

 private:
  std::uint64_t key_;
};

}  // namespace trident::sim
