// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/packet_writer.h"

#include <cstring>
#include <string>

#include "mavlink/checksum.h"
#include "trident_base/error.h"
#include "trident_bridges/mavlink/message_table.h"
#include "trident_bridges/mavlink/signing.h"

namespace trident::bridges::mavlink {
namespace {

/// [bytes] of a payload without the zeros at its end; the first byte is always sent.
std::size_t length_without_zeros(const Message& message) {
  std::size_t length = message.length;
  while (length > 1 && message.payload[length - 1] == 0) --length;
  return length;
}

}  // namespace

Bytes PacketWriter::write(const Message& message) {
  const MessageFacts* facts = find_message(message.id);
  if (facts == nullptr) {
    throw Error("MAVLink message " + std::to_string(message.id) + ": the dialect has no such id");
  }
  const std::size_t length = length_without_zeros(message);
  const std::uint8_t flags = signer_ != nullptr ? kSignedFlag : 0;
  const std::array<std::uint8_t, kHeader2> header{kStart2,
                                                  static_cast<std::uint8_t>(length),
                                                  flags,
                                                  0,
                                                  sequences_[message.source.component]++,
                                                  message.source.system,
                                                  message.source.component,
                                                  static_cast<std::uint8_t>(message.id),
                                                  static_cast<std::uint8_t>(message.id >> 8),
                                                  static_cast<std::uint8_t>(message.id >> 16)};
  std::memcpy(packet_.data(), header.data(), kHeader2);
  std::memcpy(packet_.data() + kHeader2, message.payload.data(), length);
  const std::size_t crc_at = kHeader2 + length;
  const std::uint16_t crc =
      checksum(facts->crc_extra, checksum(Bytes(packet_.data() + 1, crc_at - 1)));
  packet_[crc_at] = static_cast<std::uint8_t>(crc);
  packet_[crc_at + 1] = static_cast<std::uint8_t>(crc >> 8);
  std::size_t size = crc_at + kChecksumSize;
  if (signer_ != nullptr) {
    signer_->sign(Bytes(packet_.data(), size), packet_.data() + size);
    size += kSignatureSize;
  }
  return {packet_.data(), size};
}

}  // namespace trident::bridges::mavlink
