// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/client.h"

#include <gtest/gtest.h>

#include <random>

#include "bytes_of_text.h"
#include "trident_bridges/modbus/server.h"

namespace trident::bridges::modbus {
namespace {

const char* const kClientMap = R"(
unit: 3
response_timeout: 0.5
retries: 1
registers:
  - {name: rpm, table: input, address: 0, type: int16}
  - {name: volt, table: input, address: 1, type: float32}
  - {name: far, table: input, address: 9, publish: poll}
  - {name: leak, table: discrete, address: 0}
  - {name: left, table: holding, address: 0, type: int16, access: write, min: -100, max: 100,
     safe: 0, timeout: 0.6}
  - {name: right, table: holding, address: 1, type: int16, access: write}
  - {name: setpoint, table: holding, address: 2, type: float32, access: read_write}
  - {name: lamp, table: coil, address: 0, access: write}
  - {name: pump, table: coil, address: 1, access: write}
)";

using Texts = std::vector<std::string>;

/// A client, and what it has reported.
struct TestClient {
  explicit TestClient(const std::string& map = kClientMap, bool may_pipeline = false)
      : client(parse_register_map(map, "m.yaml"), may_pipeline,
               {[this](std::size_t entry, const Value& value) {
                  read.push_back(client.map().entries[entry].name + " = " + value_to_text(value));
                },
                [this](const std::string& kind, const std::string& text) {
                  failed.push_back(kind + ": " + text);
                },
                [this](bool answers) { answering.push_back(answers); }}) {}

  Texts read, failed;
  std::vector<bool> answering;
  Client client;

  void set(const std::string& name, double value, double time_s = 0.0) {
    client.set(*client.map().find(name), {{Number{value}}, ""}, time_s);
  }
  /// The next request as text; "nothing".
  std::string next(double now_s = 0.0) {
    const auto outgoing = client.next(now_s);
    if (!outgoing) return "nothing";
    number = outgoing->transaction;
    return hex_of(outgoing->pdu.bytes());
  }
  void answer(const std::string& hex) {
    const auto bytes = bytes_of(hex);
    client.receive(number, 3, bytes);
  }
  std::uint16_t number = 0;  ///< of the last request
};

TEST(ReadBlocks, NeighborsAreReadByOneRequest) {
  const auto blocks = read_blocks(parse_register_map(kClientMap, "m.yaml"));
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[1].function, Function::kReadInputRegisters);
  EXPECT_EQ(blocks[1].address, 0);
  EXPECT_EQ(blocks[1].count, 3);
  EXPECT_EQ(blocks[3].function, Function::kReadHoldingRegisters);
  EXPECT_EQ(blocks[3].address, 2) << "commands are not polled";
}

TEST(ReadBlocks, GapsAreReadUpToTheirLimit) {
  const std::string gap(kClientMap);
  EXPECT_EQ(read_blocks(parse_register_map("max_gap: 5\n" + gap, "m.yaml")).size(), 4U);
  EXPECT_EQ(read_blocks(parse_register_map("max_gap: 6\n" + gap, "m.yaml")).size(), 3U);
}

TEST(ReadBlocks, ABlockHasAtMost125RegistersOr2000Bits) {
  const auto map = parse_register_map(
      "registers:\n"
      "  - {name: a, table: input, address: 0, count: 100}\n"
      "  - {name: b, table: input, address: 100, count: 25}\n"
      "  - {name: c, table: input, address: 125, count: 2}\n"
      "  - {name: d, table: discrete, address: 0, count: 1999}\n"
      "  - {name: e, table: discrete, address: 1999, count: 2}\n",
      "m.yaml");
  const auto blocks = read_blocks(map);
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[0].count, 1999);
  EXPECT_EQ(blocks[2].count, 125);
}

TEST(ModbusClient, APollReadsAllBlocksOneAfterTheOther) {
  TestClient test;
  EXPECT_EQ(test.next(), "nothing");
  test.client.poll();
  EXPECT_EQ(test.next(), "02 00 00 00 01");
  EXPECT_EQ(test.next(), "nothing") << "one request at a time";
  test.answer("02 01 01");
  EXPECT_EQ(test.next(), "04 00 00 00 03");
  test.answer("04 06 FF FE 3F C0 00 00");
  EXPECT_EQ(test.next(), "04 00 09 00 01");
  test.answer("04 02 00 07");
  EXPECT_EQ(test.next(), "03 00 02 00 02");
  test.answer("03 04 40 00 00 00");
  EXPECT_EQ(test.next(), "nothing");
  EXPECT_EQ(test.read, (Texts{"leak = 1", "rpm = -2", "volt = 1.5", "far = 7", "setpoint = 2"}));
  EXPECT_EQ(test.answering, std::vector<bool>{true});
}

