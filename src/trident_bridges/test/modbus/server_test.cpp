// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/server.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bytes_of_text.h"

namespace trident::bridges::modbus {
namespace {

const char* const kServerMap = R"(
unit: 17
hold: 1.0
registers:
  - {name: leak, table: discrete, address: 0}
  - {name: door, table: discrete, address: 1}
  - {name: pump, table: coil, address: 3, access: read_write}
  - {name: lamps, table: coil, address: 4, count: 9, access: write}
  - {name: rpm, table: input, address: 0, type: int16}
  - {name: volt, table: input, address: 1, type: float32}
  - {name: far, table: input, address: 200}
  - {name: serial, table: holding, address: 0, initial: 4711}
  - {name: cmd, table: holding, address: 1, type: int16, scale: 0.001, access: write,
     min: -1.0, max: 1.0, safe: 0.25, timeout: 0.5, unit: rpm}
  - {name: slow, table: holding, address: 2, type: int16, access: write, rate: 10.0}
  - {name: setpoint, table: holding, address: 3, type: float32, access: read_write}
  - {name: word, table: holding, address: 5, access: write}
  - {name: row, table: holding, address: 6, type: uint32, count: 2, access: write}
)";

/// A server, and what it has reported.
struct TestServer {
  std::vector<std::string> written, refused;
  Server server{parse_register_map(kServerMap, "m.yaml"),
                {[this](std::size_t entry, const Value& value, bool is_safe) {
                   written.push_back(server.map().entries[entry].name + " = " +
                                     value_to_text(value) + (is_safe ? " (safe)" : ""));
                 },
                 [this](const std::string& kind, const std::string& text) {
                   refused.push_back(kind + ": " + text);
                 }}};
  Caller caller{1, "tcp 127.0.0.1:40000"};
  std::uint8_t unit = 17;

