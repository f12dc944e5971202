// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

std::string inertial(const std::string& mass = "1", const std::string& ixx = "0.1") {
  return "<inertial><mass value='" + mass + "'/><inertia ixx='" + ixx +
         "' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial>";
}
std::string link(const std::string& name, const std::string& content) {
  return "<link name='" + name + "'>" + content + "</link>\n";
}
std::string joint(const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& extra = "") {
  return "<joint name='" + child + "_joint' type='" + type + "'><origin xyz='0 0 1' rpy='0 0 0'/>" +
         "<parent link='" + parent + "'/><child link='" + child + "'/>" + extra + "</joint>\n";
}
std::string robot(const std::string& content) {
  return "<?xml version='1.0'?>\n<robot name='r'>\n" + content + "</robot>\n";
}

struct Loaded {
  ModelSpec model;
  std::vector<std::string> warnings;
};
Loaded load_urdf(const std::string& xml, const std::vector<std::string>& folders = {}) {
  Loaded loaded;
  loaded.model = load_model_string(xml, "robot.urdf", Resources(folders),
                                   [&](const std::string& t) { loaded.warnings.push_back(t); });
  return loaded;
}

TEST(Urdf, LinksAndJointsAreConverted) {
  const Loaded loaded = load_urdf(
      robot(link("base", inertial()) + link("arm", inertial()) +
            joint("revolute", "base", "arm",
                  "<axis xyz='0 1 0'/><limit lower='-1' upper='2' effort='3' velocity='4'/>")));
  ASSERT_EQ(loaded.model.links.size(), 2u);
  ASSERT_EQ(loaded.model.joints.size(), 1u);
  EXPECT_EQ(loaded.model.joints[0].type, JointType::kRevolute);
  EXPECT_DOUBLE_EQ(loaded.model.joints[0].upper, 2.0);
  EXPECT_TRUE(is_near(loaded.model.joints[0].axis_model, {0, 1, 0}, 1e-9));
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(Urdf, ContinuousJointsHaveNoLimits) {
  const Loaded loaded =
      load_urdf(robot(link("base", inertial()) + link("wheel", inertial()) +
                      joint("continuous", "base", "wheel", "<axis xyz='0 1 0'/>")));
  EXPECT_TRUE(std::isinf(loaded.model.joints[0].upper));
  EXPECT_FALSE(loaded.model.joints[0].rigid());
}

TEST(Urdf, FixedAndZeroLimitJointsBecomeOneBody) {
  TestWorld world;
  Model& model = world.add(
      load_urdf(
          robot(link("base", inertial("1")) + link("fixed", inertial("2")) +
                link("sensor", inertial("1")) + joint("fixed", "base", "fixed") +
                joint("revolute", "base", "sensor",
                      "<axis xyz='0 0 1'/><limit lower='0' upper='0' effort='0' velocity='0'/>")))
          .model);
  ASSERT_EQ(model.bodies.size(), 1u);
  EXPECT_DOUBLE_EQ(model.bodies[0]->mass(), 4.0);
  EXPECT_TRUE(is_near(model.bodies[0]->pose().p, {0, 0, 0.75}, 1e-9));
  ASSERT_NE(model.find_link("sensor"), nullptr);
  EXPECT_TRUE(is_near(model.find_link("sensor")->T_world_link(), at(0, 0, 1), 1e-9));
}

TEST(Urdf, GazeboTagsReachTheModel) {
  const Loaded loaded = load_urdf(
      robot(link("base", inertial() +
                             "<collision><geometry><sphere radius='0.1'/></geometry></collision>") +
            "<gazebo reference='base'><mu1>0.3</mu1><mu2>0.2</mu2><kp>1000</kp>"
            "<minDepth>0.002</minDepth><maxVel>0.4</maxVel></gazebo>"
            "<gazebo><plugin name='p' filename='libp.so'><topic>t</topic></plugin></gazebo>"
            "<gazebo><static>true</static></gazebo>"));
  EXPECT_DOUBLE_EQ(loaded.model.links[0].collisions[0].surface.mu, 0.3);
  EXPECT_DOUBLE_EQ(loaded.model.links[0].collisions[0].surface.mu2, 0.2);
  EXPECT_DOUBLE_EQ(loaded.model.links[0].collisions[0].surface.kp_n_m, 1000.0);
  EXPECT_EQ(loaded.model.links[0].collisions[0].surface.min_depth_m, 0.002);
  EXPECT_EQ(loaded.model.links[0].collisions[0].surface.max_vel_m_s, 0.4);
  ASSERT_EQ(loaded.model.plugins.size(), 1u);
  EXPECT_EQ(loaded.model.plugins[0].params.find("topic")->text, "t");
  EXPECT_TRUE(loaded.model.is_static);
}

TEST(Urdf, ALinkWithoutInertialIsAWarningWithItsLine) {
  const Loaded loaded =
      load_urdf(robot(link("base", inertial()) + link("ghost", "") +
                      joint("continuous", "base", "ghost", "<axis xyz='0 0 1'/>")));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded.warnings[0], "robot.urdf:4"));
  EXPECT_TRUE(contains(loaded.warnings[0], "'ghost'"));
}