TEST(ModbusClient, OnlyWhatHasChangedIsReportedUnlessItIsAskedFor) {
  TestClient test;
  for (const char* const values : {"00 01 3F C0 00 00", "00 01 3F C0 00 00", "00 02 3F C0 00 00"}) {
    test.client.poll();
    while (true) {
      const std::string request = test.next();
      if (request == "nothing") break;
      if (request == "04 00 00 00 03") {
        test.answer(std::string("04 06 ") + values);
      } else if (request == "04 00 09 00 01") {
        test.answer("04 02 00 07");
      } else {
        test.answer(request.substr(0, 2) == "02" ? "02 01 00" : "03 04 00 00 00 00");
      }
    }
  }
  EXPECT_EQ(test.read, (Texts{"leak = 0", "rpm = 1", "volt = 1.5", "far = 7", "setpoint = 0",
                              "far = 7", "rpm = 2", "far = 7"}));
}

TEST(ModbusClient, NeighborsThatHaveChangedAreWrittenByOneRequest) {
  TestClient test;
  test.set("right", 2.0);
  test.set("left", 1.0);
  test.set("lamp", 1.0);
  EXPECT_EQ(test.next(), "05 00 00 FF 00");
  test.answer("05 00 00 FF 00");
  EXPECT_EQ(test.next(), "10 00 00 00 02 04 00 01 00 02");
  test.answer("10 00 00 00 02");
  EXPECT_EQ(test.next(), "nothing");
  EXPECT_EQ(test.client.counts().writes, 3U);
}

TEST(ModbusClient, WhatHasNotChangedIsNotWrittenUntilTheDeviceWouldMissIt) {
  TestClient test;
  test.set("left", 5.0, 10.0);
  EXPECT_EQ(test.next(), "06 00 00 00 05");
  test.answer("06 00 00 00 05");
  test.set("left", 5.0, 10.1);
  EXPECT_EQ(test.next(), "nothing");
  test.set("left", 5.0, 10.25);
  EXPECT_EQ(test.next(), "06 00 00 00 05");
  test.answer("06 00 00 00 05");
  test.set("right", 5.0, 10.0);
  test.next();
  test.answer("06 00 01 00 05");
  test.set("right", 5.0, 1000.0);
  EXPECT_EQ(test.next(), "nothing") << "it has no timeout";
}

TEST(ModbusClient, TheNewestValueIsWrittenWhenOneIsInFlight) {
  TestClient test;
  test.set("right", 1.0);
  EXPECT_EQ(test.next(), "06 00 01 00 01");
  test.set("right", 2.0);
  test.set("right", 3.0);
  EXPECT_EQ(test.next(), "nothing");
  test.answer("06 00 01 00 01");
  EXPECT_EQ(test.next(), "06 00 01 00 03");
}

TEST(ModbusClient, WritesComeBeforeReads) {
  TestClient test;
  test.client.poll();
  test.set("right", 1.0);
  EXPECT_EQ(test.next(), "06 00 01 00 01");
}

TEST(ModbusClient, AValueOutOfRangeIsNotSent) {
  TestClient test;
  test.set("left", 101.0);
  test.set("right", 1e6);
  test.set("setpoint", std::nan(""));
  EXPECT_EQ(test.next(), "nothing");
  ASSERT_EQ(test.failed.size(), 3U);
  EXPECT_EQ(
      test.failed[0],
      "value refused: 'left' (holding 0) is not set to 101, legal: [-100, 100] of type int16");
}

TEST(ModbusClient, ARefusedBatchIsWrittenValueByValue) {
  TestClient test;
  test.set("left", 1.0);
  test.set("right", 2.0);
  EXPECT_EQ(test.next(), "10 00 00 00 02 04 00 01 00 02");
  test.answer("90 02");
  EXPECT_EQ(test.next(), "06 00 00 00 01");
  test.answer("86 02");
  EXPECT_EQ(test.next(), "06 00 01 00 02");
  test.answer("06 00 01 00 02");
  EXPECT_EQ(test.failed, Texts{"write refused: 'left' (holding 0): illegal address (exception 2)"});
  EXPECT_EQ(test.next(), "nothing");
  test.set("left", 1.0);
  EXPECT_EQ(test.next(), "06 00 00 00 01") << "what was refused is tried when it is set again";
}

TEST(ModbusClient, ARequestWithoutAnswerIsRepeatedAndThenGivenUp) {
  TestClient test;
  test.client.poll();
  EXPECT_EQ(test.next(1.0), "02 00 00 00 01");
  const std::uint16_t first = test.number;
  EXPECT_EQ(test.client.deadline_s(), 1.5);
  test.client.update(1.49);
  EXPECT_EQ(test.next(1.49), "nothing");
  test.client.update(1.5);
  EXPECT_EQ(test.next(1.5), "02 00 00 00 01");
  EXPECT_NE(test.number, first);
  test.client.update(2.0);
  EXPECT_EQ(test.failed, Texts{"no answer: 'leak' (discrete 0) was not read in 2 attempts of 0.5 s "
                               "each"});
  EXPECT_EQ(test.next(2.0), "04 00 00 00 03");
  EXPECT_EQ(test.client.counts().timeouts, 2U);
}