  /// The answer to a request, as text.
  std::string ask(const std::string& hex, double now_s = 0.0) {
    const auto request = bytes_of(hex);
    const auto response = server.handle(caller, unit, request, now_s);
    return response ? hex_of(response->bytes()) : "nothing";
  }
  void set(const std::string& name, double value) {
    server.set(*server.map().find(name), {{Number{value}}, ""});
  }
  double get(const std::string& name) {
    return as_double(server.value(*server.map().find(name)).numbers.at(0));
  }
};

using Texts = std::vector<std::string>;

TEST(ModbusServer, ReadsEveryTable) {
  TestServer test;
  test.set("door", 1.0);
  test.set("pump", 1.0);
  test.set("rpm", -2.0);
  test.set("volt", 1.5);
  EXPECT_EQ(test.ask("02 00 00 00 02"), "02 01 02");
  EXPECT_EQ(test.ask("01 00 03 00 0A"), "01 02 01 00");
  EXPECT_EQ(test.ask("04 00 00 00 03"), "04 06 FF FE 3F C0 00 00");
  EXPECT_EQ(test.ask("03 00 00 00 02"), "03 04 12 67 00 FA");
  EXPECT_EQ(test.server.counts().reads, 2U + 10U + 3U + 2U);
}

TEST(ModbusServer, WritesByEveryFunction) {
  TestServer test;
  EXPECT_EQ(test.ask("05 00 03 FF 00"), "05 00 03 FF 00");
  EXPECT_EQ(test.ask("0F 00 04 00 09 02 01 01"), "0F 00 04 00 09");
  EXPECT_EQ(test.ask("06 00 05 12 34"), "06 00 05 12 34");
  EXPECT_EQ(test.ask("10 00 03 00 02 04 3F C0 00 00"), "10 00 03 00 02");
  EXPECT_EQ(test.ask("16 00 05 F0 0F 00 04"), "16 00 05 F0 0F 00 04");
  EXPECT_EQ(test.ask("17 00 05 00 01 00 05 00 01 02 00 07"), "17 02 00 07");
  EXPECT_EQ(test.written, (Texts{"pump = 1", "lamps = [1, 0, 0, 0, 0, 0, 0, 0, 1]", "word = 4660",
                                 "setpoint = 1.5", "word = 4100", "word = 7"}));
  EXPECT_EQ(test.ask("01 00 03 00 0A"), "01 02 03 02");
  EXPECT_EQ(test.refused, Texts());
}

TEST(ModbusServer, AMaskWritesTheBitsThatItNames) {
  TestServer test;
  test.set("word", 0x12);
  test.ask("16 00 05 00 F2 00 25");  // the example of section 6.16
  EXPECT_EQ(test.get("word"), 0x17);
}

TEST(ModbusServer, WhatIsNotThereIsExceptionTwo) {
  TestServer test;
  EXPECT_EQ(test.ask("04 00 00 00 04"), "84 02");
  EXPECT_EQ(test.ask("04 00 03 00 01"), "84 02");
  EXPECT_EQ(test.ask("04 00 C8 00 02"), "84 02");
  EXPECT_EQ(test.ask("04 FF FF 00 01"), "84 02");
  EXPECT_EQ(test.ask("01 00 02 00 02"), "81 02");
  EXPECT_EQ(test.ask("06 00 0B 00 00"), "86 02");
  EXPECT_EQ(test.ask("04 00 C8 00 01"), "04 02 00 00");
  EXPECT_EQ(test.refused.at(0),
            "unknown address: tcp 127.0.0.1:40000: read input registers (4): address 3 of table "
            "input, legal: those of m.yaml; illegal address (exception 2)");
}

TEST(ModbusServer, WhatIsNotWritableIsExceptionTwo) {
  TestServer test;
  EXPECT_EQ(test.ask("06 00 00 00 01"), "86 02");
  EXPECT_EQ(test.ask("10 00 00 00 02 04 00 01 00 01"), "90 02");
  EXPECT_EQ(test.written, Texts());
  EXPECT_EQ(test.get("serial"), 4711);
}

TEST(ModbusServer, PartOfAValueIsExceptionTwo) {
  TestServer test;
  EXPECT_EQ(test.ask("06 00 03 3F C0"), "86 02");
  EXPECT_EQ(test.ask("10 00 04 00 02 04 00 00 00 01"), "90 02");
  EXPECT_EQ(test.ask("10 00 07 00 02 04 00 00 00 01"), "90 02");
  EXPECT_EQ(test.ask("10 00 08 00 02 04 00 00 00 05"), "10 00 08 00 02") << "the second of a row";
  EXPECT_EQ(test.written, Texts{"row = [0, 5]"});
}

TEST(ModbusServer, ValuesOutOfRangeAreExceptionThree) {
  TestServer test;
  EXPECT_EQ(test.ask("06 00 01 03 E9"), "86 03");
  EXPECT_EQ(test.ask("06 00 01 FC 17"), "86 03");
  EXPECT_EQ(test.ask("06 00 01 03 E8"), "06 00 01 03 E8");
  EXPECT_EQ(test.ask("10 00 03 00 02 04 7F C0 00 00"), "90 03") << "NaN";
  EXPECT_EQ(test.ask("10 00 03 00 02 04 7F 80 00 00"), "90 03") << "infinite";
  EXPECT_NE(test.refused.at(0).find("'cmd' (holding 1): 1.001, legal: [-1, 1] rpm"),
            std::string::npos)
      << test.refused.at(0);
}

TEST(ModbusServer, OneBadValueRefusesTheWholeWrite) {
  TestServer test;
  EXPECT_EQ(test.ask("10 00 01 00 02 04 00 01 FF FF"), "10 00 01 00 02");
  test.written.clear();
  EXPECT_EQ(test.ask("10 00 01 00 02 04 7F FF 00 00"), "90 03");
  EXPECT_EQ(test.ask("10 00 01 00 02 04 00 02 7F FF", 0.1), "90 06") << "the rate of slow";
  EXPECT_EQ(test.written, Texts());
  EXPECT_DOUBLE_EQ(test.get("cmd"), 0.001);
  EXPECT_EQ(test.get("slow"), -1.0);
}

TEST(ModbusServer, AReadAndWriteThatCannotBeReadWritesNothing) {
  TestServer test;
  EXPECT_EQ(test.ask("17 01 00 00 01 00 05 00 01 02 00 07"), "97 02");
  EXPECT_EQ(test.written, Texts());
}

TEST(ModbusServer, AChangeThatIsTooFastIsExceptionSix) {
  TestServer test;
  EXPECT_EQ(test.ask("06 00 02 00 64", 1.0), "06 00 02 00 64") << "no write before it";
  EXPECT_EQ(test.ask("06 00 02 00 6A", 1.5), "86 06");
  EXPECT_EQ(test.ask("06 00 02 00 69", 1.5), "06 00 02 00 69");
  EXPECT_EQ(test.ask("06 00 02 00 5F", 2.5), "06 00 02 00 5F");
  EXPECT_NE(test.refused.at(0).find("change of 6 in 0.5 s, legal: 10 per s"), std::string::npos)
      << test.refused.at(0);
}

TEST(ModbusServer, TheFirstOfTwoWritersHoldsAValue) {
  TestServer test;
  EXPECT_EQ(test.ask("06 00 05 00 01", 1.0), "06 00 05 00 01");
  test.caller = {2, "tcp 127.0.0.1:40001"};
  EXPECT_EQ(test.ask("06 00 05 00 02", 1.9), "86 06");
  EXPECT_EQ(test.ask("06 00 02 00 02", 1.9), "06 00 02 00 02") << "another value";
  EXPECT_EQ(test.ask("06 00 05 00 02", 2.0), "06 00 05 00 02");
  test.caller.id = 1;
  EXPECT_EQ(test.ask("06 00 05 00 01", 2.1), "86 06");
  test.server.release(2);
  EXPECT_EQ(test.ask("06 00 05 00 01", 2.2), "06 00 05 00 01");
}

TEST(ModbusServer, ASilentWritersValueBecomesSafeOnceAndInTime) {
  TestServer test;
  test.server.update(10.0);
  EXPECT_EQ(test.written, Texts()) << "no write, no silence";
  test.ask("06 00 01 03 E8", 10.0);
  test.server.update(10.499);
  EXPECT_EQ(test.written, Texts{"cmd = 1"});
  test.server.update(10.5);
  test.server.update(11.0);
  EXPECT_EQ(test.written, (Texts{"cmd = 1", "cmd = 0.25 (safe)"}));
  EXPECT_DOUBLE_EQ(test.get("cmd"), 0.25);
  EXPECT_EQ(test.server.counts().safe, 1U);
}

TEST(ModbusServer, RefusedWritesDoNotKeepAWriterAlive) {
  TestServer test;
  test.ask("06 00 01 03 E8", 10.0);
  EXPECT_EQ(test.ask("06 00 01 7F FF", 10.4), "86 03");
  test.server.update(10.5);
  EXPECT_EQ(test.written.back(), "cmd = 0.25 (safe)");
}

TEST(ModbusServer, AStandingClockMakesNothingSafeAndAResetRestartsLimits) {
  TestServer test;
  test.ask("06 00 01 03 E8", 10.0);
  for (int i = 0; i < 1000; ++i) test.server.update(10.0);
  test.server.update(0.0);
  test.server.update(0.4);
  EXPECT_EQ(test.server.counts().safe, 0U);
  test.server.update(0.5);
  EXPECT_EQ(test.server.counts().safe, 1U);
  EXPECT_EQ(test.ask("06 00 02 00 64", 0.6), "06 00 02 00 64");
}

TEST(ModbusServer, OverTcpAnUnknownUnitIsAnExceptionAnd255And0AreTheDevice) {
  TestServer test;
  test.unit = 18;
  EXPECT_EQ(test.ask("04 00 00 00 01"), "84 0B");
  for (const int unit : {0, 255, 17}) {
    test.unit = static_cast<std::uint8_t>(unit);
    EXPECT_EQ(test.ask("04 00 00 00 01"), "04 02 00 00") << unit;
  }
}

TEST(ModbusServer, OnASerialLineOtherUnitsAreLeftAloneAndBroadcastsAreNotAnswered) {
  TestServer test;
  test.caller = {1, "serial /dev/x", true};
  test.unit = 18;
  EXPECT_EQ(test.ask("06 00 05 00 01"), "nothing");
  EXPECT_EQ(test.written, Texts());
  EXPECT_EQ(test.server.counts().requests, 0U);
  test.unit = 0;
  EXPECT_EQ(test.ask("06 00 05 00 01"), "nothing");
  EXPECT_EQ(test.written, Texts{"word = 1"});
  EXPECT_EQ(test.ask("06 00 05"), "nothing");
}

TEST(ModbusServer, UnknownFunctionsAndIllegalRequestsHaveTheirExceptions) {
  TestServer test;
  EXPECT_EQ(test.ask("07"), "87 01");
  EXPECT_EQ(test.ask(""), "80 01");
  EXPECT_EQ(test.ask("03 00 00 00 00"), "83 03");
  EXPECT_EQ(test.ask("2B 0E 04 01").substr(0, 5), "2B 0E");
  EXPECT_EQ(test.server.counts().exceptions, 3U);
}

TEST(ModbusServer, TopicsThatDoNotFitARegisterAreClampedOrLeftOut) {
  TestServer test;
  const std::size_t rpm = *test.server.map().find("rpm");
  EXPECT_EQ(test.server.set(rpm, {{Number{1e9}}, ""}), Fit::kClamped);
  EXPECT_EQ(test.get("rpm"), 32767);
  EXPECT_EQ(test.server.set(rpm, {{Number{std::nan("")}}, ""}), Fit::kNotFinite);
  EXPECT_EQ(test.get("rpm"), 32767);
}

}  // namespace
}  // namespace trident::bridges::modbus
