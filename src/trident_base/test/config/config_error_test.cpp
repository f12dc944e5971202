// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "config_example.h"

namespace trident {
namespace {

template <class T = VehicleConfig>
std::string error_of(const std::string& text) {
  try {
    load_yaml_string<T>(text, "cfg/v.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ConfigError, OutOfRangeGivesFileLineKeyValueRangeAndUnit) {
  EXPECT_EQ(error_of("name: a\nmass: -2\n"),
            "cfg/v.yaml:2: mass: -2 is out of range; must be a number > 0 kg");
  EXPECT_EQ(error_of("rotors:\n  - {}\n  - force_constant: 2"),
            "cfg/v.yaml:3: rotors[1].force_constant: 2 is out of range; "
            "must be a number in [0, 1] N s^2");
  EXPECT_EQ(error_of("limits: [-10.5, 0]"),
            "cfg/v.yaml:1: limits[0]: -10.5 is out of range; must be a number in [-10, 10) rad");
  EXPECT_EQ(error_of("limits: [0, 10]"),
            "cfg/v.yaml:1: limits[1]: 10 is out of range; must be a number in [-10, 10) rad");
  EXPECT_EQ(error_of("inertia: [1, 0, 1]"),
            "cfg/v.yaml:1: inertia[1]: 0 is out of range; must be a number > 0 kg m^2");
  EXPECT_EQ(error_of("weights:\n  left: 1.5"),
            "cfg/v.yaml:2: weights.left: 1.5 is out of range; must be a number in [0, 1]");
}

TEST(ConfigError, WholeNumbersRespectTheirTypeAndRange) {
  EXPECT_EQ(error_of("slots: 256"),
            "cfg/v.yaml:1: slots: 256 is out of range; must be a whole number in [0, 255]");
  EXPECT_EQ(error_of("slots: -1"),
            "cfg/v.yaml:1: slots: -1 is out of range; must be a whole number in [0, 255]");
  EXPECT_EQ(error_of("spare: {direction: 2}"),
            "cfg/v.yaml:1: spare.direction: 2 is out of range; must be a whole number in [-1, 1]");
  EXPECT_EQ(error_of("seed: 18446744073709551616"),
            "cfg/v.yaml:1: seed: 18446744073709551616 is out of range; "
            "must be a whole number in [0, 18446744073709551615]");
  EXPECT_EQ(error_of("offset: -9223372036854775809"),
            "cfg/v.yaml:1: offset: -9223372036854775809 is out of range; "
            "must be a whole number in [-9223372036854775808, 9223372036854775807]");
  for (const char* text : {"1.0", "1e3", "'1'", "one", "", "[1]", "1 2", "--1", "0x"}) {
    const std::string error = error_of(std::string("slots: ") + text);
    EXPECT_TRUE(
        starts_with(error, "cfg/v.yaml:1: slots: must be a whole number in [0, 255], but is"))
        << error;
  }
}

TEST(ConfigError, NanAndInfinityAreOutOfRange) {
  for (const char* text : {".nan", ".NaN", "nan", ".inf", "-.inf", "1e999"}) {
    EXPECT_EQ(
        error_of(std::string("mass: ") + text),
        std::string("cfg/v.yaml:1: mass: ") + text + " is out of range; must be a number > 0 kg");
  }
  EXPECT_EQ(error_of("gains: [1, .nan]"),
            "cfg/v.yaml:1: gains[1]: .nan is out of range; must be a finite number");
  EXPECT_EQ(error_of("max_range: -.inf"),
            "cfg/v.yaml:1: max_range: -.inf is out of range; must be a number > 0 or infinite m");
  EXPECT_EQ(error_of("scale: 1e39"),
            "cfg/v.yaml:1: scale: 1e39 is out of range; must be a single-precision number");
}

TEST(ConfigError, WrongTypeSaysWhatIsExpectedAndWhatIsThere) {
  EXPECT_EQ(error_of("mass: heavy"), "cfg/v.yaml:1: mass: must be a number > 0 kg, but is heavy");
  EXPECT_EQ(error_of("mass: '1.5'"),
            "cfg/v.yaml:1: mass: must be a number > 0 kg, but is the text '1.5'");
  EXPECT_EQ(error_of("mass:"), "cfg/v.yaml:1: mass: must be a number > 0 kg, but is nothing");
  EXPECT_EQ(error_of("mass: [1, 2]"),
            "cfg/v.yaml:1: mass: must be a number > 0 kg, but is a list of 2 items");
  EXPECT_EQ(error_of("mass: 1,5"), "cfg/v.yaml:1: mass: must be a number > 0 kg, but is 1,5");
  EXPECT_EQ(error_of("mass: +-1"), "cfg/v.yaml:1: mass: must be a number > 0 kg, but is +-1");
  EXPECT_EQ(error_of("enable_logging: yes"),
            "cfg/v.yaml:1: enable_logging: must be true or false, but is yes");
  EXPECT_EQ(error_of("enable_logging: 1"),
            "cfg/v.yaml:1: enable_logging: must be true or false, but is 1");
  EXPECT_EQ(error_of("name: {a: 1}"), "cfg/v.yaml:1: name: must be text, but is a map of 1 key");
  EXPECT_EQ(error_of("rotors: 3"), "cfg/v.yaml:1: rotors: must be a list, but is 3");
  EXPECT_EQ(error_of("rotors:\n- 3"),
            "cfg/v.yaml:2: rotors[0]: must be a map (lines of key: value), but is 3");
  EXPECT_EQ(error_of("spare: []"),
            "cfg/v.yaml:1: spare: must be a map (lines of key: value), but is a list of 0 items");
  EXPECT_EQ(error_of("weights: 1"),
            "cfg/v.yaml:1: weights: must be a map (lines of key: value), but is 1");
  EXPECT_EQ(error_of("just text"),
            "cfg/v.yaml:1: must be a map (lines of key: value), but is just text");
}

TEST(ConfigError, AListOfTheWrongLength) {
  EXPECT_EQ(error_of("inertia: [1, 2]"),
            "cfg/v.yaml:1: inertia: must be a list of 3 items, but is a list of 2 items");
  EXPECT_EQ(error_of("limits: [1]"),
            "cfg/v.yaml:1: limits: must be a list of 2 items, but is a list of 1 item");
}

TEST(ConfigError, AnUnknownChoiceListsTheKnownOnes) {
  EXPECT_EQ(error_of("timing: rotor"),
            "cfg/v.yaml:1: timing: must be one of direct, rotors, but is rotor; "
            "did you mean 'rotors'?");
  EXPECT_EQ(error_of("modes:\n- direct\n- 7"),
            "cfg/v.yaml:3: modes[1]: must be one of direct, rotors, but is 7");
}

TEST(ConfigError, AnUnknownKeySuggestsTheNearestKnownOne) {
  EXPECT_EQ(error_of("rotors:\n  - direction: 1\n    forse_constant: 0.5"),
            "cfg/v.yaml:3: rotors[0].forse_constant: unknown key (its value is 0.5); "
            "did you mean 'force_constant'? Known keys: force_constant, direction");
  EXPECT_EQ(error_of("spare: {wings: [1]}"),
            "cfg/v.yaml:1: spare.wings: unknown key (its value is a list of 1 item). "
            "Known keys: force_constant, direction");
}

TEST(ConfigError, AMissingRequiredKeyIsExplained) {
  EXPECT_EQ(error_of<StrictConfig>("\nrotor: {}"),
            "cfg/v.yaml:2: rate: missing required key (update rate [Hz]); must be > 0 Hz");
  EXPECT_EQ(error_of<StrictConfig>("rate: 1"),
            "cfg/v.yaml:1: rotor: missing required key (the only rotor)");
  EXPECT_EQ(error_of<StrictConfig>(""),
            "cfg/v.yaml:1: rate: missing required key (update rate [Hz]); must be > 0 Hz");
}

TEST(ConfigError, AMisspeltRequiredKeyIsReportedAsMisspelt) {
  EXPECT_EQ(error_of<StrictConfig>("rats: 1\nrotor: {}"),
            "cfg/v.yaml:1: rats: unknown key (its value is 1); did you mean 'rate'? "
            "Known keys: rate, rotor");
}

TEST(ConfigError, AFailedRuleOfTheStructIsLocated) {
  EXPECT_EQ(error_of("mass: 1\nrotors:\n  - direction: 0"),
            "cfg/v.yaml:3: rotors[0]: direction = 0 must be -1 or 1");
}

TEST(ConfigError, AnUnreadableFileIsNamed) {
  for (const std::string path : {"/nonexistent/v.yaml", "/"}) {
    try {
      load_yaml<VehicleConfig>(path);
      FAIL() << path << " was read";
    } catch (const ConfigError& error) {
      EXPECT_TRUE(starts_with(error.what(), path + ": cannot read the file: ")) << error.what();
    }
  }
}

TEST(ConfigError, PartsCanBeAskedFor) {
  try {
    load_yaml_string<VehicleConfig>("\nspare: {direction: x}", "v.yaml");
    FAIL() << "x was accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.file(), "v.yaml");
    EXPECT_EQ(error.line(), 2);
    EXPECT_EQ(error.key(), "spare.direction");
  }
}

}  // namespace
}  // namespace trident