TEST(ModbusClient, AnAnswerToAnotherTransactionIsLeftOut) {
  TestClient test;
  test.client.poll();
  test.next();
  const auto bytes = bytes_of("02 01 01");
  test.client.receive(static_cast<std::uint16_t>(test.number + 1), 3, bytes);
  test.client.receive(test.number, 4, bytes);
  EXPECT_EQ(test.client.counts().late, 2U);
  test.client.receive(std::nullopt, 3, bytes);
  EXPECT_EQ(test.read, Texts{"leak = 1"});
  test.client.receive(test.number, 3, bytes);
  EXPECT_EQ(test.client.counts().late, 3U);
}

TEST(ModbusClient, AMalformedAnswerCountsAsLost) {
  TestClient test;
  test.client.poll();
  EXPECT_EQ(test.next(), "02 00 00 00 01");
  test.answer("02 02 01 01");
  EXPECT_EQ(test.client.counts().malformed, 1U);
  EXPECT_EQ(test.next(), "02 00 00 00 01");
  test.answer("02 01 01");
  EXPECT_EQ(test.read, Texts{"leak = 1"});
}

TEST(ModbusClient, ALostCommandIsNotSentLaterButALostStateIs) {
  TestClient test;
  test.set("left", 50.0);
  test.set("lamp", 1.0);
  EXPECT_EQ(test.next(), "05 00 00 FF 00");
  test.client.disconnect();
  EXPECT_EQ(test.next(), "05 00 00 FF 00") << "the lamp is still wanted";
  test.answer("05 00 00 FF 00");
  EXPECT_EQ(test.next(), "nothing") << "left has a timeout: its writer says it again";
  test.set("left", 50.0);
  EXPECT_EQ(test.next(), "06 00 00 00 32");
}

TEST(ModbusClient, OverTcpSeveralRequestsAreInFlight) {
  TestClient test(std::string("pipeline: 3\n") + kClientMap, true);
  test.client.poll();
  EXPECT_EQ(test.next(), "02 00 00 00 01");
  const std::uint16_t first = test.number;
  EXPECT_EQ(test.next(), "04 00 00 00 03");
  EXPECT_EQ(test.next(), "04 00 09 00 01");
  EXPECT_EQ(test.next(), "nothing");
  const auto bytes = bytes_of("02 01 00");
  test.client.receive(first, 3, bytes);
  EXPECT_EQ(test.next(), "03 00 02 00 02");
}

TEST(ModbusClient, BlocksThatWereNotReadInTimeAreCounted) {
  TestClient test;
  test.client.poll();
  test.next();
  test.client.poll();
  EXPECT_EQ(test.client.counts().skipped, 3U) << "the first is in flight, and will be read again";
}

/// A client and a server with a link that loses a part of what is sent.
class Pair {
 public:
  explicit Pair(double loss) : loss_(loss) {}

  void exchange(double now_s) {
    client_.client.update(now_s);
    while (auto outgoing = client_.client.next(now_s)) {
      if (is_lost()) continue;
      const auto response =
          server_.handle({1, "test"}, outgoing->unit, outgoing->pdu.bytes(), now_s);
      if (response && !is_lost()) {
        client_.client.receive(outgoing->transaction, outgoing->unit, response->bytes());
      }
    }
  }
  bool is_lost() { return std::uniform_real_distribution<>(0.0, 1.0)(random_) < loss_; }
  double server_value(const std::string& name) {
    return as_double(server_.value(*server_.map().find(name)).numbers.at(0));
  }

  TestClient client_;
  Server server_{parse_register_map(kClientMap, "m.yaml"), {}};

 private:
  double loss_;
  std::mt19937_64 random_{5};
};

TEST(ModbusClient, OverALossyLinkTheDeviceHasTheLastValuesInTheEnd) {
  Pair pair(0.3);
  double now_s = 0.0;
  for (int i = 0; i <= 1000; ++i, now_s += 0.05) {
    if (i % 10 == 0) {
      pair.client_.set("right", i);
      pair.client_.set("setpoint", 0.5 * i);
      pair.server_.set(0, {{Number{double(i)}}, ""});
      pair.client_.client.poll();
    }
    pair.exchange(now_s);
  }
  for (int i = 0; i < 200; ++i, now_s += 0.05) {
    if (i % 10 == 0) pair.client_.client.poll();
    pair.exchange(now_s);
  }
  EXPECT_EQ(pair.server_value("right"), 1000.0);
  EXPECT_EQ(pair.server_value("setpoint"), 500.0);
  EXPECT_NE(std::find(pair.client_.read.begin(), pair.client_.read.end(), "rpm = 1000"),
            pair.client_.read.end());
  EXPECT_GT(pair.client_.client.counts().timeouts, 100U);
}

}  // namespace
}  // namespace trident::bridges::modbus
