// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trident_bridges/modbus/pdu.h"

namespace trident::bridges::modbus {

inline constexpr std::size_t kMbapBytes = 7;         ///< header before the PDU
inline constexpr std::uint8_t kTcpDeviceUnit = 255;  ///< the device at the other end itself

/// One frame of Modbus TCP (Messaging on TCP/IP Implementation Guide V1.0b, section 3.1.3).
struct TcpFrame {
  std::uint16_t transaction = 0;  ///< the client's number, repeated in the response
  std::uint8_t unit = 0;          ///< of the device, behind a gateway or the gateway itself
  Bytes pdu;                      ///< belongs to who made the frame
};

/// Appends a frame to `out`.
void append_tcp_frame(const TcpFrame& frame, std::vector<std::uint8_t>& out);

/// Cuts a TCP stream into frames. From a wrong header there is no recovery, since nothing in the
/// stream marks the beginning of a frame: the connection must be ended.
class TcpFrameReader {
 public:
  /// Adds what was read. Frames that next() returned are not valid any more.
  void feed(Bytes block);
  /// The next whole frame, valid until the next feed(); empty: more bytes are needed, or the stream
  /// is broken.
  std::optional<TcpFrame> next();
  /// Why no more frames will come: the field, its value and what is legal. Empty while all is well.
  const std::string& problem() const { return problem_; }
  /// Bytes of a frame that is not complete yet.
  std::size_t pending() const { return buffer_.size() - begin_; }

 private:
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;  ///< of what next() has not returned
  std::string problem_;
};

}  // namespace trident::bridges::modbus
