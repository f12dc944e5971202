// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {
namespace {

constexpr double kTurn = 6.283185307179586;

/// A model with links a, b and base and one joint from a to b.
std::string model_text(const std::string& type, const std::string& body) {
  return "<sdf version='1.6'><model name='m'><link name='base'/><link name='a'/><link name='b'/>"
         "<joint name='j' type='" +
         type + "'><parent>a</parent><child>b</child>" + body + "</joint></model></sdf>";
}

JointSpec load(const std::string& type, const std::string& body) {
  return load_model_string(model_text(type, body), "m.sdf", Resources(), [](const std::string&) {})
      .joints.at(0);
}

std::string load_error(const std::string& type, const std::string& body) {
  return error_of([&] { load(type, body); });
}

const std::string kAxis = "<axis><xyz>0 1 0</xyz></axis>";
const std::string kAxis2 =
    "<axis2><xyz>1 0 0</xyz><limit><lower>-1</lower><upper>2</upper></limit>"
    "<dynamics><damping>0.3</damping></dynamics></axis2>";

TEST(SdfJoint, ABallNeedsNoAxis) {
  const JointSpec joint = load("ball", "<pose>0 0 0.5 0 0 0</pose>");
  EXPECT_EQ(joint.type, JointType::kBall);
  EXPECT_TRUE(is_near(joint.T_model_joint.p, {0, 0, 0.5}, 1e-12));
  EXPECT_FALSE(joint.rigid());
}

TEST(SdfJoint, AUniversalJointHasTwoAxes) {
  const JointSpec joint = load("universal", kAxis + kAxis2);
  EXPECT_EQ(joint.type, JointType::kUniversal);
  EXPECT_EQ(joint.axis_model, Eigen::Vector3d(0, 1, 0));
  EXPECT_TRUE(std::isinf(joint.upper));
  EXPECT_EQ(joint.axis2.axis_model, Eigen::Vector3d(1, 0, 0));
  EXPECT_DOUBLE_EQ(joint.axis2.lower, -1.0);
  EXPECT_DOUBLE_EQ(joint.axis2.upper, 2.0);
  EXPECT_DOUBLE_EQ(joint.axis2.damping, 0.3);
  EXPECT_TRUE(contains(load_error("universal", kAxis), "m.sdf: joint 'j': has no <axis2>"));
}

TEST(SdfJoint, TheOldThreadPitchIsInRadiansPerMeterAndLeftHanded) {
  const JointSpec joint = load("screw", "<thread_pitch>-100</thread_pitch>" + kAxis);
  EXPECT_EQ(joint.type, JointType::kScrew);
  EXPECT_NEAR(joint.screw_pitch_m, kTurn / 100, 1e-12);
}

TEST(SdfJoint, TheNewThreadPitchIsInMetersPerTurnAndRightHanded) {
  const JointSpec joint = load("screw", "<screw_thread_pitch>0.02</screw_thread_pitch>" + kAxis);
  EXPECT_DOUBLE_EQ(joint.screw_pitch_m, 0.02);
}

TEST(SdfJoint, APitchOfZeroIsRefused) {
  EXPECT_TRUE(contains(load_error("screw", "<thread_pitch>0</thread_pitch>" + kAxis),
                       "m.sdf: joint 'j': <thread_pitch> is 0.000000, must be a travel of"));
}

TEST(SdfJoint, AGearboxHasARatioAndAReference) {
  const std::string reference = "<gearbox_reference_body>base</gearbox_reference_body>";
  const JointSpec joint =
      load("gearbox", "<gearbox_ratio>-2.5</gearbox_ratio>" + reference + kAxis + kAxis2);
  EXPECT_EQ(joint.type, JointType::kGearbox);
  EXPECT_DOUBLE_EQ(joint.gearbox_ratio, -2.5);
  EXPECT_EQ(joint.gearbox_reference_body, "base");
  EXPECT_TRUE(contains(load_error("gearbox", kAxis + kAxis2), "has no <gearbox_reference_body>"));
  EXPECT_TRUE(contains(
      load_error("gearbox", "<gearbox_ratio>0</gearbox_ratio>" + reference + kAxis + kAxis2),
      "<gearbox_ratio> is 0.000000, must be 1e-3 to 1e3"));
}

TEST(SdfJoint, SpringAndStopsAreRead) {
  const JointSpec joint = load(
      "revolute",
      "<axis><xyz>0 0 1</xyz><dynamics><spring_stiffness>7</spring_stiffness><spring_reference>0.2"
      "</spring_reference><friction>0.5</friction></dynamics></axis>"
      "<physics><ode><limit><erp>0.6</erp><cfm>0.001</cfm></limit></ode></physics>");
  EXPECT_DOUBLE_EQ(joint.spring_stiffness, 7.0);
  EXPECT_DOUBLE_EQ(joint.spring_reference, 0.2);
  EXPECT_DOUBLE_EQ(joint.friction, 0.5);
  EXPECT_EQ(joint.stop_erp, 0.6);
  EXPECT_EQ(joint.stop_cfm, 0.001);
  EXPECT_FALSE(load("revolute", kAxis).stop_erp);
}

TEST(SdfJoint, DynamicsMustBeFiniteAndNotNegative) {
  for (const char* name : {"damping", "friction", "spring_stiffness"}) {
    for (const char* value : {"-1", "inf", "-inf", "nan"}) {
      const std::string element = "<" + std::string(name) + ">";
      EXPECT_TRUE(contains(load_error("revolute", "<axis><xyz>0 0 1</xyz><dynamics>" + element +
                                                      value + "</" + name + "></dynamics></axis>"),
                           "m.sdf: joint 'j': " + element + " is "));
    }
  }
}

TEST(SdfJoint, WhatIsNotSupportedNamesWhatIs) {
  EXPECT_TRUE(contains(load_error("revolute2", kAxis + kAxis2),
                       "m.sdf: joint 'j': type is not supported (legal: fixed, revolute, "
                       "continuous, prismatic, ball, universal, screw, gearbox)"));
}

}  // namespace
}  // namespace trident::sim
