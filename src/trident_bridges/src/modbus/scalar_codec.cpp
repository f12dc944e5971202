// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scalar_codec.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace trident::bridges::modbus {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;

/// The register type that holds the same numbers; of types of one byte that of two.
ValueKind kind_of(WireType type) {
  switch (type) {
    case WireType::kInt8:
    case WireType::kInt16:
      return ValueKind::kInt16;
    case WireType::kBool:
      return ValueKind::kBool;
    case WireType::kUint8:
    case WireType::kUint16:
      return ValueKind::kUint16;
    case WireType::kInt32:
      return ValueKind::kInt32;
    case WireType::kUint32:
      return ValueKind::kUint32;
    case WireType::kInt64:
      return ValueKind::kInt64;
    case WireType::kUint64:
      return ValueKind::kUint64;
    case WireType::kFloat32:
      return ValueKind::kFloat32;
    default:
      return ValueKind::kFloat64;
  }
}

void append_bits(std::uint64_t bits, std::size_t size, std::vector<std::uint8_t>& out) {
  for (std::size_t i = 0; i < size; ++i, bits >>= 8) out.push_back(static_cast<std::uint8_t>(bits));
}

/// Seconds and nanoseconds; durations count both from below.
void write_time(WireType type, double seconds, std::vector<std::uint8_t>& out) {
  const bool is_time = type == WireType::kTime;
  const double lowest = is_time ? 0.0 : std::numeric_limits<std::int32_t>::min();
  const double highest = is_time ? std::numeric_limits<std::uint32_t>::max()
                                 : std::numeric_limits<std::int32_t>::max();
  const double limited = std::isnan(seconds) ? 0.0 : std::clamp(seconds, lowest, highest);
  double whole = std::floor(limited);
  double part = std::round((limited - whole) * kNanosecondsPerSecond);
  if (part >= kNanosecondsPerSecond) {
    whole = std::min(whole + 1.0, highest);
    part = 0.0;
  }
  append_bits(static_cast<std::uint64_t>(static_cast<std::int64_t>(whole)), 4, out);
  append_bits(static_cast<std::uint64_t>(part), 4, out);
}

/// Numbers of one byte are limited before they are written as two.
Number limited(WireType type, const Number& number) {
  if (wire_size(type) != 1 || type == WireType::kBool) return number;
  const double lowest = type == WireType::kInt8 ? -128.0 : 0.0;
  const double highest = type == WireType::kInt8 ? 127.0 : 255.0;
  const double value = as_double(number);
  return std::isnan(value) ? 0.0 : std::clamp(value, lowest, highest);
}

}  // namespace

std::uint64_t scalar_bits(Bytes bytes) {
  std::uint64_t bits = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) bits = (bits << 8) | bytes[i];
  return bits;
}

Number read_scalar(WireType type, Bytes bytes) {
  const std::uint64_t bits = scalar_bits(bytes);
  switch (type) {
    case WireType::kInt8:
      return std::int64_t{static_cast<std::int8_t>(bits)};
    case WireType::kInt16:
      return std::int64_t{static_cast<std::int16_t>(bits)};
    case WireType::kInt32:
      return std::int64_t{static_cast<std::int32_t>(bits)};
    case WireType::kInt64:
      return static_cast<std::int64_t>(bits);
    case WireType::kFloat32: {
      const auto half = static_cast<std::uint32_t>(bits);
      float real = 0.0F;
      std::memcpy(&real, &half, sizeof(real));
      return double{real};
    }
    case WireType::kFloat64: {
      double real = 0.0;
      std::memcpy(&real, &bits, sizeof(real));
      return real;
    }
    case WireType::kTime:
      return static_cast<std::uint32_t>(bits) +
             static_cast<double>(bits >> 32) / kNanosecondsPerSecond;
    case WireType::kDuration:
      return static_cast<std::int32_t>(bits) +
             static_cast<double>(static_cast<std::int32_t>(bits >> 32)) / kNanosecondsPerSecond;
    default:
      return bits;
  }
}

void write_scalar(WireType type, const Number& number, std::vector<std::uint8_t>& out) {
  if (type == WireType::kTime || type == WireType::kDuration) {
    return write_time(type, as_double(number), out);
  }
  std::uint64_t bits = 0;
  number_to_bits(limited(type, number), kind_of(type), bits);
  append_bits(bits, wire_size(type), out);
}

}  // namespace trident::bridges::modbus
