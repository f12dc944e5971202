// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/response.h"

#include <algorithm>

namespace trident::bridges::modbus {
namespace {

Response malformed(const Request& request, const std::string& problem) {
  Response response;
  response.kind = Response::Kind::kMalformed;
  response.problem = "response to " + function_text(request.function) + ": " + problem;
  return response;
}

Response decode_read(const Request& request, Bytes pdu) {
  const std::size_t expected =
      is_bit_function(request.function) ? packed_size(request.read_count) : 2U * request.read_count;
  if (pdu.size() < 2 || pdu[1] != expected || pdu.size() != expected + 2) {
    return malformed(request, std::to_string(pdu.size()) + " bytes with byte count " +
                                  (pdu.size() < 2 ? "missing" : std::to_string(pdu[1])) +
                                  ", legal: byte count " + std::to_string(expected));
  }
  Response response;
  response.values = pdu.subspan(2);
  return response;
}

Response decode_write(const Request& request, Bytes pdu) {
  const Pdu expected = write_response(request);
  const Bytes bytes = expected.bytes();
  if (std::equal(pdu.begin(), pdu.end(), bytes.begin(), bytes.end())) return {};
  return malformed(request, "it does not repeat the request's address and value or quantity");
}

Response decode_device_id(const Request& request, Bytes pdu) {
  constexpr std::size_t kHeader = 7;  // function, type, code, level, more, next, number of objects
  if (pdu.size() < kHeader || pdu[1] != kDeviceIdType) {
    return malformed(request, std::to_string(pdu.size()) + " bytes, legal: at least 7 of MEI 14");
  }
  Response response;
  response.values = pdu.subspan(2);
  return response;
}

bool is_exception(std::uint8_t function, Bytes pdu) {
  return pdu.size() == 2 && pdu[0] == (function | kExceptionFlag);
}

/// Empty: the response is one to that function.
std::string function_problem(std::uint8_t function, Bytes pdu) {
  if (pdu.empty()) return "it is empty";
  if (pdu[0] == function) return "";
  return "function " + std::to_string(pdu[0]) + ", legal: " + std::to_string(function) + " and " +
         std::to_string(function | kExceptionFlag);
}

}  // namespace

Pdu exception_response(Function function, ExceptionCode code) {
  Pdu pdu;
  pdu.byte(static_cast<std::uint8_t>(function) | kExceptionFlag);
  pdu.byte(static_cast<std::uint8_t>(code));
  return pdu;
}

Pdu begin_read_response(Function function, std::size_t byte_count) {
  Pdu pdu(function);
  pdu.byte(static_cast<std::uint8_t>(byte_count));
  return pdu;
}

Pdu write_response(const Request& request) {
  Pdu pdu(request.function);
  pdu.word(request.write_address);
  switch (request.function) {
    case Function::kWriteSingleCoil:
      pdu.word((request.values[0] & 1) != 0 ? kCoilOn : 0);
      break;
    case Function::kWriteSingleRegister:
      pdu.append(request.values.first(2));
      break;
    case Function::kMaskWriteRegister:
      pdu.word(request.and_mask);
      pdu.word(request.or_mask);
      break;
    default:
      pdu.word(request.write_count);
  }
  return pdu;
}

Response decode_response(const Request& request, Bytes pdu) {
  const auto function = static_cast<std::uint8_t>(request.function);
  if (is_exception(function, pdu)) {
    Response response;
    response.kind = Response::Kind::kException;
    response.exception = static_cast<ExceptionCode>(pdu[1]);
    return response;
  }
  const std::string problem = function_problem(function, pdu);
  if (!problem.empty()) return malformed(request, problem);
  if (request.read_count > 0) return decode_read(request, pdu);
  if (request.writes()) return decode_write(request, pdu);
  return decode_device_id(request, pdu);
}

}  // namespace trident::bridges::modbus
