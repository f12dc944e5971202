// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "mavlink/lossy_link.h"
#include "mavlink/packets.h"
#include "trident_base/error.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/parameter_client.h"
#include "trident_bridges/mavlink/parameter_server.h"

namespace trident::bridges::mavlink {
namespace {

using testing::kGround;
using testing::kVehicle;

std::vector<Parameter> sixty() {
  std::vector<Parameter> parameters;
  for (int i = 0; i < 58; ++i) {
    parameters.push_back({"REAL_" + std::to_string(i), ParameterType::kReal32, 0.5 * i, 0.0, 50.0});
  }
  parameters.push_back({"COM_LOW_BAT_ACT", ParameterType::kInt32, -3, -10, 16'777'217});
  parameters.push_back({"SIXTEEN_LETTERS_", ParameterType::kUint8, 200, 0, 255});
  return parameters;
}

struct ParameterPair {
  ParameterPair(double loss, ParameterEncoding encoding)
      : link(loss, 0.01, "parameters"),
        server(kVehicle, link.from(0), encoding, sixty(),
               {[this](const Parameter& parameter) { changed.push_back(parameter.name); },
                [this](const std::string& reason) { reasons.push_back(reason); }}),
        client(kGround, kVehicle, link.from(1), encoding) {}

  ParameterClient::Done done() {
    succeeded.reset();
    return [this](bool success, const std::string& text) {
      succeeded = success;
      reason = text;
    };
  }
  void run(double limit_s = 60.0) {
    link.run(
        limit_s, [this] { return succeeded.has_value(); },
        [this](int end, const Message& message) {
          end == 0 ? server.handle(message, link.now()) : client.handle(message, link.now());
        },
        [this] {
          server.update(link.now());
          client.update(link.now());
        });
  }

