// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "trident_bridges/mavlink/packet.h"

namespace trident::bridges::mavlink {

class PacketSigner;

/// Makes MAVLink 2 packets of the messages of one system for one link, and counts them per
/// component. Nothing is allocated.
class PacketWriter {
 public:
  /// `signer`, if any, signs every packet and must outlive this.
  explicit PacketWriter(PacketSigner* signer = nullptr) : signer_(signer) {}

  /// The packet, valid until the next call. Throws Error for a message that the dialect does not
  /// have, and what the signer throws.
  Bytes write(const Message& message);

 private:
  PacketSigner* signer_;
  std::array<std::uint8_t, 256> sequences_{};  // by component
  std::array<std::uint8_t, kMaxPacket> packet_{};
};

}  // namespace trident::bridges::mavlink
