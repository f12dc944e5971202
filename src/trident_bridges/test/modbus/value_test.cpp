// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/value.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bytes_of_text.h"
#include "trident_base/error.h"

namespace trident::bridges::modbus {
namespace {

RegisterLayout layout_of(const std::string& type, Order words = Order::kBig,
                         Order bytes = Order::kBig, int count = 1) {
  return {parse_value_type(type), words, bytes, count};
}

std::string written(const RegisterLayout& layout, const Value& value, Fit expected = Fit::kExact) {
  std::vector<std::uint8_t> wire(static_cast<std::size_t>(2 * layout.registers()), 0xEE);
  EXPECT_EQ(write_raw(layout, value, wire), expected);
  return hex_of(wire);
}

Value number(const Number& value) { return {{value}, ""}; }

TEST(Values, AllFourOrdersOfA32BitValue) {
  const Value value = number(std::uint64_t{0x41424344});
  EXPECT_EQ(written(layout_of("uint32", Order::kBig, Order::kBig), value), "41 42 43 44");
  EXPECT_EQ(written(layout_of("uint32", Order::kLittle, Order::kBig), value), "43 44 41 42");
  EXPECT_EQ(written(layout_of("uint32", Order::kBig, Order::kLittle), value), "42 41 44 43");
  EXPECT_EQ(written(layout_of("uint32", Order::kLittle, Order::kLittle), value), "44 43 42 41");
}

TEST(Values, RealsAreIeee754) {
  EXPECT_EQ(written(layout_of("float32"), number(1.5)), "3F C0 00 00");
  EXPECT_EQ(written(layout_of("float64"), number(-2.0)), "C0 00 00 00 00 00 00 00");
}

TEST(Values, EveryTypeReadsWhatItHasWrittenInEveryOrder) {
  std::mt19937_64 random(7);
  for (const char* const type :
       {"int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"}) {
    for (const Order words : {Order::kBig, Order::kLittle}) {
      for (const Order bytes : {Order::kBig, Order::kLittle}) {
        const RegisterLayout layout = layout_of(type, words, bytes, 3);
        std::vector<std::uint8_t> wire(static_cast<std::size_t>(2 * layout.registers()));
        for (auto& byte : wire) byte = static_cast<std::uint8_t>(random() & 0x3F);
        Value value;
        read_raw(layout, wire, value);
        ASSERT_EQ(value.numbers.size(), 3U);
        EXPECT_EQ(written(layout, value), hex_of(wire)) << type;
      }
    }
  }
}

TEST(Values, IntegersOf64BitsPassWithoutLoss) {
  const std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(written(layout_of("int64"), number(lowest)), "80 00 00 00 00 00 00 00");
  EXPECT_EQ(written(layout_of("int64"), number(std::int64_t{-1})), "FF FF FF FF FF FF FF FF");
  EXPECT_EQ(written(layout_of("uint64"), number(std::numeric_limits<std::uint64_t>::max())),
            "FF FF FF FF FF FF FF FF");
  EXPECT_EQ(written(layout_of("int64"), number(std::int64_t{0x123456789ABCDEF})),
            "01 23 45 67 89 AB CD EF");
}

TEST(Values, NumbersAreRoundedToTheNearestInteger) {
  EXPECT_EQ(written(layout_of("int16"), number(2.5)), "00 03");
  EXPECT_EQ(written(layout_of("int16"), number(-1.4)), "FF FF");
}

TEST(Values, WhatATypeCannotHoldIsClamped) {
  EXPECT_EQ(written(layout_of("int16"), number(4e4), Fit::kClamped), "7F FF");
  EXPECT_EQ(written(layout_of("int16"), number(-4e4), Fit::kClamped), "80 00");
  EXPECT_EQ(written(layout_of("uint16"), number(std::int64_t{-1}), Fit::kClamped), "00 00");
  EXPECT_EQ(written(layout_of("uint16"), number(std::uint64_t{70000}), Fit::kClamped), "FF FF");
  EXPECT_EQ(written(layout_of("int32"), number(1e30), Fit::kClamped), "7F FF FF FF");
  EXPECT_EQ(written(layout_of("int64"), number(0x1p63), Fit::kClamped), "7F FF FF FF FF FF FF FF");
  EXPECT_EQ(
      written(layout_of("uint64"), number(std::numeric_limits<double>::infinity()), Fit::kClamped),
      "FF FF FF FF FF FF FF FF");
  EXPECT_EQ(
      written(layout_of("int64"), number(std::numeric_limits<std::uint64_t>::max()), Fit::kClamped),
      "7F FF FF FF FF FF FF FF");
  EXPECT_EQ(written(layout_of("float32"), number(1e300), Fit::kClamped), "7F 7F FF FF");
}

TEST(Values, NanLeavesAnIntegerAsItWasAndIsARealLikeOthers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(written(layout_of("int16"), number(nan), Fit::kNotFinite), "EE EE");
  EXPECT_EQ(written(layout_of("float32"), number(nan)), "7F C0 00 00");
}

TEST(Values, ATextIsFilledWithZerosAndCutToItsLength) {
  const RegisterLayout layout = layout_of("string(5)");
  EXPECT_EQ(written(layout, {{}, "abc"}), "61 62 63 00 00 00");
  EXPECT_EQ(written(layout, {{}, "abcdefg"}, Fit::kClamped), "61 62 63 64 65 00");
  EXPECT_EQ(written(layout_of("string(4)", Order::kBig, Order::kLittle), {{}, "abcd"}),
            "62 61 64 63");
  Value value;
  const auto wire = bytes_of("62 61 64 63");
  read_raw(layout_of("string(4)", Order::kBig, Order::kLittle), wire, value);
  EXPECT_EQ(value.text, "abcd");
}

TEST(Values, MissingNumbersLeaveTheirRegistersAsTheyAre) {
  EXPECT_EQ(written(layout_of("uint16", Order::kBig, Order::kBig, 3), number(std::uint64_t{1})),
            "00 01 EE EE EE EE");
}

TEST(Values, TypesHaveTheSizesThatTheyShow) {
  EXPECT_EQ(parse_value_type("bool").registers(), 1);
  EXPECT_EQ(parse_value_type("float64").registers(), 4);
  EXPECT_EQ(parse_value_type("string(7)").registers(), 4);
  const ValueType bits = parse_value_type("bits(leak, -, fire)");
  EXPECT_EQ(bits.bits, (std::vector<std::string>{"leak", "-", "fire"}));
  EXPECT_EQ(bits.text(), "bits(leak - fire)");
  EXPECT_EQ(parse_value_type("string(7)").text(), "string(7)");
}

TEST(Values, AnUnknownTypeIsRefusedWithTheNearestOne) {
  try {
    parse_value_type("int61");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'int16'"), std::string::npos)
        << error.what();
  }
  for (const char* const text :
       {"", "string", "string()", "string(0)", "string(1.5)", "string(9999)", "bits()", "bits( , )",
        "INT16", "bits(a b c d e f g h i j k l m n o p q)"}) {
    EXPECT_THROW(parse_value_type(text), Error) << text;
  }
}

}  // namespace
}  // namespace trident::bridges::modbus
