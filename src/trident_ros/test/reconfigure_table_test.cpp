// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/reconfigure_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/yaml_config.h"

namespace trident::ros_utils {
namespace {

using dynamic_reconfigure::Config;

enum class Mode { kSlow, kFast };
constexpr auto enum_names(Mode) {
  return std::array{EnumName{Mode::kSlow, "slow"}, EnumName{Mode::kFast, "fast"}};
}
enum class Order { kZero, kOne };
constexpr auto enum_names(Order) {
  return std::array{EnumName{Order::kZero, "0"}, EnumName{Order::kOne, "1"}};
}

struct TableCritic {
  double weight = 2.5;
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("weight", weight, Range::non_negative(), "of the critic");
  }
};

struct TableParams {
  double speed = 0.5, period = 0.1;
  int samples = 20;
  bool is_on = true;
  std::string frame = "odom";
  Mode mode = Mode::kSlow;
  Order order = Order::kOne;
  std::optional<double> reach;
  std::optional<int> threads;
  std::vector<double> list;
  TableCritic critic;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("speed", speed, Range{-1.0, 1.0}, "forward [m/s]");
    ar.field("period", period, Range::positive(), "[s]");
    ar.field("samples", samples, Range{1, 1000}, "tried");
    ar.field("is_on", is_on, "it works");
    ar.field("frame", frame, "of poses");
    ar.field("mode", mode, "how");
    ar.field("order", order, "which");
    ar.field("reach", reach, Range::positive(), "none: the robot's [m]");
    ar.field("threads", threads, Range{1, 8}, "none: all");
    ar.field("list", list, "of numbers");
    ar.field("critic", critic, "its parameters");
  }
};

ReconfigureTable table_of(const std::string& yaml = "{}") {
  return {config_fields<TableParams>(), parse_yaml(yaml, "test")};
}

template <class Parameters>
auto value_of(const Parameters& parameters, const std::string& name) {
  const auto at = std::find_if(parameters.begin(), parameters.end(),
                               [&](const auto& one) { return one.name == name; });
  EXPECT_NE(at, parameters.end()) << name;
  return at == parameters.end() ? decltype(at->value){} : at->value;
}

Config request_of(const std::string& name, double value) {
  Config config;
  config.doubles.emplace_back();
  config.doubles.back().name = name;
  config.doubles.back().value = value;
  return config;
}

TableParams read_table(const ConfigNode& values) {
  return load_config_node<TableParams>(values, "test");
}

TEST(ReconfigureTable, ShowsWhatIsGivenAndDefaultsOfTheRest) {
  const Config config = table_of("{speed: 0.25, is_on: false, mode: fast, order: 0}").config();
  EXPECT_EQ(value_of(config.doubles, "speed"), 0.25);
  EXPECT_EQ(value_of(config.doubles, "period"), 0.1);
  EXPECT_EQ(value_of(config.ints, "samples"), 20);
  EXPECT_FALSE(value_of(config.bools, "is_on"));
  EXPECT_EQ(value_of(config.strs, "frame"), "odom");
  EXPECT_EQ(value_of(config.strs, "mode"), "fast");
  EXPECT_EQ(value_of(config.ints, "order"), 0);
  EXPECT_EQ(value_of(config.doubles, "critic/weight"), 2.5);
  EXPECT_TRUE(std::isnan(value_of(config.doubles, "reach")));
  EXPECT_EQ(config.groups.size(), 1U);
}

