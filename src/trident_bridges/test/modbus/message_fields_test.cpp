// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/message_fields.h"

#include <gtest/gtest.h>

#include <random>

#include "bytes_of_text.h"
#include "trident_base/error.h"

namespace trident::bridges::modbus {
namespace {

const std::string kLine(80, '=');

/// A type with everything in front of a field that can be in front of one.
MessageDefinition definition() {
  return {"test/All",
          "# a comment\n"
          "Header header\n"
          "uint8 KIND=3   # a constant\n"
          "string GREETING=hello # no comment\n"
          "bool on\n"
          "int8[3] small\n"
          "string name\n"
          "Part[] parts\n"
          "Part part\n"
          "float64[] values\n"
          "time at\n"
          "duration after\n"
          "Nothing[] nothing\n"
          "int64 big\n" +
              kLine + "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n" + kLine +
              "\nMSG: test/Part\nfloat32 x\nstring label\nint16[2] pair\n" + kLine +
              "\nMSG: test/Nothing\nuint8 ANY=1\n"};
}

Value number(const Number& value) { return {{value}, ""}; }

/// A message in which these fields have these values.
std::vector<std::uint8_t> message(const std::vector<std::string>& paths,
                                  const std::vector<Value>& values) {
  std::vector<std::uint8_t> bytes;
  MessageWriter(definition(), paths).write(values, 5, 6, bytes);
  return bytes;
}

Value read(const std::string& path, Bytes bytes) {
  Value value;
  EXPECT_TRUE(FieldReader(definition(), path).read(bytes, value)) << path;
  return value;
}

TEST(MessageFields, AMessageWithoutValuesIsZerosAndAStamp) {
  const auto bytes = message({}, {});
  // header 4 + 8 + 4, on 1, small 3, name 4, parts 4, part 4 + 4 + 4, values 4, at 8, after 8,
  // nothing 4, big 8
  EXPECT_EQ(bytes.size(), 16U + 1 + 3 + 4 + 4 + 12 + 4 + 8 + 8 + 8 + 4);
  EXPECT_DOUBLE_EQ(as_double(read("header.stamp", bytes).numbers.at(0)), 5.000000006);
  EXPECT_EQ(read("header.seq", bytes), number(std::uint64_t{0}));
  EXPECT_EQ(read("name", bytes).text, "");
  EXPECT_EQ(read("values", bytes).numbers.size(), 0U);
}

TEST(MessageFields, WhatIsWrittenIsReadWhereverItStands) {
  const std::vector<std::string> paths{
      "on",     "small", "name",  "parts[1].x", "parts[1].label", "part.pair[1]",
      "values", "at",    "after", "big",        "header.frame_id"};
  const std::vector<Value> values{
      number(std::uint64_t{1}),
      {{Number{std::int64_t{-1}}, Number{std::int64_t{2}}, Number{std::int64_t{-3}}}, ""},
      {{}, "otter"},
      number(1.5),
      {{}, "port"},
      number(std::int64_t{-77}),
      {{Number{0.25}, Number{-0.5}}, ""},
      number(12.25),
      number(-3.5),
      number(std::int64_t{-1234567890123}),
      {{}, "base_link"}};
  const auto bytes = message(paths, values);
  for (std::size_t i = 0; i < paths.size(); ++i)
    EXPECT_EQ(read(paths[i], bytes), values[i]) << paths[i];
  EXPECT_EQ(read("parts[0].x", bytes), number(0.0)) << "elements before the named one are zero";
  EXPECT_EQ(read("part.pair", bytes).numbers.size(), 2U);
}

TEST(MessageFields, NumbersThatAFieldDoesNotHaveAreTheNearestOnes) {
  const auto bytes = message({"small[0]", "small[1]", "at", "after", "on"},
                             {number(1e9), number(-1e9), number(-5.0), number(1e12), number(0.5)});
  EXPECT_EQ(as_double(read("small[0]", bytes).numbers.at(0)), 127.0);
  EXPECT_EQ(as_double(read("small[1]", bytes).numbers.at(0)), -128.0);
  EXPECT_EQ(as_double(read("at", bytes).numbers.at(0)), 0.0);
  EXPECT_EQ(as_double(read("after", bytes).numbers.at(0)), 2147483647.0);
  EXPECT_EQ(as_double(read("on", bytes).numbers.at(0)), 1.0);
}

TEST(MessageFields, AnElementThatAMessageDoesNotHaveIsNotRead) {
  const auto bytes = message({"values"}, {{{Number{1.0}, Number{2.0}}, ""}});
  Value value;
  EXPECT_TRUE(FieldReader(definition(), "values[1]").read(bytes, value));
  EXPECT_FALSE(FieldReader(definition(), "values[2]").read(bytes, value));
  EXPECT_FALSE(FieldReader(definition(), "parts[0].x").read(bytes, value));
}

TEST(MessageFields, APathThatLeadsNowhereIsRefusedWithTheNearestName) {
  const char* const cases[][2] = {
      {"names", "test/All has no field 'names'; did you mean 'name'?"},
      {"part.labels", "test/Part has no field 'labels'; did you mean 'label'?"},
      {"part", "field 'part' of test/All is a test/Part, legal: a number or a text in it"},
      {"on.x", "field 'on' of test/All is a bool, which has no fields"},
      {"on[0]", "field 'on' is no array"},
      {"small[3]", "element 3 of 'small', legal: 0 to 2"},
      {"parts.x", "field 'parts' of test/All is an array, of which one element must be named"},
      {"", "legal: names with dots between them"},
      {"a..b", "legal: names with dots between them"},
      {"small[x]", "legal: name[0] to name[4096]"},
      {"small[1", "legal: name[0] to name[4096]"},
  };
  for (const auto& [path, expected] : cases) {
    try {
      FieldReader(definition(), path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
    EXPECT_THROW(MessageWriter(definition(), {path}), Error) << path;
  }
}

TEST(MessageFields, AFieldHasOneValue) {
  EXPECT_THROW(MessageWriter(definition(), {"on", "on"}), Error);
  EXPECT_THROW(MessageWriter(definition(), {"small", "small[1]"}), Error);
  EXPECT_NO_THROW(MessageWriter(definition(), {"small[0]", "small[1]"}));
}

TEST(MessageFields, ADamagedMessageIsNotReadBeyondItsEnd) {
  std::mt19937_64 random(4);
  const auto good = message({"name", "parts[2].label", "values"},
                            {{{}, "abc"}, {{}, "defg"}, {{Number{1.0}, Number{2.0}}, ""}});
  for (int i = 0; i < 20000; ++i) {
    auto bytes = good;
    for (std::size_t k = 1 + random() % 3; k > 0; --k) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    bytes.resize(random() % 2 == 0 ? bytes.size() : random() % bytes.size());
    Value value;
    FieldReader(definition(), "big").read(bytes, value);
    ASSERT_LE(value.numbers.size(), 1U);
    FieldReader(definition(), "values").read(bytes, value);
    ASSERT_LE(value.numbers.size(), bytes.size());
  }
}

TEST(MessageDefinitions, WhatIsNoDefinitionIsRefused) {
  const std::string recursive = "A a\n" + kLine + "\nMSG: t/A\nB b\n" + kLine + "\nMSG: t/B\nA a\n";
  for (const std::string& text :
       {std::string("float64"), std::string("floot64 x"), std::string("float64[x] y"),
        std::string("float64[99999999] y"), std::string("float64 a b"), kLine + "\nfloat64 x",
        recursive, std::string("float64] x")}) {
    EXPECT_THROW(MessageDefinition("t/T", text), Error) << text;
  }
}

TEST(MessageDefinitions, TheSumIsThatOfGenmsg) {
  const std::string header = "uint32 seq\ntime stamp\nstring frame_id\n";
  EXPECT_EQ(MessageDefinition("std_msgs/Float64", "float64 data\n").md5sum(),
            "fdb28210bfa9d7c91146260178d9a584");
  EXPECT_EQ(MessageDefinition("std_msgs/Header", header).md5sum(),
            "2176decaecbce78abc3b96ef049fabed");
  EXPECT_EQ(MessageDefinition("std_msgs/Bool", "bool data").md5sum(),
            "8b94c1b53db61fb6aed406028ad6332a");
  EXPECT_TRUE(definition().has_header());
}

TEST(MessageDefinitions, TheTypesThatATextUsesAreNamed) {
  EXPECT_EQ(used_types("t/T", "Header header\nfloat64 x\nuint8 A=1\nPart[] p\nu/Q q\nPart r\n"),
            (std::vector<std::string>{"std_msgs/Header", "t/Part", "u/Q"}));
}

}  // namespace
}  // namespace trident::bridges::modbus
