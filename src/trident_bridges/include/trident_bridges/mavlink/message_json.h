// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// One line of JSON: {"name": "HEARTBEAT", "id": 0, "system": 1, "component": 1, "sequence": 7,
/// "fields": {"type": 2, ...}}. Numbers are exact; those that are not finite are NaN, Infinity and
/// -Infinity, as Python reads them. Characters are Latin-1 text up to the first zero. An unknown
/// message has "payload" in hexadecimal digits instead of fields, and the name "UNKNOWN".
std::string to_json(const Message& message);

}  // namespace trident::bridges::mavlink
