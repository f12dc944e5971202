// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "trident_bridges/modbus/pdu.h"

namespace trident::bridges::modbus {

/// What came back for a request.
struct Response {
  enum class Kind {
    kDone,       ///< executed; `values` of a read
    kException,  ///< refused by the device for `exception`
    kMalformed,  ///< no answer to that request: `problem`
  };
  Kind kind = Kind::kDone;    ///< decides which of the members below count
  ExceptionCode exception{};  ///< of kException
  /// What was read, as in Request::values; of function 43 what follows the MEI type.
  Bytes values;
  std::string problem = {};  ///< of kMalformed: the field, its value, the legal one
};

/// Reads the response to `request`; any bytes will do. Whether the device repeats what was asked
/// for (section 6: address, quantity, value) is checked, too.
Response decode_response(const Request& request, Bytes pdu);

/// The refusal of a request.
Pdu exception_response(Function function, ExceptionCode code);
/// Begins the response to a read: function and byte count; the caller appends so many bytes.
Pdu begin_read_response(Function function, std::size_t byte_count);
/// The response to a write, which repeats address and quantity, value or masks. Not for function
/// 23, whose response is that to a read.
Pdu write_response(const Request& request);

}  // namespace trident::bridges::modbus
