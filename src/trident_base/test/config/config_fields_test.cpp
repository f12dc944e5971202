// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/config_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "config_example.h"

namespace trident {
namespace {

using Kind = ConfigField::Kind;

ConfigField field_called(const std::string& name) {
  const std::vector<ConfigField> fields = config_fields<VehicleConfig>();
  const auto at = std::find_if(fields.begin(), fields.end(),
                               [&](const ConfigField& field) { return field.name == name; });
  EXPECT_NE(at, fields.end()) << name;
  return at == fields.end() ? ConfigField{} : *at;
}

TEST(ConfigFields, ListsWhatHasASingleValueInTheOrderOfVisit) {
  std::vector<std::string> names;
  for (const ConfigField& field : config_fields<VehicleConfig>()) names.push_back(field.name);
  const std::vector<std::string> expected = {"name",
                                             "enable_logging",
                                             "mass",
                                             "scale",
                                             "slots",
                                             "offset",
                                             "seed",
                                             "timing",
                                             "spare/force_constant",
                                             "spare/direction",
                                             "max_range"};
  EXPECT_EQ(names, expected);
}

TEST(ConfigFields, SaysKindDefaultRangeAndMeaning) {
  EXPECT_EQ(field_called("name").kind, Kind::kText);
  EXPECT_EQ(field_called("name").default_text, "firefly");
  EXPECT_EQ(field_called("enable_logging").kind, Kind::kBool);
  EXPECT_EQ(field_called("enable_logging").default_text, "false");
  const ConfigField mass = field_called("mass");
  EXPECT_EQ(mass.kind, Kind::kNumber);
  EXPECT_EQ(mass.default_text, "1.5");
  EXPECT_TRUE(mass.range.lo == 0.0 && mass.range.lo_open);
  EXPECT_EQ(mass.doc, "of the whole vehicle [kg]");
  EXPECT_EQ(field_called("spare/direction").kind, Kind::kWhole);
}

TEST(ConfigFields, KnowsTheNamesOfAnEnum) {
  const ConfigField timing = field_called("timing");
  EXPECT_EQ(timing.kind, Kind::kChoice);
  EXPECT_EQ(timing.choices, (std::vector<std::string>{"direct", "rotors"}));
  EXPECT_EQ(timing.default_text, "direct");
}

TEST(ConfigFields, SaysWhatMayBeMissing) {
  const ConfigField range = field_called("max_range");
  EXPECT_TRUE(range.is_optional);
  EXPECT_EQ(range.default_text, "");
  EXPECT_EQ(range.kind, Kind::kNumber);
}

TEST(ConfigFields, TakesDefaultsOfAValue) {
  VehicleConfig vehicle;
  vehicle.max_range = 7.5;
  for (const ConfigField& field : config_fields(vehicle)) {
    if (field.name != "max_range") continue;
    EXPECT_FALSE(field.is_optional);
    EXPECT_EQ(field.default_text, "7.5");
  }
}

TEST(DescribedFactory, IsMadeOfALambdaAndTakesFields) {
  using Factory = DescribedFactory<std::unique_ptr<int>(int)>;
  Factory factory = [](int value) { return std::make_unique<int>(value); };
  EXPECT_TRUE(factory.fields.empty());
  factory.fields = config_fields<VehicleConfig>();
  const Factory copy = factory;
  EXPECT_EQ(*copy(3), 3);
  EXPECT_FALSE(copy.fields.empty());
}

}  // namespace
}  // namespace trident
