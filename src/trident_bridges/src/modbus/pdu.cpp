// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/pdu.h"

#include <algorithm>
#include <map>

namespace trident::bridges::modbus {
namespace {

constexpr std::size_t kReadRequestBytes = 5;  // function, address, quantity
constexpr std::size_t kMaskRequestBytes = 7;  // function, address, two masks
constexpr std::size_t kDeviceIdBytes = 4;     // function, type, code, object
constexpr std::size_t kMultipleHeader = 6;    // function, address, quantity, byte count
constexpr std::size_t kReadWriteHeader = 10;  // function, two addresses and quantities, byte count

void refuse(DecodedRequest& decoded, ExceptionCode code, std::string problem) {
  decoded.is_legal = false;
  decoded.refusal = code;
  decoded.problem = function_text(decoded.request.function) + ": " + std::move(problem);
}

bool has_size(DecodedRequest& decoded, Bytes pdu, std::size_t size) {
  if (pdu.size() == size) return true;
  refuse(decoded, ExceptionCode::kIllegalValue,
         "request of " + std::to_string(pdu.size()) + " bytes, legal: " + std::to_string(size));
  return false;
}

bool has_quantity(DecodedRequest& decoded, int quantity, int most) {
  if (quantity >= 1 && quantity <= most) return true;
  refuse(decoded, ExceptionCode::kIllegalValue,
         "quantity " + std::to_string(quantity) + ", legal: 1 to " + std::to_string(most));
  return false;
}

bool has_addresses(DecodedRequest& decoded, int address, int count) {
  if (address + count <= kTableAddresses) return true;
  refuse(decoded, ExceptionCode::kIllegalAddress,
         "addresses " + std::to_string(address) + " to " + std::to_string(address + count - 1) +
             ", legal: up to 65535");
  return false;
}

/// The byte count of a write, and the length that follows from it.
bool has_values(DecodedRequest& decoded, Bytes pdu, std::size_t header, std::size_t expected) {
  const std::size_t byte_count = pdu[header - 1];
  if (byte_count != expected) {
    refuse(decoded, ExceptionCode::kIllegalValue,
           "byte count " + std::to_string(byte_count) + ", legal: " + std::to_string(expected));
    return false;
  }
  if (!has_size(decoded, pdu, header + expected)) return false;
  decoded.request.values = pdu.subspan(header);
  return true;
}

void decode_read(DecodedRequest& decoded, Bytes pdu) {
  Request& request = decoded.request;
  if (!has_size(decoded, pdu, kReadRequestBytes)) return;
  request.read_address = word_at(pdu, 1);
  request.read_count = word_at(pdu, 3);
  const int most = is_bit_function(request.function) ? kMaxReadBits : kMaxReadRegisters;
  if (has_quantity(decoded, request.read_count, most)) {
    has_addresses(decoded, request.read_address, request.read_count);
  }
}

/// The byte of 0xFF00 or 0x0000 whose lowest bit is the coil's value, or the register's two bytes.
void decode_write_single(DecodedRequest& decoded, Bytes pdu) {
  Request& request = decoded.request;
  if (!has_size(decoded, pdu, kReadRequestBytes)) return;
  request.write_address = word_at(pdu, 1);
  request.write_count = 1;
  const std::uint16_t value = word_at(pdu, 3);
  const bool is_coil = request.function == Function::kWriteSingleCoil;
  request.values = pdu.subspan(3, is_coil ? 1 : 2);
  if (is_coil && value != kCoilOn && value != 0) {
    refuse(decoded, ExceptionCode::kIllegalValue,
           "coil value " + std::to_string(value) + ", legal: 0 and 65280 (0xFF00)");
  }
}

void decode_write_multiple(DecodedRequest& decoded, Bytes pdu) {
  Request& request = decoded.request;
  if (pdu.size() < kMultipleHeader) return void(has_size(decoded, pdu, kMultipleHeader));
  request.write_address = word_at(pdu, 1);
  const int count = request.write_count = word_at(pdu, 3);
  const bool bits = is_bit_function(request.function);
  if (has_quantity(decoded, count, bits ? kMaxWriteBits : kMaxWriteRegisters) &&
      has_values(decoded, pdu, kMultipleHeader, bits ? packed_size(count) : 2 * count)) {
    has_addresses(decoded, request.write_address, count);
  }
}

void decode_mask(DecodedRequest& decoded, Bytes pdu) {
  if (!has_size(decoded, pdu, kMaskRequestBytes)) return;
  decoded.request.write_address = word_at(pdu, 1);
  decoded.request.write_count = 1;
  decoded.request.and_mask = word_at(pdu, 3);
  decoded.request.or_mask = word_at(pdu, 5);
}

void decode_read_write(DecodedRequest& decoded, Bytes pdu) {
  Request& request = decoded.request;
  if (pdu.size() < kReadWriteHeader) return void(has_size(decoded, pdu, kReadWriteHeader));
  request.read_address = word_at(pdu, 1);
  request.read_count = word_at(pdu, 3);
  request.write_address = word_at(pdu, 5);
  request.write_count = word_at(pdu, 7);
  if (has_quantity(decoded, request.read_count, kMaxReadRegisters) &&
      has_quantity(decoded, request.write_count, kMaxReadWriteRegisters) &&
      has_values(decoded, pdu, kReadWriteHeader, 2 * request.write_count) &&
      has_addresses(decoded, request.read_address, request.read_count)) {
    has_addresses(decoded, request.write_address, request.write_count);
  }
}

void decode_device_id(DecodedRequest& decoded, Bytes pdu) {
  if (pdu.size() >= 2 && pdu[1] != kDeviceIdType) {
    return refuse(decoded, ExceptionCode::kIllegalFunction,
                  "MEI type " + std::to_string(pdu[1]) + ", legal: 14 (0x0E)");
  }
  if (!has_size(decoded, pdu, kDeviceIdBytes)) return;
  decoded.request.device_id_code = pdu[2];
  decoded.request.object_id = pdu[3];
  if (pdu[2] < 1 || pdu[2] > 4) {
    refuse(decoded, ExceptionCode::kIllegalValue,
           "read device id code " + std::to_string(pdu[2]) + ", legal: 1 to 4");
  }
}

const std::map<Function, const char*>& function_names() {
  static const std::map<Function, const char*> names{
      {Function::kReadCoils, "read coils"},
      {Function::kReadDiscreteInputs, "read discrete inputs"},
      {Function::kReadHoldingRegisters, "read holding registers"},
      {Function::kReadInputRegisters, "read input registers"},
      {Function::kWriteSingleCoil, "write single coil"},
      {Function::kWriteSingleRegister, "write single register"},
      {Function::kWriteMultipleCoils, "write multiple coils"},
      {Function::kWriteMultipleRegisters, "write multiple registers"},
      {Function::kMaskWriteRegister, "mask write register"},
      {Function::kReadWriteMultipleRegisters, "read/write multiple registers"},
      {Function::kReadDeviceIdentification, "read device identification"}};
  return names;
}

const std::map<ExceptionCode, const char*>& exception_names() {
  static const std::map<ExceptionCode, const char*> names{
      {ExceptionCode::kIllegalFunction, "illegal function"},
      {ExceptionCode::kIllegalAddress, "illegal address"},
      {ExceptionCode::kIllegalValue, "illegal value"},
      {ExceptionCode::kDeviceFailure, "device failure"},
      {ExceptionCode::kAcknowledge, "acknowledge"},
      {ExceptionCode::kBusy, "busy"},
      {ExceptionCode::kMemoryParityError, "memory parity error"},
      {ExceptionCode::kGatewayPathUnavailable, "gateway path unavailable"},
      {ExceptionCode::kGatewayTargetFailed, "gateway target failed to respond"}};
  return names;
}

}  // namespace

std::string function_text(Function function) {
  const std::string code = std::to_string(static_cast<int>(function));
  const auto name = function_names().find(function);
  if (name == function_names().end()) return "function " + code;
  return std::string(name->second) + " (" + code + ")";
}

std::string exception_text(ExceptionCode code) {
  std::string number = "exception " + std::to_string(static_cast<int>(code));
  const auto name = exception_names().find(code);
  if (name == exception_names().end()) return number;
  return std::string(name->second) + " (" + number + ")";
}

bool is_bit_function(Function function) {
  return function == Function::kReadCoils || function == Function::kReadDiscreteInputs ||
         function == Function::kWriteSingleCoil || function == Function::kWriteMultipleCoils;
}

void Pdu::append(Bytes bytes) {
  assert(bytes.size() <= space());
  std::copy(bytes.begin(), bytes.end(), bytes_.begin() + size_);
  size_ += bytes.size();
}

Span<std::uint8_t> Pdu::append_zeros(std::size_t count) {
  assert(count <= space());
  std::uint8_t* const begin = bytes_.data() + size_;
  std::fill_n(begin, count, std::uint8_t{0});
  size_ += count;
  return {begin, count};
}

DecodedRequest decode_request(Bytes pdu) {
  DecodedRequest decoded;
  if (pdu.empty()) {
    refuse(decoded, ExceptionCode::kIllegalFunction, "request of 0 bytes, legal: 1 to 253");
    return decoded;
  }
  const auto function = decoded.request.function = static_cast<Function>(pdu[0]);
  switch (function) {
    case Function::kReadCoils:
    case Function::kReadDiscreteInputs:
    case Function::kReadHoldingRegisters:
    case Function::kReadInputRegisters:
      decode_read(decoded, pdu);
      break;
    case Function::kWriteSingleCoil:
    case Function::kWriteSingleRegister:
      decode_write_single(decoded, pdu);
      break;
    case Function::kWriteMultipleCoils:
    case Function::kWriteMultipleRegisters:
      decode_write_multiple(decoded, pdu);
      break;
    case Function::kMaskWriteRegister:
      decode_mask(decoded, pdu);
      break;
    case Function::kReadWriteMultipleRegisters:
      decode_read_write(decoded, pdu);
      break;
    case Function::kReadDeviceIdentification:
      decode_device_id(decoded, pdu);
      break;
    default:
      refuse(decoded, ExceptionCode::kIllegalFunction, "legal: 1 to 6, 15, 16, 22, 23, 43");
  }
  return decoded;
}

Pdu encode_request(const Request& request) {
  Pdu pdu(request.function);
  switch (request.function) {
    case Function::kReadCoils:
    case Function::kReadDiscreteInputs:
    case Function::kReadHoldingRegisters:
    case Function::kReadInputRegisters:
      pdu.word(request.read_address);
      pdu.word(request.read_count);
      break;
    case Function::kWriteSingleCoil:
      pdu.word(request.write_address);
      pdu.word((request.values[0] & 1) != 0 ? kCoilOn : 0);
      break;
    case Function::kWriteSingleRegister:
      pdu.word(request.write_address);
      pdu.append(request.values);
      break;
    case Function::kMaskWriteRegister:
      pdu.word(request.write_address);
      pdu.word(request.and_mask);
      pdu.word(request.or_mask);
      break;
    case Function::kReadWriteMultipleRegisters:
      pdu.word(request.read_address);
      pdu.word(request.read_count);
      [[fallthrough]];
    case Function::kWriteMultipleCoils:
    case Function::kWriteMultipleRegisters:
      pdu.word(request.write_address);
      pdu.word(request.write_count);
      pdu.byte(static_cast<std::uint8_t>(request.values.size()));
      pdu.append(request.values);
      break;
    case Function::kReadDeviceIdentification:
      pdu.byte(kDeviceIdType);
      pdu.byte(request.device_id_code);
      pdu.byte(request.object_id);
      break;
  }
  return pdu;
}

Request read_request(Function function, std::uint16_t address, std::uint16_t count) {
  Request request;
  request.function = function;
  request.read_address = address;
  request.read_count = count;
  return request;
}

Request write_request(Function function, std::uint16_t address, std::uint16_t count, Bytes values) {
  Request request;
  request.function = function;
  request.write_address = address;
  request.write_count = count;
  request.values = values;
  return request;
}

}  // namespace trident::bridges::modbus
