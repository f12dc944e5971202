// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/rtu.h"

#include <algorithm>
#include <array>

namespace trident::bridges::modbus {
namespace {

constexpr std::size_t kCrcBytes = 2;
constexpr std::size_t kMinFrameBytes = 4;  // unit, function, checksum

constexpr std::array<std::uint16_t, 256> make_crc_table() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0xA001U : crc >> 1;
    table[byte] = static_cast<std::uint16_t>(crc);
  }
  return table;
}

constexpr std::array<std::uint16_t, 256> kCrcTable = make_crc_table();

bool has_valid_crc(Bytes frame) {
  const std::size_t size = frame.size() - kCrcBytes;
  return rtu_crc(frame.first(size)) == (frame[size] | (frame[size + 1] << 8));
}

/// Length of a request that begins like this; 0: not known, or not yet.
std::size_t request_length(Bytes frame) {
  switch (static_cast<Function>(frame[1])) {
    case Function::kReadCoils:
    case Function::kReadDiscreteInputs:
    case Function::kReadHoldingRegisters:
    case Function::kReadInputRegisters:
    case Function::kWriteSingleCoil:
    case Function::kWriteSingleRegister:
      return 8;
    case Function::kWriteMultipleCoils:
    case Function::kWriteMultipleRegisters:
      return frame.size() > 6 ? 9U + frame[6] : 0;
    case Function::kMaskWriteRegister:
      return 10;
    case Function::kReadWriteMultipleRegisters:
      return frame.size() > 10 ? 13U + frame[10] : 0;
    case Function::kReadDeviceIdentification:
      return 7;
  }
  return 0;
}

/// Of a response of function 43 / 14, whose objects have lengths of their own.
std::size_t device_id_length(Bytes frame) {
  if (frame.size() < 8) return 0;
  std::size_t at = 8;
  for (int i = 0; i < frame[7]; ++i) {
    if (frame.size() < at + 2) return 0;
    at += 2U + frame[at + 1];
  }
  return at + kCrcBytes;
}

/// Length of a response that begins like this; 0: not known, or not yet.
std::size_t response_length(Bytes frame) {
  if ((frame[1] & kExceptionFlag) != 0) return 5;
  switch (static_cast<Function>(frame[1])) {
    case Function::kReadCoils:
    case Function::kReadDiscreteInputs:
    case Function::kReadHoldingRegisters:
    case Function::kReadInputRegisters:
    case Function::kReadWriteMultipleRegisters:
      return frame.size() > 2 ? 5U + frame[2] : 0;
    case Function::kWriteSingleCoil:
    case Function::kWriteSingleRegister:
    case Function::kWriteMultipleCoils:
    case Function::kWriteMultipleRegisters:
      return 8;
    case Function::kMaskWriteRegister:
      return 10;
    case Function::kReadDeviceIdentification:
      return device_id_length(frame);
  }
  return 0;
}

/// What a whole frame holds; one of unknown length may be either.
RtuFrame unwrapped(Bytes frame) {
  const std::size_t request = request_length(frame), response = response_length(frame);
  const bool is_unknown = request == 0 && response == 0;
  return {frame[0], frame.subspan(1, frame.size() - 1 - kCrcBytes),
          request == frame.size() || is_unknown, response == frame.size() || is_unknown};
}

}  // namespace

std::uint16_t rtu_crc(Bytes bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) crc = (crc >> 8) ^ kCrcTable[(crc ^ byte) & 0xFF];
  return static_cast<std::uint16_t>(crc);
}

RtuTiming rtu_timing(std::uint32_t baud) {
  constexpr double kBitsPerCharacter = 11.0;  // start, 8 data, parity or a second stop, stop
  constexpr std::uint32_t kFixedAboveBaud = 19200;
  constexpr double kFixedSilenceS = 1.75e-3;
  const double character_s = kBitsPerCharacter / baud;
  return {character_s, baud > kFixedAboveBaud ? kFixedSilenceS : 3.5 * character_s};
}

