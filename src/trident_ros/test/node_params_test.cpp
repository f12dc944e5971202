// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/node_params.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trident::ros_utils {
namespace {

using XmlRpc::XmlRpcValue;

struct Gain {
  double x = 6.0, y = 5.0;
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("x", x, Range::non_negative(), "along x [N/m]");
    ar.field("y", y, Range::non_negative(), "along y [N/m]");
  }
};

struct Rotor {
  double angle = 0.0;
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("angle", angle, Range{-7.0, 7.0}, "azimuth [rad]");
  }
};

struct Params {
  Gain position_gain;
  std::map<std::string, Rotor> rotors;
  std::vector<double> start = {0.0, 0.0};
  std::string frame = "odom";
  bool is_strict = false;
  int count = 3;
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("position_gain", position_gain, "stiffness");
    ar.field("rotor_configuration", rotors, "rotors by number");
    ar.field("start", start, Range::any(), "first position [m]");
    ar.field("frame", frame, "frame of odometry");
    ar.field("strict", is_strict, "refuse odd files");
    ar.field("count", count, Range{1, 1'000'000'000}, "how many");
  }
  void validate() const {
    if (frame.empty()) throw Error("frame is empty");
  }
};

Params read(const XmlRpcValue& value) { return NodeParams(value, "/uav/node").read<Params>(); }

std::string error_of(const XmlRpcValue& value) {
  try {
    read(value);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(NodeParams, GroupsAreNestedNamesAndArraysAreLists) {
  XmlRpcValue value;
  value["position_gain"]["y"] = 2;
  value["rotor_configuration"]["1"]["angle"] = 0.5;
  value["start"][0] = 1;
  value["start"][1] = -2.5;
  value["frame"] = "world";
  const Params params = read(value);
  EXPECT_EQ(params.position_gain.x, 6.0);
  EXPECT_EQ(params.position_gain.y, 2.0);
  EXPECT_EQ(params.rotors.at("1").angle, 0.5);
  EXPECT_EQ(params.start, (std::vector<double>{1.0, -2.5}));
  EXPECT_EQ(params.frame, "world");
}

TEST(NodeParams, NoParametersLeaveTheDefaultsOfTheCaller) {
  Params defaults;
  defaults.count = 7;
  EXPECT_EQ(NodeParams(XmlRpcValue(), "/n").read(defaults).count, 7);
}

TEST(NodeParams, NumbersComeBackToTheBit) {
  XmlRpcValue value;
  value["position_gain"]["x"] = std::nextafter(0.1, 1.0);
  EXPECT_EQ(read(value).position_gain.x, std::nextafter(0.1, 1.0));
  value["position_gain"]["x"] = 1e22;
  EXPECT_EQ(read(value).position_gain.x, 1e22);
}

TEST(NodeParams, AWholeDoubleIsACountAndOneOrZeroIsAFlag) {
  XmlRpcValue value;
  value["count"] = 1e6;
  value["strict"] = 1;
  EXPECT_EQ(read(value).count, 1'000'000);
  EXPECT_TRUE(read(value).is_strict);
  value["strict"] = "1";
  EXPECT_EQ(error_of(value),
            "parameter /uav/node/strict: must be true or false, but is the text '1'");
}

TEST(NodeParams, ErrorsHaveTheFullNameTheValueAndTheRange) {
  XmlRpcValue range, type, nan, item, missing, whole;
  range["position_gain"]["x"] = -1.5;
  EXPECT_EQ(error_of(range),
            "parameter /uav/node/position_gain/x: -1.5 is out of range; must be a number >= 0 N/m");
  type["position_gain"]["x"] = "stiff";
  EXPECT_EQ(error_of(type),
            "parameter /uav/node/position_gain/x: must be a number >= 0 N/m, but is the text "
            "'stiff'");
  nan["position_gain"]["y"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(nan),
            "parameter /uav/node/position_gain/y: nan is out of range; must be a number >= 0 N/m");
  item["start"][0] = 0.0;
  item["start"][1] = true;
  EXPECT_EQ(error_of(item), "parameter /uav/node/start[1]: must be a finite number m, but is true");
  missing["rotor_configuration"]["0"]["arm"] = 1.0;
  EXPECT_EQ(error_of(missing),
            "parameter /uav/node/rotor_configuration/0/angle: missing required key (azimuth "
            "[rad]); must be in [-7, 7] rad");
  whole["frame"] = "";
  EXPECT_EQ(error_of(whole), "parameter /uav/node: frame is empty");
}

TEST(NodeParams, EachUnknownNameIsOneWarningWithTheNearestKnownOne) {
  XmlRpcValue value;
  value["postion_gain"]["x"] = 1.0;
  value["position_gain"]["z"] = 1.0;
  value["rotor_configuration"]["0"]["angle"] = 0.0;
  value["rotor_configuration"]["0"]["angel"] = 0.0;
  value["zzz"] = 1;
  NodeParams params(value, "/n");
  params.read<Params>();
  const std::vector<std::string> expected = {
      "parameter /n/position_gain/z is unknown, not used; did you mean position_gain/x?",
      "parameter /n/postion_gain is unknown, not used; did you mean position_gain?",
      "parameter /n/rotor_configuration/0/angel is unknown, not used; did you mean "
      "rotor_configuration/0/angle?",
      "parameter /n/zzz is unknown, not used"};
  EXPECT_EQ(params.warnings(), expected);
}

TEST(NodeParams, WhatIsReadElsewhereIsKnownAndUpstreamsNamesShareOneWarning) {
  XmlRpcValue value;
  value["method"] = "hector";
  value["kernelSize"] = 1;
  value["astep"] = 1;
  NodeParams params(value, "/n");
  params.read<Params>();
  params.accept({"method"});
  params.accept_without_effect({"astep", "kernelSize", "lstep"});
  EXPECT_EQ(params.warnings(),
            std::vector<std::string>{"parameters without effect here: astep, kernelSize"});
}

TEST(NodeParams, TwoStructsMayShareANode) {
  XmlRpcValue value;
  value["x"] = 1.0;
  value["frame"] = "world";
  NodeParams params(value, "/n");
  EXPECT_EQ(params.read<Gain>().x, 1.0);
  EXPECT_EQ(params.read<Params>().frame, "world");
  EXPECT_TRUE(params.warnings().empty());
}

TEST(NodeParams, AbsentOnesAreNamedWithTheirDefaults) {
  XmlRpcValue value;
  value["position_gain"]["x"] = 1.0;
  value["start"][0] = 1.0;
  NodeParams params(value, "/n");
  params.read<Params>();
  ASSERT_EQ(params.absent().size(), 5U);
  EXPECT_EQ(params.absent()[0].name, "position_gain/y");
  EXPECT_EQ(params.absent()[0].default_value, "5");
  EXPECT_EQ(params.absent()[1].name, "rotor_configuration");
}

TEST(NodeParams, TheReferenceUsesTheNamesOfRos) {
  const std::string table = document_params<Params>();
  EXPECT_NE(table.find("| `~position_gain/x` | number | 6 | >= 0 | along x [N/m] |"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| `~rotor_configuration/<name>/angle` |"), std::string::npos) << table;
}

}  // namespace
}  // namespace trident::ros_utils
