// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/mbap.h"

namespace trident::bridges::modbus {
namespace {

/// Empty, or what is wrong with a header.
std::string header_problem(std::size_t protocol, std::size_t length) {
  if (protocol != 0) return "MBAP protocol " + std::to_string(protocol) + ", legal: 0";
  if (length >= 2 && length <= kMaxPduBytes + 1) return "";
  return "MBAP length " + std::to_string(length) + ", legal: 2 to 254";
}

}  // namespace

void append_tcp_frame(const TcpFrame& frame, std::vector<std::uint8_t>& out) {
  const auto length = static_cast<std::uint16_t>(frame.pdu.size() + 1);
  const auto high = [](std::uint16_t word) { return static_cast<std::uint8_t>(word >> 8); };
  const auto low = [](std::uint16_t word) { return static_cast<std::uint8_t>(word & 0xFF); };
  const std::uint8_t header[kMbapBytes] = {
      high(frame.transaction), low(frame.transaction), 0, 0, high(length), low(length), frame.unit};
  out.insert(out.end(), header, header + kMbapBytes);
  out.insert(out.end(), frame.pdu.begin(), frame.pdu.end());
}

void TcpFrameReader::feed(Bytes block) {
  if (!problem_.empty()) return;
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  buffer_.insert(buffer_.end(), block.begin(), block.end());
}

std::optional<TcpFrame> TcpFrameReader::next() {
  const Bytes rest = Bytes(buffer_).subspan(begin_);
  if (rest.size() < kMbapBytes || !problem_.empty()) return std::nullopt;
  const std::size_t protocol = word_at(rest, 2);
  const std::size_t length = word_at(rest, 4);
  problem_ = header_problem(protocol, length);
  const std::size_t size = kMbapBytes - 1 + length;
  if (!problem_.empty() || rest.size() < size) return std::nullopt;
  begin_ += size;
  return TcpFrame{word_at(rest, 0), rest[kMbapBytes - 1],
                  rest.subspan(kMbapBytes, size - kMbapBytes)};
}

}  // namespace trident::bridges::modbus
