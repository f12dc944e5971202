// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/yaml_config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "config_example.h"

namespace trident {
namespace {

VehicleConfig load(const std::string& text) {
  return load_yaml_string<VehicleConfig>(text, "vehicle.yaml");
}

TEST(YamlConfig, EveryFieldTypeIsRead) {
  const VehicleConfig config = load(R"(
name: hummingbird
enable_logging: true
mass: 1e-1
scale: .5
slots: 0xff
offset: -9223372036854775808
seed: 18446744073709551615
timing: rotors
spare: {force_constant: 1, direction: -1}
rotors:
  - force_constant: 0.25
  - {}
limits: [-10, 9.5]
inertia: [1, 2, +3]
gains: [1, 2]
max_range: .inf
weights: {a: 0, b: 1}
groups: {left: [1, -2], right: []}
modes: [direct, rotors]
)");
  EXPECT_EQ(config.name, "hummingbird");
  EXPECT_TRUE(config.enable_logging);
  EXPECT_EQ(config.mass, 0.1);
  EXPECT_EQ(config.scale, 0.5F);
  EXPECT_EQ(config.slots, 255);
  EXPECT_EQ(config.offset, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(config.seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(config.timing, Timing::kRotors);
  EXPECT_EQ(config.spare.direction, -1);
  ASSERT_EQ(config.rotors.size(), 2u);
  EXPECT_EQ(config.rotors[0].force_constant, 0.25);
  EXPECT_EQ(config.rotors[1].force_constant, 8.5e-6);
  EXPECT_EQ(config.limits, (std::array{-10.0, 9.5}));
  EXPECT_EQ(config.inertia, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(config.gains, Eigen::Vector2d(1, 2));
  EXPECT_TRUE(std::isinf(config.max_range.value()));
  EXPECT_EQ(config.weights, (std::map<std::string, double>{{"a", 0.0}, {"b", 1.0}}));
  EXPECT_EQ(config.groups.at("left"), (std::vector{1, -2}));
  EXPECT_TRUE(config.groups.at("right").empty());
  EXPECT_EQ(config.modes, (std::vector{Timing::kDirect, Timing::kRotors}));
}

TEST(YamlConfig, AbsentKeysKeepTheirDefaults) {
  for (const char* text : {"", "# nothing\n", "---\n", "{}", "mass: 2"}) {
    EXPECT_EQ(load(text).name, "firefly") << text;
    EXPECT_EQ(load(text).inertia, Eigen::Vector3d::Ones()) << text;
  }
}

TEST(YamlConfig, TextIsTakenAsItStands) {
  // Traps of untyped YAML: these are text, because the field is.
  EXPECT_EQ(load("name: on").name, "on");
  EXPECT_EQ(load("name: 1.10").name, "1.10");
  EXPECT_EQ(load("name: '12'").name, "12");
  EXPECT_EQ(load("name: \"\"").name, "");
  EXPECT_EQ(load("name: !!str 5").name, "5");
}

TEST(YamlConfig, NothingClearsAnOptional) {
  EXPECT_FALSE(load("max_range:").max_range.has_value());
  EXPECT_FALSE(load("max_range: ~").max_range.has_value());
  EXPECT_EQ(load("max_range: 5").max_range, 5.0);
}

TEST(YamlConfig, AnchorsAreExpanded) {
  const VehicleConfig config = load("spare: &r {direction: -1}\nrotors: [*r, *r]\n");
  ASSERT_EQ(config.rotors.size(), 2u);
  EXPECT_EQ(config.rotors[1].direction, -1);
}

TEST(YamlConfig, RequiredKeysAreRead) {
  const auto config =
      load_yaml_string<StrictConfig>("rate: 100\nrotor: {direction: -1}", "strict.yaml");
  EXPECT_EQ(config.rate, 100.0);
  EXPECT_EQ(config.rotor.direction, -1);
}

TEST(YamlConfig, FilesAreRead) {
  const auto path = std::filesystem::path(testing::TempDir()) / "trident_base_vehicle.yaml";
  std::ofstream(path) << "mass: 3.25\n";
  EXPECT_EQ(load_yaml<VehicleConfig>(path.string()).mass, 3.25);
  std::ofstream(path, std::ios::trunc).close();
  EXPECT_EQ(load_yaml<VehicleConfig>(path.string()).mass, 1.5);
  std::filesystem::remove(path);
}

TEST(YamlConfig, ATreeFromElsewhereIsCheckedAsAFileIs) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kMap;
  node.keys = {"mass"};
  node.key_lines = {0};
  node.items.resize(1);
  node.items[0].kind = ConfigNode::Kind::kScalar;
  node.items[0].scalar = "4";
  EXPECT_EQ(load_config_node<VehicleConfig>(node, "/UAV1").mass, 4.0);
  node.items[0].scalar = "-4";
  try {
    load_config_node<VehicleConfig>(node, "/UAV1");
    FAIL() << "a negative mass was accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "/UAV1: mass: -4 is out of range; must be a number > 0 kg");
  }
}

}  // namespace
}  // namespace trident
