// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/register_map.h"

#include <gtest/gtest.h>

namespace trident::bridges::modbus {
namespace {

/// A map of one register with these fields besides its name and address.
std::string map_of(const std::string& fields) {
  return "unit: 1\nregisters:\n  - {name: a, " + fields + "}\n";
}

RegisterEntry entry_of(const std::string& fields) {
  return parse_register_map(map_of(fields), "m.yaml").entries.at(0);
}

/// What is wrong with such a map; "" for a legal one.
std::string error_of(const std::string& fields) {
  const auto errors = errors_of_map(map_of(fields), "m.yaml");
  return errors.empty() ? "" : errors.front().what();
}

TEST(RegisterMap, ALineSaysWhatARegisterHolds) {
  const RegisterEntry entry = entry_of(
      "table: holding, address: 100, type: int16, scale: 0.001, access: write, min: -1.0, max: 1.0,"
      "rate: 2.0, safe: 0.0, timeout: 0.5, topic: thrusters/left_thrust_cmd, "
      "message: std_msgs/Float32");
  EXPECT_EQ(entry.table, Table::kHolding);
  EXPECT_EQ(entry.address, 100);
  EXPECT_EQ(entry.end(), 101);
  EXPECT_TRUE(entry.is_writable());
  EXPECT_FALSE(entry.is_polled());
  EXPECT_EQ(entry.rate, 2.0);
  EXPECT_EQ(entry.timeout, 0.5);
  EXPECT_EQ(entry.message, "std_msgs/Float32");
  EXPECT_EQ(entry.label(), "'a' (holding 100)");
  EXPECT_EQ(entry.line, 3);
}

TEST(RegisterMap, TheMessageFollowsFromTheTypeUnlessItIsGiven) {
  EXPECT_EQ(entry_of("table: coil, address: 0").message, "std_msgs/Bool");
  EXPECT_EQ(entry_of("table: input, address: 0").message, "std_msgs/UInt16");
  EXPECT_EQ(entry_of("table: input, address: 0, type: int32").message, "std_msgs/Int32");
  EXPECT_EQ(entry_of("table: input, address: 0, scale: 0.1").message, "std_msgs/Float64");
  EXPECT_EQ(entry_of("table: input, address: 0, type: string(4)").message, "std_msgs/String");
  EXPECT_EQ(entry_of("table: input, address: 0, type: float32, count: 5").message,
            "std_msgs/Float32MultiArray");
}

TEST(RegisterMap, ScaleAndOffsetTurnRegistersIntoValuesAndBack) {
  const RegisterEntry entry = entry_of("table: input, address: 0, scale: 0.1, offset: -40.0");
  std::vector<std::uint8_t> wire{0, 0};
  EXPECT_EQ(write_value(entry, {{Number{21.5}}, ""}, wire), Fit::kExact);
  EXPECT_EQ(wire, (std::vector<std::uint8_t>{0x02, 0x67}));
  Value value;
  read_value(entry, wire, value);
  EXPECT_DOUBLE_EQ(as_double(value.numbers.at(0)), 21.5);
}

TEST(RegisterMap, BitsAreOneByteEach) {
  const RegisterEntry entry = entry_of("table: coil, address: 7, count: 3");
  EXPECT_EQ(entry.addresses(), 3);
  std::vector<std::uint8_t> wire(3);
  write_value(entry, {{Number{1.0}, Number{0.0}, Number{std::uint64_t{5}}}, ""}, wire);
  EXPECT_EQ(wire, (std::vector<std::uint8_t>{1, 0, 1}));
  Value value;
  read_value(entry, wire, value);
  EXPECT_EQ(as_double(value.numbers.at(2)), 1.0);
}

TEST(RegisterMap, ModiconNumbersNameTheTable) {
  const auto placed = [](const std::string& address) {
    const auto map = parse_register_map(
        "numbering: modicon\nregisters:\n  - {name: a, address: " + address + "}\n", "m.yaml");
    return map.entries.at(0).label();
  };
  EXPECT_EQ(placed("1"), "'a' (coil 0)");
  EXPECT_EQ(placed("10001"), "'a' (discrete 0)");
  EXPECT_EQ(placed("30010"), "'a' (input 9)");
  EXPECT_EQ(placed("40001"), "'a' (holding 0)");
  EXPECT_EQ(placed("465536"), "'a' (holding 65535)");
  for (const char* const bad : {"0", "10000", "20001", "50001", "400000", "200001"}) {
    EXPECT_THROW(placed(bad), ConfigError) << bad;
  }
}

TEST(RegisterMap, WhatCannotBeIsOneErrorWithFileLineKeyAndLegalValues) {
  const char* const cases[][2] = {
      {"table: input, address: 0, scale: 0", "m.yaml:3: registers[0].scale: 0, legal: "},
      {"table: input, address: 0, words: middle", "m.yaml:3: registers[0].words: "},
      {"table: input, address: 0, type: int61",
       "m.yaml:3: registers[0].type: unknown type 'int61'"},
      {"table: inputs, address: 0", "m.yaml:3: registers[0].table: "},
      {"address: 0", "m.yaml:3: registers[0].table: is required"},
      {"table: input, address: 65536", "registers[0].address: 65536, legal: 0 to 65535"},
      {"table: input, address: 65535, type: int32", "addresses 65535 to 65536, legal: up to 65535"},
      {"table: input, address: 0, scales: 1", "did you mean 'scale'"},
      {"table: input, address: 0, access: write", "registers[0].access: "},
      {"table: discrete, address: 0, access: read_write", "registers[0].access: "},
      {"table: input, address: 0, min: 1", "registers[0].min: only of access: write"},
      {"table: coil, address: 0, type: int16", "registers[0].type: int16 of table coil"},
      {"table: coil, address: 0, scale: 2.0", "registers[0].scale: "},
      {"table: holding, address: 0, access: write, min: 2, max: 1", "registers[0].min: 2, legal: "},
      {"table: holding, address: 0, access: write, min: 1, safe: 0",
       "registers[0].safe: 0, legal: "},
      {"table: holding, address: 0, access: write, timeout: 1", "registers[0].timeout: needs"},
      {"table: holding, address: 0, access: write, timeout: -1, safe: 0", "registers[0].timeout: "},
      {"table: holding, address: 0, access: write, rate: 0", "registers[0].rate: "},
      {"table: holding, address: 0, type: string(4), access: write, max: 1", "registers[0].type: "},
      {"table: holding, address: 0, type: string(4), count: 2", "registers[0].count: 2 of type"},
      {"table: holding, address: 0, type: float64, count: 32",
       "it takes 128 addresses, legal: up to"},
      {"table: input, address: 0, topic: 'a b'", "registers[0].topic: 'a b' is no name"},
      {"table: input, address: 0, topic: a//b", "registers[0].topic: "},
      {"table: input, address: 0, message: Float64", "registers[0].message: 'Float64' is no type"},
      {"table: input, address: 0, type: bits(a 2b)", "registers[0].type: '2b' is no name of a bit"},
      {"table: input, address: 0, initial: x", "registers[0].initial: 'x', legal: a number"},
  };
  for (const auto& [fields, expected] : cases) {
    EXPECT_NE(error_of(fields).find(expected), std::string::npos)
        << fields << "\n  gives: " << error_of(fields) << "\n  not: " << expected;
  }
}

TEST(RegisterMap, ValuesMayNotOverlapNorShareAName) {
  const auto errors = errors_of_map(
      "registers:\n"
      "  - {name: a, table: input, address: 10, type: float32}\n"
      "  - {name: b, table: holding, address: 11}\n"
      "  - {name: c, table: input, address: 11}\n"
      "  - {name: c, table: input, address: 12}\n",
      "m.yaml");
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_STREQ(errors[0].what(),
               "m.yaml:4: registers: 'c' (input 11) takes address 11, of which 'a' (input 10) of "
               "line 2 has addresses 10 to 11");
  EXPECT_STREQ(errors[1].what(), "m.yaml:5: registers: name 'c' is used twice");
}

TEST(RegisterMap, AllErrorsAreFoundAtOnce) {
  const auto errors = errors_of_map(
      "registers:\n"
      "  - {name: a, table: input, address: 0, scale: 0}\n"
      "  - {name: b, table: input, address: 1, words: x}\n"
      "  - {name: c, table: input, address: 2}\n"
      "  - {name: d, table: input, address: 2}\n",
      "m.yaml");
  ASSERT_EQ(errors.size(), 3U);
  EXPECT_EQ(errors[0].line(), 2);
  EXPECT_EQ(errors[1].line(), 3);
  EXPECT_EQ(errors[2].line(), 5);
}

TEST(RegisterMap, AFileWithoutRegistersIsRefused) {
  for (const char* const text :
       {"", "unit: 1\n", "registers: []\n", "registers: 5\n", "registers: {a: 1}\n",
        "registers: [5]\n", "unit: 0\nregisters: []\n", "registers: [\n", "- a\n"}) {
    EXPECT_FALSE(errors_of_map(text, "m.yaml").empty()) << text;
    EXPECT_THROW(parse_register_map(text, "m.yaml"), ConfigError) << text;
  }
}

TEST(RegisterMap, WhatHasASafeValueBeginsWithIt) {
  const auto entry = entry_of(
      "table: holding, address: 0, access: write, type: int16, count: 2, safe: -5.0, timeout: 1");
  ASSERT_EQ(entry.initial.numbers.size(), 2U);
  EXPECT_EQ(as_double(entry.initial.numbers[1]), -5.0);
  EXPECT_EQ(entry_of("table: input, address: 0, type: string(8), initial: v1").initial.text, "v1");
  EXPECT_EQ(as_double(entry_of("table: input, address: 0, initial: 7").initial.numbers.at(0)), 7.0);
}

}  // namespace
}  // namespace trident::bridges::modbus
