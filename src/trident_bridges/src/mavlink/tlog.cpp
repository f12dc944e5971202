// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/tlog.h"

#include <algorithm>

namespace trident::bridges::mavlink {
namespace {

constexpr std::size_t kTimeSize = 8;

/// [bytes] of the packet that begins here by its header; 0: none does.
std::size_t packet_size(Bytes bytes) {
  if (bytes.size() < 3) return 0;
  if (bytes[0] == kStart1) return kHeader1 + bytes[1] + kChecksumSize;
  if (bytes[0] != kStart2) return 0;
  const std::size_t signature = (bytes[2] & kSignedFlag) != 0 ? kSignatureSize : 0;
  return kHeader2 + bytes[1] + kChecksumSize + signature;
}

std::int64_t read_time_us(Bytes bytes) {
  std::uint64_t time = 0;
  for (std::size_t i = 0; i < kTimeSize; ++i) time = time << 8 | bytes[i];
  return static_cast<std::int64_t>(time);
}

}  // namespace

std::optional<TlogRecord> TlogReader::next() {
  while (rest_.size() > kTimeSize) {
    const Bytes after_time = rest_.subspan(kTimeSize);
    const std::size_t size = packet_size(after_time);
    if (size > 0 && size <= after_time.size()) {
      parser_.feed_datagram(after_time.first(size));
      const std::optional<Packet> packet = parser_.next();
      if (packet && packet->raw.size() == size) {
        const std::int64_t time_us = read_time_us(rest_);
        rest_ = after_time.subspan(size);
        return TlogRecord{time_us, *packet};
      }
    }
    rest_ = rest_.subspan(1);
    ++skipped_bytes_;
  }
  skipped_bytes_ += rest_.size();
  rest_ = {};
  return std::nullopt;
}

}  // namespace trident::bridges::mavlink
