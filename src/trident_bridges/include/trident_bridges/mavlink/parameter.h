// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace trident::bridges::mavlink {

inline constexpr std::size_t kMaxParameterName = 16;  ///< [characters]

/// MAV_PARAM_TYPE, as far as autopilots use it.
enum class ParameterType : std::uint8_t {
  kUint8 = 1,
  kInt8 = 2,
  kUint16 = 3,
  kInt16 = 4,
  kUint32 = 5,
  kInt32 = 6,
  kReal32 = 9
};

/// How whole numbers travel in the float of PARAM_VALUE: as PX4 does it (their bytes) or as
/// ArduPilot does it (converted to a float).
enum class ParameterEncoding : std::uint8_t { kBytewise, kCast };

/// A parameter of a vehicle.
struct Parameter {
  std::string name;                             ///< up to kMaxParameterName characters
  ParameterType type = ParameterType::kReal32;  ///< of the value
  double value = 0.0;                           ///< whole where the type is
  double min = 0.0, max = 0.0;                  ///< legal values
};

/// The value as the field param_value holds it.
float encode_parameter(double value, ParameterType type, ParameterEncoding encoding);
/// The reverse. NaN for a type that is not known.
double decode_parameter(float field, ParameterType type, ParameterEncoding encoding);

}  // namespace trident::bridges::mavlink
