// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "trident_bridges/modbus/pdu.h"

namespace trident::bridges::modbus {

inline constexpr std::size_t kMaxRtuBytes = 256;   ///< unit, PDU, checksum
inline constexpr std::uint8_t kBroadcastUnit = 0;  ///< all devices of a line; none answers

/// CRC-16 of Modbus over Serial Line V1.02, section 6.2.2: polynomial 0xA001 (reflected), begun
/// with 0xFFFF. Sent least significant byte first.
std::uint16_t rtu_crc(Bytes bytes);

/// Silences that separate what is on a serial line (section 2.5.1.1).
struct RtuTiming {
  double character_s = 0.0;  ///< one character with its start, parity and stop bits
  double silence_s = 0.0;    ///< between two frames: 3.5 characters
};

/// 3.5 characters of 11 bits; above 19200 baud 1.75 ms. `baud` is positive.
RtuTiming rtu_timing(std::uint32_t baud);

/// One frame of a serial line.
struct RtuFrame {
  std::uint8_t unit = 0;  ///< of the device; 0: broadcast
  Bytes pdu;              ///< belongs to who made the frame
  /// What its length lets it be: the same bytes of functions 5, 6 and 22 are both.
  bool may_be_request = false;
  bool may_be_response = false;
};

/// Appends a frame with its checksum to `out`.
void append_rtu_frame(std::uint8_t unit, Bytes pdu, std::vector<std::uint8_t>& out);

/// What a line's reader has seen since it was made.
struct RtuCounts {
  std::uint64_t frames = 0;       ///< with the right checksum
  std::uint64_t bad_frames = 0;   ///< what was between two silences and is no frame
  std::uint64_t noise_bytes = 0;  ///< bytes of those, and those before a frame
  std::uint64_t echoes = 0;       ///< frames that were our own
};

/// Cuts what comes from a serial line into frames. A frame ends with a silence; since an operating
/// system hands bytes over late and in blocks, one that is complete by its function, its length and
/// its checksum is taken at once, whether it is a request or a response. Other bytes are noise when
/// the line falls silent: a collision, a disturbed or a foreign frame. Up to kMaxNoise bytes
/// in front of a frame, as a line's turn-around makes them, do not harm it.
class RtuFrameReader {
 public:
  /// Longest noise in front of a frame that does not cost the frame [bytes].
  static constexpr std::size_t kMaxNoise = 4;

  /// A frame's bytes are at most `silence_s` apart: RtuTiming::silence_s, and what the operating
  /// system may add. `removes_echo`: what expect_echo() was given comes back.
  RtuFrameReader(double silence_s, bool removes_echo);

  /// Adds bytes that were read at `now_s`. Frames that next() returned are not valid any more.
  void feed(Bytes block, double now_s);
  /// The next frame, valid until the next feed(); empty: no frame is complete at `now_s`.
  std::optional<RtuFrame> next(double now_s);
  /// When a call of next() may have news though no byte comes; empty: not without a byte.
  std::optional<double> deadline_s() const;
  /// When the last byte came [s]; before it 3.5 characters of silence are due before sending.
  double last_byte_s() const { return last_byte_s_; }
  /// This was sent: the line returns it before anything else, if it does so at all.
  void expect_echo(Bytes sent);
  const RtuCounts& counts() const { return counts_; }  ///< since it was made

 private:
  void drop_incomplete();
  void remove_echo();
  std::optional<RtuFrame> frame_at(std::size_t begin, std::size_t size);
  std::optional<RtuFrame> complete_frame();
  std::optional<RtuFrame> last_frame();

  double silence_s_;
  bool removes_echo_;
  std::vector<std::uint8_t> buffer_, echo_;
  std::size_t begin_ = 0;  ///< of what next() has not returned
  double last_byte_s_ = -1e9;
  RtuCounts counts_;
};

}  // namespace trident::bridges::modbus