  testing::LossyLink link;
  std::vector<std::string> changed, reasons;
  std::optional<bool> succeeded;
  std::string reason;
  ParameterServer server;
  ParameterClient client;
};

class Parameters : public ::testing::TestWithParam<ParameterEncoding> {};
INSTANTIATE_TEST_SUITE_P(Encodings, Parameters,
                         ::testing::Values(ParameterEncoding::kBytewise, ParameterEncoding::kCast));

TEST_P(Parameters, AllAreReadUnder30PercentLoss) {
  ParameterPair pair(0.3, GetParam());
  pair.client.fetch(pair.link.now(), pair.done());
  pair.run();
  ASSERT_TRUE(pair.succeeded.value_or(false)) << pair.reason;
  ASSERT_EQ(pair.client.parameters().size(), 60U);
  for (const Parameter& parameter : pair.server.parameters()) {
    EXPECT_EQ(pair.client.parameters().at(parameter.name).value, parameter.value) << parameter.name;
  }
}

TEST_P(Parameters, AValueIsSetUnder30PercentLoss) {
  ParameterPair pair(0.3, GetParam());
  pair.client.fetch(pair.link.now(), pair.done());
  pair.run();
  pair.client.set("COM_LOW_BAT_ACT", 7, pair.link.now(), pair.done());
  pair.run();
  EXPECT_TRUE(pair.succeeded.value_or(false)) << pair.reason;
  EXPECT_EQ(pair.server.find("COM_LOW_BAT_ACT")->value, 7.0);
  EXPECT_FALSE(pair.changed.empty());
}

TEST_P(Parameters, AValueOutOfRangeStaysAndBothEndsHearWhy) {
  ParameterPair pair(0.0, GetParam());
  pair.client.set("REAL_3", 51.0, pair.link.now(), pair.done());
  pair.run();
  EXPECT_FALSE(pair.succeeded.value_or(true));
  EXPECT_EQ(pair.reason, "parameter REAL_3 stays at 1.500000");
  EXPECT_EQ(pair.reasons[0], "parameter REAL_3 = 51, legal: 0 to 50");
  EXPECT_TRUE(pair.changed.empty());
  pair.client.set("REAL_3", std::numeric_limits<double>::quiet_NaN(), pair.link.now(), pair.done());
  pair.run();
  EXPECT_FALSE(pair.succeeded.value_or(true));
  EXPECT_EQ(pair.server.find("REAL_3")->value, 1.5);
}

TEST_P(Parameters, ValuesAreSetOneAfterTheOtherAndEachCallerHearsOfHis) {
  ParameterPair pair(0.3, GetParam());
  std::vector<std::string> ended;
  const auto note = [&](const std::string& name) {
    return [&ended, name](bool success, const std::string&) {
      ended.push_back(name + (success ? " set" : " not set"));
    };
  };
  pair.client.set("REAL_1", 1.0, pair.link.now(), [&](bool success, const std::string&) {
    note("REAL_1")(success, "");
    pair.client.set("REAL_2", 2.0, pair.link.now(), pair.done());
  });
  pair.client.set("REAL_3", 3.0, pair.link.now(), note("REAL_3"));
  pair.run();
  EXPECT_TRUE(pair.succeeded.value_or(false)) << pair.reason;
  EXPECT_EQ(ended, (std::vector<std::string>{"REAL_1 set", "REAL_3 set"}));
  EXPECT_EQ(pair.server.find("REAL_2")->value, 2.0);
}

TEST_P(Parameters, WhatIsCancelledEnds) {
  ParameterPair pair(1.0, GetParam());
  std::vector<std::string> reasons;
  const auto note = [&](bool success, const std::string& reason) {
    EXPECT_FALSE(success);
    reasons.push_back(reason);
  };
  pair.client.fetch(pair.link.now(), note);
  pair.client.set("REAL_1", 1.0, pair.link.now(), note);
  pair.client.set("REAL_2", 2.0, pair.link.now(), note);
  pair.client.cancel("it is gone");
  EXPECT_EQ(reasons, std::vector<std::string>(3, "it is gone"));
  EXPECT_FALSE(pair.client.is_busy());
}

TEST(ParameterEncoding, WholeNumbersOfPx4KeepAllTheirBits) {
  const double value = 16'777'217;  // is no float
  const auto there_and_back = [&](ParameterEncoding encoding) {
    return decode_parameter(encode_parameter(value, ParameterType::kInt32, encoding),
                            ParameterType::kInt32, encoding);
  };
  EXPECT_EQ(there_and_back(ParameterEncoding::kBytewise), value);
  EXPECT_NE(there_and_back(ParameterEncoding::kCast), value);
  EXPECT_TRUE(std::isnan(
      decode_parameter(1.0F, static_cast<ParameterType>(77), ParameterEncoding::kBytewise)));
}

TEST(ParameterServer, NamesThatDoNotFitAreErrors) {
  const auto make = [](std::vector<std::string> names) {
    std::vector<Parameter> parameters;
    for (const std::string& name : names) parameters.push_back({name, {}, 0, 0, 1});
    ParameterServer server(kVehicle, [](const Message&) {}, ParameterEncoding::kCast, parameters,
                           {});
  };
  EXPECT_THROW(make({"A", "A"}), Error);
  EXPECT_THROW(make({""}), Error);
  EXPECT_THROW(make({"SEVENTEEN_LETTERS"}), Error);
  EXPECT_NO_THROW(make({"SIXTEEN_LETTERS_", "B"}));
}

TEST(ParameterServer, UnknownNamesAndIndicesAreNotAnswered) {
  std::vector<Message> sent;
  std::vector<std::string> reasons;
  ParameterServer server(kVehicle, [&](const Message& m) { sent.push_back(m); },
                         ParameterEncoding::kCast, sixty(),
                         {{}, [&](const std::string& reason) { reasons.push_back(reason); }});
  mavlink_param_request_read_t read{};
  read.target_system = 1;
  read.param_index = 60;
  EXPECT_TRUE(server.handle(pack(read, kGround), {}));
  read.param_index = -1;
  std::memcpy(read.param_id, "_HASH_CHECK", 11);
  EXPECT_TRUE(server.handle(pack(read, kGround), {}));
  EXPECT_TRUE(sent.empty());
  mavlink_param_set_t set{};
  set.target_system = 1;
  std::memcpy(set.param_id, "NO_SUCH", 7);
  server.handle(pack(set, kGround), {});
  EXPECT_EQ(reasons[0], "parameter 'NO_SUCH' is not known");
}

}  // namespace
}  // namespace trident::bridges::mavlink