TEST(ReconfigureTable, DescribesTypesRangesAndChoices) {
  const auto description = table_of().description();
  ASSERT_EQ(description.groups.size(), 1U);
  std::vector<std::string> types;
  for (const auto& one : description.groups[0].parameters) types.push_back(one.type);
  // speed, period, samples, is_on, frame, mode, order, reach, critic/weight, restore_defaults
  const std::vector<std::string> expected = {"double", "double", "int",    "bool",   "str",
                                             "str",    "int",    "double", "double", "bool"};
  EXPECT_EQ(types, expected);
  EXPECT_EQ(value_of(description.min.doubles, "speed"), -1.0);
  EXPECT_EQ(value_of(description.max.doubles, "speed"), 1.0);
  EXPECT_EQ(value_of(description.max.doubles, "period"), INFINITY);
  EXPECT_EQ(value_of(description.max.ints, "samples"), 1000);
  EXPECT_EQ(description.groups[0].parameters[0].description, "forward [m/s]");
  EXPECT_NE(description.groups[0].parameters[5].edit_method.find("'value': 'fast'"),
            std::string::npos);
  EXPECT_NE(description.groups[0].parameters[6].edit_method.find("'value': 1,"), std::string::npos);
}

TEST(ReconfigureTable, ARequestChangesWhatItNames) {
  ReconfigureTable table = table_of("{speed: 0.25, list: [1.0, 2.0]}");
  Config request = request_of("speed", -0.75);
  request.bools.emplace_back();
  request.bools.back().name = "is_on";
  request.strs.emplace_back();
  request.strs.back().name = "mode";
  request.strs.back().value = "fast";
  std::vector<std::string> notes;
  const TableParams params = read_table(table.changed(request, &notes));
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(params.speed, -0.75);
  EXPECT_FALSE(params.is_on);
  EXPECT_EQ(params.mode, Mode::kFast);
  EXPECT_EQ(params.list.size(), 2U) << "what no field has is kept";
  EXPECT_EQ(value_of(table.config().doubles, "speed"), 0.25) << "nothing changes before it is set";
  table.set_values(table.changed(request, &notes));
  EXPECT_EQ(value_of(table.config().doubles, "speed"), -0.75);
}

TEST(ReconfigureTable, NamesWithASlashAreWithinMaps) {
  std::vector<std::string> notes;
  const TableParams params =
      read_table(table_of().changed(request_of("critic/weight", 4.0), &notes));
  EXPECT_EQ(params.critic.weight, 4.0);
}

TEST(ReconfigureTable, CutsNumbersToTheirRangeAndSaysSo) {
  std::vector<std::string> notes;
  EXPECT_EQ(read_table(table_of().changed(request_of("speed", 7.0), &notes)).speed, 1.0);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "speed = 7 has become 1, legal: in [-1, 1]");
}

TEST(ReconfigureTable, LeavesWhatNoLegalValueIsNearestToForTheReaderToRefuse) {
  std::vector<std::string> notes;
  const ConfigNode values = table_of().changed(request_of("period", -1.0), &notes);
  EXPECT_TRUE(notes.empty());
  EXPECT_THROW(read_table(values), ConfigError);
}

TEST(ReconfigureTable, NamesTheNearestParameterOfAnUnknownOne) {
  std::vector<std::string> notes;
  table_of().changed(request_of("sped", 1.0), &notes);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "sped is not known; did you mean speed?");
}

TEST(ReconfigureTable, NanTakesAnOptionalValueAway) {
  std::vector<std::string> notes;
  const ReconfigureTable table = table_of("{reach: 2.0, speed: 0.5}");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(read_table(table.changed(request_of("reach", nan), &notes)).reach);
  EXPECT_THROW(read_table(table.changed(request_of("speed", nan), &notes)), ConfigError);
}

TEST(ReconfigureTable, RestoresTheFirstValues) {
  ReconfigureTable table = table_of("{speed: 0.25}");
  std::vector<std::string> notes;
  table.set_values(table.changed(request_of("speed", 1.0), &notes));
  Config request;
  request.bools.emplace_back();
  request.bools.back().name = "restore_defaults";
  request.bools.back().value = static_cast<std::uint8_t>(true);
  table.set_values(table.changed(request, &notes));
  EXPECT_EQ(value_of(table.config().doubles, "speed"), 0.25);
  EXPECT_FALSE(value_of(table.config().bools, "restore_defaults"));
}

}  // namespace
}  // namespace trident::ros_utils
