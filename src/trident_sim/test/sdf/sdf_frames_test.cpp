// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "test_world.h"

namespace trident::sim {
namespace {

const double kQuarter = std::acos(0.0);

ModelSpec load(const std::string& content, const std::string& version = "1.9") {
  return load_model_string(
      "<sdf version='" + version + "'><model name='m'>" + content + "</model></sdf>", "test.sdf",
      Resources(), [](const std::string&) {});
}

const LinkSpec& link(const ModelSpec& model, const std::string& name) {
  for (const LinkSpec& one : model.links) {
    if (one.name == name) return one;
  }
  throw Error("no link " + name);
}

TEST(SdfFrames, LinkPosesAreInTheModelFrame) {
  const ModelSpec model = load("<link name='a'><pose>1 0 0 0 0 0</pose></link>");
  EXPECT_TRUE(is_near(model.links[0].T_model_link, at(1, 0, 0), 1e-12));
}

TEST(SdfFrames, PosesMayBeRelativeToLinksAndFrames) {
  const ModelSpec model = load(R"(
    <frame name='f'><pose>0 0 1 0 0 1.5707963267948966</pose></frame>
    <link name='a'><pose relative_to='f'>1 0 0 0 0 0</pose></link>
    <link name='b'><pose relative_to='a'>1 0 0 0 0 0</pose></link>)");
  EXPECT_TRUE(
      is_near(link(model, "a").T_model_link, SE3::from_xyz_rpy({0, 1, 1}, 0, 0, kQuarter), 1e-9));
  EXPECT_TRUE(
      is_near(link(model, "b").T_model_link, SE3::from_xyz_rpy({0, 2, 1}, 0, 0, kQuarter), 1e-9));
}

TEST(SdfFrames, CollisionsAndInertialsAreInTheLinkFrame) {
  const ModelSpec model = load(R"(<link name='a'><pose>1 0 0 0 0 1.5707963267948966</pose>
    <inertial><pose>0.1 0 0 0 0 0</pose><mass>1</mass></inertial>
    <collision name='c'><pose>0 0.2 0 0 0 0</pose><geometry><box><size>1 1 1</size></box></geometry></collision></link>)");
  EXPECT_TRUE(is_near(model.links[0].inertial.T_link_com, at(0.1, 0, 0), 1e-12));
  EXPECT_TRUE(is_near(model.links[0].collisions[0].T_link_shape, at(0, 0.2, 0), 1e-12));
}

const char kHinge[] = R"(<link name='a'/>
    <link name='b'><pose>2 0 0 0 0 1.5707963267948966</pose></link>
    <joint name='j' type='revolute'><parent>a</parent><child>b</child>%POSE%
      <axis><xyz%FRAME%>1 0 0</xyz><limit><lower>-1</lower><upper>0.5</upper><effort>3</effort>
      <velocity>4</velocity></limit><dynamics><damping>0.1</damping><friction>0.2</friction></dynamics></axis></joint>)";

std::string hinge(const std::string& pose, const std::string& frame) {
  std::string text = kHinge;
  text.replace(text.find("%POSE%"), 6, pose);
  text.replace(text.find("%FRAME%"), 7, frame);
  return text;
}

TEST(SdfFrames, JointsStandInTheChildFrameByDefault) {
  const JointSpec joint = load(hinge("", "")).joints.at(0);
  EXPECT_TRUE(is_near(joint.T_model_joint.p, {2, 0, 0}, 1e-9));
  EXPECT_TRUE(is_near(joint.axis_model, {0, 1, 0}, 1e-9));
  EXPECT_DOUBLE_EQ(joint.lower, -1.0);
  EXPECT_DOUBLE_EQ(joint.upper, 0.5);
  EXPECT_DOUBLE_EQ(joint.effort, 3.0);
  EXPECT_DOUBLE_EQ(joint.velocity, 4.0);
  EXPECT_DOUBLE_EQ(joint.damping, 0.1);
  EXPECT_DOUBLE_EQ(joint.friction, 0.2);
}

TEST(SdfFrames, JointPosesMoveTheAnchor) {
  const JointSpec joint = load(hinge("<pose>0.5 0 0 0 0 0</pose>", "")).joints.at(0);
  EXPECT_TRUE(is_near(joint.T_model_joint.p, {2, 0.5, 0}, 1e-9));
}

TEST(SdfFrames, AxesMayBeExpressedInTheModelFrame) {
  const JointSpec joint = load(hinge("", " expressed_in='__model__'")).joints.at(0);
  EXPECT_TRUE(is_near(joint.axis_model, {1, 0, 0}, 1e-9));
}

TEST(SdfFrames, OldAxesMayUseTheParentModelFrame) {
  const ModelSpec model = load(R"(<link name='a'/>
    <link name='b'><pose>2 0 0 0 0 1.5707963267948966</pose></link>
    <joint name='j' type='revolute'><parent>a</parent><child>b</child>
      <axis><xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame>
      <limit><lower>-1e16</lower><upper>1e16</upper></limit></axis></joint>)",
                               "1.6");
  EXPECT_TRUE(is_near(model.joints.at(0).axis_model, {1, 0, 0}, 1e-9));
  EXPECT_TRUE(std::isinf(model.joints[0].lower));
}

TEST(SdfFrames, NestedModelsJoinWithTheirPoses) {
  const ModelSpec model = load(R"(<link name='base'/>
    <model name='arm'><pose>0 0 1 0 0 1.5707963267948966</pose>
      <link name='upper'><pose>1 0 0 0 0 0</pose></link>
      <link name='lower'><pose>2 0 0 0 0 0</pose></link>
      <joint name='elbow' type='revolute'><parent>upper</parent><child>lower</child>
        <axis><xyz>1 0 0</xyz></axis></joint></model>
    <joint name='mount' type='fixed'><parent>base</parent><child>arm::upper</child></joint>)");
  EXPECT_TRUE(is_near(link(model, "arm::upper").T_model_link,
                      SE3::from_xyz_rpy({0, 1, 1}, 0, 0, kQuarter), 1e-9));
  ASSERT_EQ(model.joints.size(), 2u);
  EXPECT_EQ(model.joints[0].name, "mount");
  EXPECT_EQ(model.joints[0].child, "arm::upper");
  EXPECT_EQ(model.joints[1].parent, "arm::upper");
  EXPECT_TRUE(is_near(model.joints[1].axis_model, {0, 1, 0}, 1e-9));
  EXPECT_TRUE(is_near(model.joints[1].T_model_joint.p, {0, 2, 1}, 1e-9));
}

TEST(SdfFrames, ANestedModelIsOneBodyWhenFixed) {
  TestWorld world;
  ModelSpec spec = load(R"(<link name='base'><inertial><mass>2</mass></inertial></link>
    <model name='tool'><pose>0 0 1 0 0 0</pose><link name='l'><inertial><mass>2</mass></inertial></link></model>
    <joint name='mount' type='fixed'><parent>base</parent><child>tool::l</child></joint>)");
  Model& model = world.add(std::move(spec));
  ASSERT_EQ(model.bodies.size(), 1u);
  EXPECT_TRUE(is_near(model.bodies[0]->pose().p, {0, 0, 0.5}, 1e-12));
  EXPECT_NE(world->find_link("m::tool::l"), nullptr);
}

TEST(SdfFrames, ABareModelElementIsAccepted) {
  const ModelSpec model =
      load_model_string("<?xml version='1.0'?><model name='bare'><link name='l'/></model>", "x",
                        Resources(), [](const std::string&) {});
  EXPECT_EQ(model.name, "bare");
}

}  // namespace
}  // namespace trident::sim
