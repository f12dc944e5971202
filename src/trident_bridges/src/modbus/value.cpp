// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/value.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <type_traits>

namespace trident::bridges::modbus {
namespace {

constexpr int kBitsPerRegister = 16;

/// Whether the most significant bit is a sign.
bool is_signed(ValueKind kind) {
  return kind == ValueKind::kInt16 || kind == ValueKind::kInt32 || kind == ValueKind::kInt64;
}

std::uint64_t read_words(const RegisterLayout& layout, Bytes wire, int words) {
  std::uint64_t bits = 0;
  for (int i = 0; i < words; ++i) {
    const int at = 2 * (layout.words == Order::kBig ? i : words - 1 - i);
    const unsigned first = wire[at], second = wire[at + 1];
    bits = (bits << 16) |
           (layout.bytes == Order::kBig ? (first << 8) | second : (second << 8) | first);
  }
  return bits;
}

void write_words(const RegisterLayout& layout, std::uint64_t bits, int words,
                 Span<std::uint8_t> wire) {
  for (int i = words - 1; i >= 0; --i, bits >>= 16) {
    const int at = 2 * (layout.words == Order::kBig ? i : words - 1 - i);
    const auto high = static_cast<std::uint8_t>(bits >> 8), low = static_cast<std::uint8_t>(bits);
    wire[at] = layout.bytes == Order::kBig ? high : low;
    wire[at + 1] = layout.bytes == Order::kBig ? low : high;
  }
}

Number number_of_bits(ValueKind kind, std::uint64_t bits) {
  switch (kind) {
    case ValueKind::kBool:
      return std::uint64_t{bits != 0};
    case ValueKind::kInt16:
      return std::int64_t{static_cast<std::int16_t>(bits)};
    case ValueKind::kInt32:
      return std::int64_t{static_cast<std::int32_t>(bits)};
    case ValueKind::kInt64:
      return static_cast<std::int64_t>(bits);
    case ValueKind::kFloat32: {
      const auto half = static_cast<std::uint32_t>(bits);
      float real = 0.0F;
      std::memcpy(&real, &half, sizeof(real));
      return double{real};
    }
    case ValueKind::kFloat64: {
      double real = 0.0;
      std::memcpy(&real, &bits, sizeof(real));
      return real;
    }
    default:
      return bits;
  }
}

/// 2^63 and 2^64 are doubles, the limits below them are not: the comparison must not let them in.
bool is_in_range(double rounded, ValueKind kind) {
  const auto [lowest, highest] = raw_limits(kind);
  const double beyond = is_signed(kind) ? 0x1p63 : 0x1p64;
  return rounded >= lowest && rounded <= highest && rounded < beyond;
}

/// Bits of the limit that a number lies beyond.
std::uint64_t limit_bits(double rounded, ValueKind kind) {
  const int width = kBitsPerRegister * ValueType{kind}.registers();
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - width);
  const std::uint64_t least = is_signed(kind) ? ~(all >> 1) : 0;
  const std::uint64_t greatest = is_signed(kind) ? all >> 1 : all;
  return rounded < raw_limits(kind)[0] ? least : greatest;
}

Fit bits_of_real(double real, ValueKind kind, std::uint64_t& bits) {
  if (std::isnan(real)) return Fit::kNotFinite;
  const double rounded = std::round(real);
  if (!is_in_range(rounded, kind)) {
    bits = limit_bits(rounded, kind);
    return Fit::kClamped;
  }
  bits = is_signed(kind) ? static_cast<std::uint64_t>(static_cast<std::int64_t>(rounded))
                         : static_cast<std::uint64_t>(rounded);
  return Fit::kExact;
}

Fit bits_of_signed(std::int64_t whole, ValueKind kind, std::uint64_t& bits) {
  bits = static_cast<std::uint64_t>(whole);
  const bool fits = kind == ValueKind::kInt64 || (kind == ValueKind::kUint64 && whole >= 0);
  return fits ? Fit::kExact : bits_of_real(static_cast<double>(whole), kind, bits);
}

Fit bits_of_unsigned(std::uint64_t whole, ValueKind kind, std::uint64_t& bits) {
  constexpr auto kMaxInt64 = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  bits = whole;
  const bool fits = kind == ValueKind::kUint64 || (kind == ValueKind::kInt64 && whole <= kMaxInt64);
  return fits ? Fit::kExact : bits_of_real(static_cast<double>(whole), kind, bits);
}

/// The integer nearest to a number, as the bits of a type of that many bits.
Fit integer_bits(const Number& number, ValueKind kind, std::uint64_t& bits) {
  if (const auto* const real = std::get_if<double>(&number)) {
    return bits_of_real(*real, kind, bits);
  }
  if (const auto* const whole = std::get_if<std::int64_t>(&number)) {
    return bits_of_signed(*whole, kind, bits);
  }
  return bits_of_unsigned(std::get<std::uint64_t>(number), kind, bits);
}

Fit real_bits(double real, ValueKind kind, std::uint64_t& bits) {
  if (kind == ValueKind::kFloat64) {
    std::memcpy(&bits, &real, sizeof(bits));
    return Fit::kExact;
  }
  constexpr double kMaxFloat = std::numeric_limits<float>::max();
  const bool is_beyond = std::isfinite(real) && std::abs(real) > kMaxFloat;
  const auto single = static_cast<float>(is_beyond ? std::copysign(kMaxFloat, real) : real);
  std::uint32_t half = 0;
  std::memcpy(&half, &single, sizeof(half));
  bits = half;
  return is_beyond ? Fit::kClamped : Fit::kExact;
}

void read_text(const RegisterLayout& layout, Bytes wire, std::string& text) {
  text.clear();
  const std::size_t swap = layout.bytes == Order::kBig ? 0 : 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout.type.characters); ++i) {
    const char c = static_cast<char>(wire[i ^ swap]);
    if (c == '\0') break;
    text += c;
  }
}