void append_rtu_frame(std::uint8_t unit, Bytes pdu, std::vector<std::uint8_t>& out) {
  const std::size_t begin = out.size();
  out.push_back(unit);
  out.insert(out.end(), pdu.begin(), pdu.end());
  const std::uint16_t crc = rtu_crc(Bytes(out).subspan(begin));
  out.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  out.push_back(static_cast<std::uint8_t>(crc >> 8));
}

RtuFrameReader::RtuFrameReader(double silence_s, bool removes_echo)
    : silence_s_(silence_s), removes_echo_(removes_echo) {}

void RtuFrameReader::expect_echo(Bytes sent) {
  if (removes_echo_) echo_.assign(sent.begin(), sent.end());
}

void RtuFrameReader::feed(Bytes block, double now_s) {
  if (block.empty()) return;
  if (now_s - last_byte_s_ >= silence_s_) drop_incomplete();
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  buffer_.insert(buffer_.end(), block.begin(), block.end());
  last_byte_s_ = now_s;
}

void RtuFrameReader::drop_incomplete() {
  const std::size_t pending = buffer_.size() - begin_;
  if (pending == 0) return;
  ++counts_.bad_frames;
  counts_.noise_bytes += pending;
  begin_ += pending;
}

/// What is sent comes back byte by byte, so as long as it may still be the echo, it is left alone.
void RtuFrameReader::remove_echo() {
  if (echo_.empty()) return;
  const std::size_t shared = std::min(echo_.size(), buffer_.size() - begin_);
  if (!std::equal(echo_.begin(), echo_.begin() + static_cast<std::ptrdiff_t>(shared),
                  buffer_.begin() + static_cast<std::ptrdiff_t>(begin_))) {
    echo_.clear();  // a collision, or a line without echo
  } else if (shared == echo_.size()) {
    begin_ += shared;
    echo_.clear();
    ++counts_.echoes;
  }
}

std::optional<RtuFrame> RtuFrameReader::frame_at(std::size_t begin, std::size_t size) {
  const Bytes rest = Bytes(buffer_).subspan(begin);
  if (size < kMinFrameBytes || size > kMaxRtuBytes || rest.size() < size) return std::nullopt;
  const Bytes frame = rest.first(size);
  if (!has_valid_crc(frame)) return std::nullopt;
  counts_.noise_bytes += begin - begin_;
  begin_ = begin + size;
  ++counts_.frames;
  return unwrapped(frame);
}

std::optional<RtuFrame> RtuFrameReader::complete_frame() {
  const Bytes rest = Bytes(buffer_).subspan(begin_);
  if (rest.size() < kMinFrameBytes) return std::nullopt;
  for (const std::size_t size : {request_length(rest), response_length(rest)}) {
    if (auto frame = frame_at(begin_, size)) return frame;
  }
  return std::nullopt;
}

/// After a silence: the frame is what is there, but for a little noise before it.
std::optional<RtuFrame> RtuFrameReader::last_frame() {
  for (std::size_t noise = 0; noise <= kMaxNoise; ++noise) {
    const std::size_t begin = begin_ + noise;
    if (begin + kMinFrameBytes > buffer_.size()) break;
    if (auto frame = frame_at(begin, buffer_.size() - begin)) return frame;
  }
  drop_incomplete();
  return std::nullopt;
}

std::optional<RtuFrame> RtuFrameReader::next(double now_s) {
  remove_echo();
  const bool is_silent = now_s - last_byte_s_ >= silence_s_;
  if (!echo_.empty() && !is_silent && begin_ < buffer_.size()) return std::nullopt;
  if (auto frame = complete_frame()) return frame;
  const std::size_t pending = buffer_.size() - begin_;
  if (pending > kMaxRtuBytes + kMaxNoise) drop_incomplete();
  if (is_silent && buffer_.size() > begin_) return last_frame();
  return std::nullopt;
}

std::optional<double> RtuFrameReader::deadline_s() const {
  if (begin_ == buffer_.size()) return std::nullopt;
  return last_byte_s_ + silence_s_;
}

}  // namespace trident::bridges::modbus
