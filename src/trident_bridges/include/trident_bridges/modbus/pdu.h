// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>

#include "trident_base/span.h"

namespace trident::bridges::modbus {

/// A block of bytes that the caller owns.
using Bytes = Span<const std::uint8_t>;

/// Functions of the Modbus Application Protocol V1.1b3 (section 6) that are spoken here. A request
/// may hold any other code, too.
enum class Function : std::uint8_t {
  kReadCoils = 1,
  kReadDiscreteInputs = 2,
  kReadHoldingRegisters = 3,
  kReadInputRegisters = 4,
  kWriteSingleCoil = 5,
  kWriteSingleRegister = 6,
  kWriteMultipleCoils = 15,
  kWriteMultipleRegisters = 16,
  kMaskWriteRegister = 22,
  kReadWriteMultipleRegisters = 23,
  kReadDeviceIdentification = 43,
};

/// Why a request was not executed (section 7).
enum class ExceptionCode : std::uint8_t {
  kIllegalFunction = 1,
  kIllegalAddress = 2,
  kIllegalValue = 3,
  kDeviceFailure = 4,
  kAcknowledge = 5,
  kBusy = 6,
  kMemoryParityError = 8,
  kGatewayPathUnavailable = 10,
  kGatewayTargetFailed = 11,
};

inline constexpr std::size_t kMaxPduBytes = 253;      ///< section 4.1
inline constexpr int kTableAddresses = 0x10000;       ///< of each table
inline constexpr std::uint8_t kExceptionFlag = 0x80;  ///< on the function of an exception response
inline constexpr int kMaxReadBits = 2000;             ///< of functions 1 and 2
inline constexpr int kMaxReadRegisters = 125;         ///< of functions 3, 4 and 23
inline constexpr int kMaxWriteBits = 1968;            ///< of function 15
inline constexpr int kMaxWriteRegisters = 123;        ///< of function 16
inline constexpr int kMaxReadWriteRegisters = 121;    ///< written by function 23
inline constexpr std::uint8_t kDeviceIdType = 0x0E;   ///< MEI type of function 43 that is spoken
inline constexpr std::uint16_t kCoilOn = 0xFF00;      ///< value of function 5; off is 0

/// "read holding registers (3)"; "function 99" for one that is not spoken.
std::string function_text(Function function);
/// "illegal address (exception 2)"; "exception 99" for one that the protocol does not have.
std::string exception_text(ExceptionCode code);

/// Two bytes in the order of the wire, most significant first. `bytes` has at least `at` + 2.
inline std::uint16_t word_at(Bytes bytes, std::size_t at) {
  return static_cast<std::uint16_t>((bytes[at] << 8) | bytes[at + 1]);
}

/// A protocol data unit that is being written: function and data, without unit and checksum.
class Pdu {
 public:
  Pdu() = default;
  /// Begins with the function's code.
  explicit Pdu(Function function) { byte(static_cast<std::uint8_t>(function)); }

  /// Appends a byte. At most kMaxPduBytes fit.
  void byte(std::uint8_t value) {
    assert(size_ < kMaxPduBytes);
    bytes_[size_++] = value;
  }
  /// Appends two bytes, most significant first.
  void word(std::uint16_t value) {
    byte(static_cast<std::uint8_t>(value >> 8));
    byte(static_cast<std::uint8_t>(value & 0xFF));
  }
  /// Appends bytes as they are.
  void append(Bytes bytes);
  /// Appends `count` zero bytes and returns them for writing.
  Span<std::uint8_t> append_zeros(std::size_t count);

  Bytes bytes() const { return {bytes_.data(), size_}; }         ///< what was written so far
  std::size_t size() const { return size_; }                     ///< in bytes
  std::size_t space() const { return kMaxPduBytes - size_; }     ///< bytes that still fit
  std::uint8_t& operator[](std::size_t i) { return bytes_[i]; }  ///< i < size()

 private:
  std::array<std::uint8_t, kMaxPduBytes> bytes_;
  std::size_t size_ = 0;
};

/// A request in terms of what it asks for. Which members count depends on the function.
struct Request {
  Function function{};
  std::uint16_t read_address = 0;   ///< zero-based, of 1-4 and 23
  std::uint16_t read_count = 0;     ///< bits or registers of 1-4 and 23
  std::uint16_t write_address = 0;  ///< zero-based, of 5, 6, 15, 16, 22, 23
  std::uint16_t write_count = 0;    ///< bits or registers of 5, 6, 15, 16, 22, 23
  /// What is written, as on the wire: bits from the least significant one of the first byte on,
  /// registers most significant byte first. Belongs to the block that was decoded.
  Bytes values;
  std::uint16_t and_mask = 0;       ///< of 22
  std::uint16_t or_mask = 0;        ///< of 22
  std::uint8_t device_id_code = 0;  ///< of 43: 1 basic, 2 regular, 3 extended, 4 one object
  std::uint8_t object_id = 0;       ///< of 43: where the answer begins

  /// Whether something is written.
  bool writes() const { return write_count > 0; }
};

/// What a request was found to be.
struct DecodedRequest {
  Request request;          ///< `function` always counts, the rest where the request is legal
  bool is_legal = true;     ///< else `refusal` is the answer
  ExceptionCode refusal{};  ///< of a request that is not legal
  std::string problem =
      {};  ///< of a request that is not legal: the field, its value, the legal range
};

/// Reads a request; any bytes will do. Its quantities, byte counts and length are checked, and that
/// no address is beyond 65535, in the order of the protocol's state diagrams.
DecodedRequest decode_request(Bytes pdu);

/// Writes a request. Its quantities must be legal, and `values` must be as long as they say.
Pdu encode_request(const Request& request);

/// A request of functions 1-4.
Request read_request(Function function, std::uint16_t address, std::uint16_t count);
/// A request of functions 15 and 16; `values` as in Request.
Request write_request(Function function, std::uint16_t address, std::uint16_t count, Bytes values);

/// Whether functions 1, 2, 5, 15: their values are bits, not registers.
bool is_bit_function(Function function);
/// Bytes that so many bits take.
constexpr std::size_t packed_size(std::size_t bits) { return (bits + 7) / 8; }

}  // namespace trident::bridges::modbus
