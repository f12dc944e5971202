// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Names of parameters in messages. For sources alone: brings the dialect.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/parameter.h"

namespace trident::bridges::mavlink {

/// The name in a field param_id, which ends at a zero or is full.
inline std::string parameter_name(const char (&field)[kMaxParameterName]) {
  return {field, ::strnlen(field, sizeof field)};
}

/// Writes a name of up to kMaxParameterName characters into a field param_id of zeros.
inline void put_parameter_name(const std::string& name, char (&field)[kMaxParameterName]) {
  std::memcpy(field, name.data(), std::min(name.size(), sizeof field));
}

}  // namespace trident::bridges::mavlink
