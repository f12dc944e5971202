// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_bridges/modbus/pdu.h"

namespace trident::bridges::modbus {

/// What registers hold.
enum class ValueKind {
  kBool,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kString,
  kBits,
};

/// The type of a value as map files write it: "int16", "string(12)", "bits(leak fire)".
struct ValueType {
  ValueKind kind = ValueKind::kUint16;  ///< decides which of the members below count
  int characters = 0;                   ///< of a kString
  std::vector<std::string> bits = {};   ///< of kBits, from the least significant; "-": not used
  int registers() const;                ///< that one value takes; a kBool takes one, too
  bool is_integer() const;              ///< kInt16 to kUint64
  bool is_real() const;                 ///< kFloat32 and kFloat64
  std::string text() const;             ///< as map files write it
};

/// Reads a type. Names of bits are separated by spaces or commas. Throws Error with the nearest
/// known type.
ValueType parse_value_type(const std::string& text);

/// Which part comes first in a value of several bytes or registers.
enum class Order { kBig, kLittle };
/// For map files.
constexpr auto enum_names(Order) {
  return std::array{EnumName{Order::kBig, "big"}, EnumName{Order::kLittle, "little"}};
}

/// How a value lies in registers. With words and bytes big, a 32-bit value ABCD is sent as ABCD;
/// words little: CDAB, bytes little: BADC, both little: DCBA.
struct RegisterLayout {
  ValueType type;             ///< of each value
  Order words = Order::kBig;  ///< big: the register of the most significant bits comes first
  Order bytes = Order::kBig;  ///< big: the most significant byte of a register comes first
  int count = 1;              ///< values, one behind the other
  int registers() const { return count * type.registers(); }  ///< of all values
};

/// A number without loss: integers of up to 64 bits, or a real.
using Number = std::variant<std::int64_t, std::uint64_t, double>;

/// The nearest double.
double as_double(const Number& number);
/// "1.5", "-3": nine digits of a real, for messages and tools.
std::string number_to_text(const Number& number);

/// What registers stand for: numbers, or of a kString its text.
struct Value {
  std::vector<Number> numbers;  ///< as many as RegisterLayout::count
  std::string text;             ///< of a kString
  bool operator==(const Value& other) const {
    return numbers == other.numbers && text == other.text;
  }
  bool operator!=(const Value& other) const { return !(*this == other); }
};

/// A value as a message shows it: "1.5", "[1, 2]", "'text'".
std::string value_to_text(const Value& value);

/// Reads raw numbers or a text from registers as on the wire; `wire` has two bytes a register.
/// Reuses what `value` has allocated.
void read_raw(const RegisterLayout& layout, Bytes wire, Value& value);

/// What became of a number that was written into registers.
enum class Fit {
  kExact,      ///< as it was, rounded to the register's resolution
  kClamped,    ///< to the nearest one that the type has
  kNotFinite,  ///< NaN has no integer: the registers are as before
};

/// Writes raw numbers or a text into registers; returns the worst that became of them. Numbers that
/// are missing leave their registers as they are; a text that is too long is clamped, a shorter one
/// is filled with zeros.
Fit write_raw(const RegisterLayout& layout, const Value& value, Span<std::uint8_t> wire);

/// The bits of a number as a type has them, in the lowest places of `bits`; NaN of an integer
/// leaves them as they are. A kBool is whether the number is not 0.
Fit number_to_bits(const Number& number, ValueKind kind, std::uint64_t& bits);

/// The numbers that a type can hold: [lowest, highest]; of kFloat32 the finite ones.
std::array<double, 2> raw_limits(ValueKind kind);

}  // namespace trident::bridges::modbus
