// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/packet_parser.h"

#include <algorithm>
#include <cstring>

#include "mavlink/checksum.h"
#include "trident_bridges/mavlink/message_table.h"

namespace trident::bridges::mavlink {
namespace {

bool is_start(std::uint8_t byte) { return byte == kStart2 || byte == kStart1; }

}  // namespace

void PacketParser::feed(Bytes bytes) {
  is_datagram_ = false;
  input_ = bytes;
}

void PacketParser::feed_datagram(Bytes bytes) {
  counts_.skipped_bytes += pending_size_;
  pending_size_ = used_ = 0;
  is_datagram_ = true;
  input_ = bytes;
}

std::optional<Packet> PacketParser::next() {
  if (used_ > 0) {
    pending_size_ -= used_;
    std::memmove(pending_.data(), pending_.data() + used_, pending_size_);
    used_ = 0;
  }
  if (pending_size_ > 0) {
    if (std::optional<Packet> packet = next_in_pending()) return packet;
    if (pending_size_ > 0) return std::nullopt;
  }
  return next_in_input();
}

std::optional<Packet> PacketParser::next_in_input() {
  Packet packet;
  std::size_t at = 0, size = 0;
  const Outcome outcome = scan(input_, at, size, packet);
  if (outcome == Outcome::kPacket) {
    input_ = input_.subspan(at + size);
    return packet;
  }
  pending_size_ = input_.size() - at;
  std::copy(input_.begin() + at, input_.end(), pending_.begin());
  input_ = {};
  return std::nullopt;
}

/// Looks at the pending bytes with a piece of the input behind them that is long enough to complete
/// any packet that begins in them.
std::optional<Packet> PacketParser::next_in_pending() {
  const std::size_t own = pending_size_;
  const std::size_t lent = std::min(input_.size(), kMaxPacket);
  std::copy(input_.begin(), input_.begin() + lent, pending_.begin() + own);
  Packet packet;
  std::size_t at = 0, size = 0;
  const Bytes all(pending_.data(), own + lent);
  const Outcome outcome = scan(all, at, size, packet);
  const std::size_t end = outcome == Outcome::kPacket ? at + size : at;
  if (end >= own) {  // What follows is looked at in the input itself.
    input_ = input_.subspan(end - own);
    pending_size_ = 0;
  } else if (outcome == Outcome::kPacket) {
    used_ = end;
  } else {  // All of the input was lent.
    pending_size_ = all.size() - at;
    std::memmove(pending_.data(), pending_.data() + at, pending_size_);
    input_ = {};
  }
  if (outcome == Outcome::kPacket) return packet;
  return std::nullopt;
}

PacketParser::Outcome PacketParser::scan(Bytes bytes, std::size_t& at, std::size_t& size,
                                         Packet& packet) {
  while (at < bytes.size()) {
    if (!is_start(bytes[at])) {
      ++at;
      ++counts_.skipped_bytes;
      continue;
    }
    const Found found = look_at(bytes.subspan(at), packet);
    if (found.outcome == Outcome::kPacket) {
      size = found.size;
      ++counts_.packets;
      return Outcome::kPacket;
    }
    if (found.outcome == Outcome::kIncomplete && !is_datagram_) return Outcome::kIncomplete;
    if (found.outcome != Outcome::kDropped) ++counts_.skipped_bytes;
    at += found.outcome == Outcome::kDropped ? found.size : 1;
  }
  return Outcome::kIncomplete;
}

PacketParser::Found PacketParser::look_at(Bytes bytes, Packet& packet) {
  return bytes[0] == kStart2 ? look_at_2(bytes, packet) : look_at_1(bytes, packet);
}

PacketParser::Found PacketParser::look_at_2(Bytes bytes, Packet& packet) {
  if (bytes.size() < kHeader2) return {Outcome::kIncomplete, 1};
  const std::size_t length = bytes[1];
  const std::uint8_t flags = bytes[2];
  const bool is_signed = (flags & kSignedFlag) != 0;
  const std::size_t crc_at = kHeader2 + length;
  const std::size_t size = crc_at + kChecksumSize + (is_signed ? kSignatureSize : 0);
  if (bytes.size() < size) return {Outcome::kIncomplete, 1};
  packet.id = bytes[7] | std::uint32_t{bytes[8]} << 8 | std::uint32_t{bytes[9]} << 16;
  packet.source = {bytes[5], bytes[6]};
  packet.sequence = bytes[4];
  packet.version = 2;
  packet.is_signed = is_signed;
  packet.payload = bytes.subspan(kHeader2, length);
  packet.raw = bytes.first(size);
  const Found found = judge(bytes, checksum(bytes.subspan(1, crc_at - 1)), crc_at, size, packet);
  if (found.outcome != Outcome::kPacket || (flags & ~kSignedFlag) == 0) return found;
  ++counts_.unknown_flags;
  return {Outcome::kDropped, size};
}

PacketParser::Found PacketParser::look_at_1(Bytes bytes, Packet& packet) {
  if (bytes.size() < kHeader1) return {Outcome::kIncomplete, 1};
  const std::size_t length = bytes[1];
  const std::size_t crc_at = kHeader1 + length;
  const std::size_t size = crc_at + kChecksumSize;
  if (bytes.size() < size) return {Outcome::kIncomplete, 1};
  packet.id = bytes[5];
  packet.source = {bytes[3], bytes[4]};
  packet.sequence = bytes[2];
  packet.version = 1;
  packet.is_signed = false;
  packet.payload = bytes.subspan(kHeader1, length);
  packet.raw = bytes.first(size);
  const Found found = judge(bytes, checksum(bytes.subspan(1, crc_at - 1)), crc_at, size, packet);
  if (found.outcome != Outcome::kPacket || accept_mavlink1_) return found;
  ++counts_.mavlink1;
  return {Outcome::kDropped, size};
}

/// Whether the bytes are what they look like: by the checksum, or, where CRC_EXTRA is not known, by
/// what follows them.
PacketParser::Found PacketParser::judge(Bytes bytes, std::uint16_t crc, std::size_t crc_at,
                                        std::size_t size, Packet& packet) {
  const MessageFacts* facts = find_message(packet.id);
  packet.is_known = facts != nullptr;
  if (facts == nullptr) {
    if (bytes.size() > size && !is_start(bytes[size])) return {Outcome::kGarbage, 1};
    ++counts_.unknown;
    return {Outcome::kPacket, size};
  }
  const std::uint16_t expected = checksum(facts->crc_extra, crc);
  if (bytes[crc_at] != (expected & 0xFF) || bytes[crc_at + 1] != expected >> 8) {
    ++counts_.bad_checksum;
    return {Outcome::kGarbage, 1};
  }
  return {Outcome::kPacket, size};
}

}  // namespace trident::bridges::mavlink