TEST(Urdf, AMasslessFrameOnAFixedJointIsNoCauseForAWarning) {
  const std::string frames = link("base", inertial()) + link("camera", "") +
                             joint("fixed", "base", "camera") + link("optical", "") +
                             joint("fixed", "camera", "optical");
  EXPECT_TRUE(load_urdf(robot(frames)).warnings.empty());
  const Loaded loaded =
      load_urdf(robot(frames + link("wheel", inertial()) +
                      joint("continuous", "optical", "wheel", "<axis xyz='0 1 0'/>")));
  ASSERT_EQ(loaded.warnings.size(), 2u) << "what moves on a frame is lost";
  EXPECT_TRUE(contains(loaded.warnings[0], "'camera'"));
  EXPECT_TRUE(contains(loaded.warnings[1], "'optical'"));
}

TEST(Urdf, ElementsWithoutEffectAreNamedOnceWithTheirFirstLine) {
  const std::string drive = "<wheels name='t'><type>x</type></wheels>\n";
  const Loaded loaded =
      load_urdf(robot(link("base", inertial()) + link("wheel", inertial()) +
                      joint("continuous", "base", "wheel", "<axis xyz='0 1 0'/><limits/>") + drive +
                      drive + "<gazebo reference='wheel'><mu>1</mu><mu1>1</mu1></gazebo>"));
  ASSERT_EQ(loaded.warnings.size(), 3u);
  EXPECT_EQ(loaded.warnings[0], "robot.urdf:6: <wheels> in <robot> (2 times) has no effect here");
  EXPECT_EQ(loaded.warnings[1], "robot.urdf:5: <limits> in <joint> has no effect here");
  EXPECT_EQ(loaded.warnings[2], "robot.urdf:8: <mu> in <gazebo> has no effect here");
}

TEST(Urdf, WhatIsForOthersThanASimulatorIsNotReported) {
  const Loaded loaded = load_urdf(
      robot(link("base", inertial()) + link("wheel", inertial()) +
            joint("continuous", "base", "wheel",
                  "<axis xyz='0 1 0'/><mimic joint='j'/><safety_controller k_velocity='1'/>"
                  "<calibration rising='0'/>") +
            "<transmission name='t'><type>x</type></transmission>"));
  EXPECT_TRUE(loaded.warnings.empty()) << testing::PrintToString(loaded.warnings);
}

TEST(Urdf, ARootThatAFixedChildGivesInertiaIsFine) {
  const Loaded loaded = load_urdf(robot(link("base", "") + link("base_inertia", inertial()) +
                                        joint("fixed", "base", "base_inertia")));
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(loaded.model.links[0].name, "base");
  EXPECT_DOUBLE_EQ(loaded.model.links[0].inertial.mass_kg, 1.0);
}

