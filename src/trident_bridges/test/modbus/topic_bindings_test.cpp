// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/topic_bindings.h"

#include <gtest/gtest.h>

#include <map>

#include "trident_base/error.h"

namespace trident::bridges::modbus {
namespace {

using Texts = std::vector<std::string>;

Texts topics_of(const std::vector<TopicBinding>& bindings) {
  Texts topics;
  for (const TopicBinding& binding : bindings) topics.push_back(binding.topic);
  return topics;
}

RegisterMap map_with(const std::string& registers) {
  return parse_register_map("registers:\n" + registers, "m.yaml");
}

const MessageDefinition& definition_of(const std::string& type) {
  static const std::map<std::string, MessageDefinition> known{
      {"std_msgs/Float64", {"std_msgs/Float64", "float64 data\n"}},
      {"std_msgs/Bool", {"std_msgs/Bool", "bool data\n"}},
      {"std_msgs/UInt16", {"std_msgs/UInt16", "uint16 data\n"}},
      {"std_msgs/String", {"std_msgs/String", "string data\n"}},
      {"t/Row", {"t/Row", "float32[3] row\nfloat32[] rest\n"}}};
  const auto found = known.find(type);
  if (found == known.end()) throw Error("unknown message type '" + type + "'");
  return found->second;
}

Texts topic_errors_of(const std::string& registers) {
  Texts texts;
  for (const ConfigError& error : errors_of_topics(map_with(registers), definition_of)) {
    texts.emplace_back(error.what());
  }
  return texts;
}

TEST(TopicBindings, ADeviceTakesWhatIsReadAndPublishesWhatIsWritten) {
  const RegisterMap map = map_with(
      "  - {name: rpm, table: input, address: 0, topic: rpm}\n"
      "  - {name: cmd, table: holding, address: 0, access: write, topic: cmd}\n"
      "  - {name: pump, table: coil, address: 0, access: read_write, topic: pump}\n"
      "  - {name: silent, table: input, address: 1}\n");
  const TopicBindings server = topic_bindings(map, Role::kServer);
  EXPECT_EQ(topics_of(server.inputs), (Texts{"rpm", "pump/state"}));
  EXPECT_EQ(topics_of(server.outputs), (Texts{"cmd", "pump"}));
  const TopicBindings client = topic_bindings(map, Role::kClient);
  EXPECT_EQ(topics_of(client.inputs), (Texts{"cmd", "pump"}));
  EXPECT_EQ(topics_of(client.outputs), (Texts{"rpm", "pump/state"}));
}

TEST(TopicBindings, NamedBitsAreTopicsOfTheirOwn) {
  const auto bits = topic_bindings(
      map_with("  - {name: a, table: input, address: 0, type: bits(leak - fire), topic: alarm}\n"),
      Role::kServer);
  EXPECT_EQ(topics_of(bits.inputs), (Texts{"alarm/leak", "alarm/fire"}));
  EXPECT_EQ(bits.inputs[1].bit, 2);
  const auto word = topic_bindings(
      map_with("  - {name: a, table: input, address: 0, type: bits(leak - fire), topic: alarm,"
               " message: std_msgs/UInt16}\n"),
      Role::kServer);
  EXPECT_EQ(topics_of(word.inputs), Texts{"alarm"});
  EXPECT_EQ(word.inputs[0].bit, TopicBinding::kWhole);
}

TEST(TopicBindings, WhatDoesNotFitIsNamedWithItsLine) {
  EXPECT_EQ(topic_errors_of("  - {name: a, table: input, address: 0, topic: x, message: t/None}\n"),
            Texts{"m.yaml:2: registers.a.message: unknown message type 't/None'"});
  EXPECT_EQ(topic_errors_of("  - {name: a, table: input, address: 0, topic: x, field: date}\n"),
            Texts{"m.yaml:2: registers.a.field: std_msgs/UInt16 has no field 'date'; did you mean "
                  "'data'? Known: data"});
  EXPECT_EQ(topic_errors_of(
                "  - {name: a, table: input, address: 0, topic: x, message: std_msgs/String}\n"),
            Texts{"m.yaml:2: registers.a.field: field 'data' of std_msgs/String is a string, the "
                  "value is a uint16"});
  EXPECT_EQ(
      topic_errors_of("  - {name: a, table: input, address: 0, count: 4, topic: x, message: t/Row,"
                      " field: row}\n"),
      Texts{"m.yaml:2: registers.a.field: field 'row' of t/Row has 3 elements, count is 4"});
  EXPECT_EQ(
      topic_errors_of("  - {name: a, table: input, address: 0, count: 4, topic: x, message: t/Row,"
                      " field: 'row[0]'}\n"),
      Texts{"m.yaml:2: registers.a.field: field 'row[0]' of t/Row is no array, count is 4"});
  EXPECT_EQ(topic_errors_of("  - {name: a, table: input, address: 0, topic: x}\n"
                            "  - {name: b, table: input, address: 1, scale: 2.0, topic: x}\n"),
            Texts{"m.yaml:3: registers.b.message: std_msgs/Float64, but line 2 has std_msgs/UInt16 "
                  "on topic x"});
  EXPECT_EQ(
      topic_errors_of("  - {name: a, table: input, address: 0, count: 4, topic: x, message: t/Row,"
                      " field: rest}\n"),
      Texts{});
}

}  // namespace
}  // namespace trident::bridges::modbus