Fit write_text(const RegisterLayout& layout, const std::string& text, Span<std::uint8_t> wire) {
  const std::size_t swap = layout.bytes == Order::kBig ? 0 : 1;
  const auto characters = static_cast<std::size_t>(layout.type.characters);
  for (std::size_t i = 0; i < wire.size(); ++i) {
    wire[i ^ swap] = i < std::min(text.size(), characters) ? static_cast<std::uint8_t>(text[i]) : 0;
  }
  return text.size() > characters ? Fit::kClamped : Fit::kExact;
}

}  // namespace

double as_double(const Number& number) {
  return std::visit([](auto value) { return static_cast<double>(value); }, number);
}

std::string number_to_text(const Number& number) {
  return std::visit(
      [](auto value) {
        if constexpr (std::is_same_v<decltype(value), double>) {
          // Not all digits: 1001 times 0.001 is to be shown as 1.001.
          char text[32];
          std::snprintf(text, sizeof(text), "%.9g", value);
          return std::string(text);
        } else {
          return std::to_string(value);
        }
      },
      number);
}

std::string value_to_text(const Value& value) {
  if (value.numbers.empty()) return "'" + value.text + "'";
  if (value.numbers.size() == 1) return number_to_text(value.numbers[0]);
  std::vector<std::string> parts;
  for (const Number& number : value.numbers) parts.push_back(number_to_text(number));
  return "[" + join(parts) + "]";
}

void read_raw(const RegisterLayout& layout, Bytes wire, Value& value) {
  value.numbers.clear();
  value.text.clear();
  if (layout.type.kind == ValueKind::kString) return read_text(layout, wire, value.text);
  const int words = layout.type.registers();
  for (int i = 0; i < layout.count; ++i) {
    const Bytes own = wire.subspan(2U * i * words, 2U * words);
    value.numbers.push_back(number_of_bits(layout.type.kind, read_words(layout, own, words)));
  }
}

Fit write_raw(const RegisterLayout& layout, const Value& value, Span<std::uint8_t> wire) {
  if (layout.type.kind == ValueKind::kString) return write_text(layout, value.text, wire);
  const int words = layout.type.registers();
  const int count = std::min(layout.count, static_cast<int>(value.numbers.size()));
  Fit worst = Fit::kExact;
  for (int i = 0; i < count; ++i) {
    std::uint64_t bits = 0;
    const Fit fit = number_to_bits(value.numbers[i], layout.type.kind, bits);
    worst = std::max(worst, fit);
    if (fit == Fit::kNotFinite) continue;
    write_words(layout, bits, words, wire.subspan(2U * i * words, 2U * words));
  }
  return worst;
}

Fit number_to_bits(const Number& number, ValueKind kind, std::uint64_t& bits) {
  if (kind == ValueKind::kFloat32 || kind == ValueKind::kFloat64) {
    return real_bits(as_double(number), kind, bits);
  }
  if (kind != ValueKind::kBool) return integer_bits(number, kind, bits);
  if (std::isnan(as_double(number))) return Fit::kNotFinite;
  bits = as_double(number) != 0.0 ? 1 : 0;
  return Fit::kExact;
}

std::array<double, 2> raw_limits(ValueKind kind) {
  switch (kind) {
    case ValueKind::kBool:
      return {0.0, 1.0};
    case ValueKind::kInt16:
      return {-0x1p15, 0x1p15 - 1};
    case ValueKind::kInt32:
      return {-0x1p31, 0x1p31 - 1};
    case ValueKind::kUint32:
      return {0.0, 0x1p32 - 1};
    case ValueKind::kInt64:
      return {-0x1p63, 0x1p63};
    case ValueKind::kUint64:
      return {0.0, 0x1p64};
    case ValueKind::kFloat32:
      return {-double{std::numeric_limits<float>::max()},
              double{std::numeric_limits<float>::max()}};
    case ValueKind::kFloat64:
      return {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
    default:
      return {0.0, 0x1p16 - 1};
  }
}

}  // namespace trident::bridges::modbus