struct BadInertial {
  const char *mass, *ixx, *message;
};
class UrdfInertial : public testing::TestWithParam<BadInertial> {};

TEST_P(UrdfInertial, IsRefusedWithFileLineLinkAndValue) {
  const std::string error = error_of([] {
    load_urdf(robot(link("base", inertial()) +
                    link("bad", inertial(GetParam().mass, GetParam().ixx)) +
                    joint("fixed", "base", "bad")));
  });
  EXPECT_TRUE(contains(error, "robot.urdf:4: link 'bad'"));
  EXPECT_TRUE(contains(error, GetParam().message));
}
INSTANTIATE_TEST_SUITE_P(Bad, UrdfInertial,
                         testing::Values(BadInertial{"0", "0.1", "mass is 0 kg, must be > 0"},
                                         BadInertial{"-2", "0.1", "mass is -2 kg"},
                                         BadInertial{"heavy", "0.1",
                                                     "'heavy' is not a finite number"},
                                         BadInertial{"nan", "0.1", "not a finite number"},
                                         BadInertial{"1", "0", "not positive definite"},
                                         BadInertial{"1", "-0.1", "not positive definite"}));

Loaded load_leniently(const std::string& xml) {
  Loaded loaded;
  loaded.model = load_model_string(
      xml, "robot.urdf", Resources(), [&](const std::string& t) { loaded.warnings.push_back(t); },
      OddElements::kLeaveOut);
  return loaded;
}

TEST_P(UrdfInertial, IsOneOddElementAndTheRobotLoads) {
  const Loaded loaded = load_leniently(
      robot(link("base", inertial()) + link("bad", inertial(GetParam().mass, GetParam().ixx)) +
            joint("fixed", "base", "bad")));
  ASSERT_EQ(loaded.model.odd_elements.size(), 1u);
  const std::string& odd = loaded.model.odd_elements[0];
  EXPECT_TRUE(contains(odd, "robot.urdf:4: link 'bad': "));
  EXPECT_TRUE(contains(odd, GetParam().message));
  EXPECT_TRUE(contains(odd, "is used, as in Gazebo") ||
              contains(odd, "; read as a link without <inertial>"));
  EXPECT_EQ(loaded.model.links.size(), 1u);
  EXPECT_GE(loaded.model.links[0].inertial.mass_kg, 1.0);
  EXPECT_TRUE(loaded.warnings.empty()) << testing::PrintToString(loaded.warnings);
}

TEST(Urdf, AMovingLinkWhoseMassCannotBeIsAsOneWithoutInertial) {
  // Two in one line: only the second is blanked.
  const Loaded loaded = load_leniently(
      robot("<link name='base'>" + inertial("3") + "</link><link name='wheel'>" + inertial("0") +
            "</link>\n" + joint("continuous", "base", "wheel", "<axis xyz='0 1 0'/>")));
  ASSERT_EQ(loaded.model.odd_elements.size(), 1u);
  EXPECT_TRUE(contains(loaded.model.odd_elements[0], "robot.urdf:3: link 'wheel': mass is 0 kg"));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded.warnings[0], "link 'wheel' has no <inertial>: it is not simulated"));
  ASSERT_EQ(loaded.model.links.size(), 1u);
  EXPECT_DOUBLE_EQ(loaded.model.links[0].inertial.mass_kg, 3.0);
}

TEST(Urdf, AMovingLinkWithoutInertiaTurnsAsInGazebo) {
  const std::string point =
      "<inertial><mass value='0.2'/><inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/>"
      "</inertial>";
  const Loaded loaded =
      load_leniently(robot(link("base", inertial()) + link("arm", point) +
                           joint("continuous", "base", "arm", "<axis xyz='0 1 0'/>")));
  ASSERT_EQ(loaded.model.odd_elements.size(), 1u);
  ASSERT_EQ(loaded.model.links.size(), 2u);
  EXPECT_DOUBLE_EQ(loaded.model.links[1].inertial.mass_kg, 0.2);
  EXPECT_TRUE(loaded.model.links[1].inertial.inertia_com.isIdentity());
}

