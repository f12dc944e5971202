// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "trident_bridges/modbus/pdu.h"

namespace trident::bridges::modbus {

/// What a device says of itself (function 43 / 14, section 6.21). A text is of up to 240 bytes, so
/// that each fits into a response.
struct DeviceIdentity {
  std::string vendor = "Trident";                ///< object 0, basic
  std::string product_code = "trident_bridges";  ///< object 1, basic
  std::string revision = "0.1.0";                ///< object 2, basic
  std::string url = "";                          ///< object 3, regular
  std::string product = "";                      ///< object 4, regular
  std::string model = "";                        ///< object 5, regular
  std::string application = "";                  ///< object 6, regular

  /// Lists the fields of the map file's `identity`.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("vendor", vendor, "object 0");
    ar.field("product_code", product_code, "object 1");
    ar.field("revision", revision, "object 2");
    ar.field("url", url, "object 3, as the ones below only where it is not empty");
    ar.field("product", product, "object 4");
    ar.field("model", model, "object 5");
    ar.field("application", application, "object 6");
  }
  /// Throws Error for a text of more than 240 bytes.
  void validate() const;
};

/// The response to a request of function 43 / 14 that is legal: as many objects as fit, and where
/// the rest begins. An object that the device does not have is exception 2 when it is asked for
/// alone (code 4); a stream (1-3) then begins at object 0.
Pdu device_id_response(const DeviceIdentity& identity, const Request& request);

/// Objects of one response, and where the next one begins.
struct DeviceIdObjects {
  std::map<int, std::string> objects;  ///< by number
  bool more_follows = false;           ///< then `next` is to be asked for
  std::uint8_t next = 0;               ///< object with which the rest begins
};

/// Reads Response::values of a request of function 43 / 14. Throws Error for bytes that are too
/// short for the lengths in them.
DeviceIdObjects decode_device_id(Bytes values);

}  // namespace trident::bridges::modbus