TEST(Urdf, APointMassOnAFixedJointIsLumpedAsOne) {
  const std::string point =
      "<inertial><mass value='0.5'/><inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/>"
      "</inertial>";
  const Loaded loaded = load_leniently(
      robot(link("base", inertial()) + link("mast", point) + joint("fixed", "base", "mast")));
  const Inertial& inertial = loaded.model.links.at(0).inertial;
  EXPECT_DOUBLE_EQ(inertial.mass_kg, 1.5);
  EXPECT_NEAR(inertial.inertia_com(2, 2), 0.1, 1e-9);
  EXPECT_NEAR(inertial.inertia_com(0, 0), 0.1 + 1.0 * 0.5 / 1.5, 1e-9);
}

TEST(Urdf, MomentsOfInertiaThatNoBodyHasAreReportedWithTheirLine) {
  const std::string xml = robot(link("base", inertial()) + link("arm", inertial("1", "2.0")) +
                                joint("continuous", "base", "arm", "<axis xyz='0 1 0'/>"));
  const std::string fault =
      "robot.urdf:4: link 'arm': principal moments of inertia are 0.1, 0.1 and 2 kg m^2; of a "
      "body none is larger than the sum of the other two";
  EXPECT_TRUE(contains(error_of([&] { load_urdf(xml); }), fault));
  const Loaded loaded = load_leniently(xml);
  ASSERT_EQ(loaded.model.odd_elements.size(), 1u);
  EXPECT_EQ(loaded.model.odd_elements[0], fault + "; used as it is, as in Gazebo");
  EXPECT_DOUBLE_EQ(loaded.model.links.at(1).inertial.inertia_com(0, 0), 2.0);
}

TEST(Urdf, MomentsOfInertiaOffOneAnotherByAMeasurementsErrorAreNotOdd) {
  EXPECT_TRUE(load_urdf(robot(link("base", inertial("1", "0.25")))).warnings.empty());
}

TEST(Urdf, AMissingVisualMeshIsOneWarning) {
  const std::string visual =
      "<visual><geometry><mesh filename='package://no_such_package/a.dae'/></geometry></visual>";
  const Loaded loaded = load_urdf(robot(link("base", inertial() + visual)));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded.warnings[0], "no_such_package/a.dae"));
}

TEST(Urdf, AMissingCollisionMeshRefusesTheModel) {
  const std::string collision =
      "<collision><geometry><mesh "
      "filename='package://no_such_package/a.stl'/></geometry></collision>";
  const std::string error =
      error_of([&] { load_urdf(robot(link("base", inertial() + collision))); });
  EXPECT_TRUE(contains(error, "robot.urdf"));
  EXPECT_TRUE(contains(error, "no_such_package/a.stl"));
  EXPECT_TRUE(contains(error, "searched:"));
}

TEST(Urdf, MeshesOfPackagesAreFound) {
  const ScratchFolder folder;
  folder.write("my_robot/package.xml", "<package/>");
  const std::string mesh = folder.write("my_robot/meshes/a.stl", "solid a\nendsolid a\n");
  const ScopedEnvironment path("ROS_PACKAGE_PATH", folder.path());
  const Loaded loaded = load_urdf(robot(link(
      "base", inertial() + "<collision><geometry><mesh filename='package://my_robot/meshes/a.stl' "
                           "scale='2 2 2'/></geometry></collision>")));
  const auto& shape = std::get<MeshShape>(loaded.model.links[0].collisions[0].shape);
  EXPECT_EQ(shape.file, mesh);
  EXPECT_EQ(shape.scale, Eigen::Vector3d(2, 2, 2));
}

}  // namespace
}  // namespace trident::sim
