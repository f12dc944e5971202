// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

std::string load_error(const std::string& xml) {
  return error_of([&] { load_model_string(xml, "bad.sdf", Resources(), [](const auto&) {}); });
}
std::string model(const std::string& content) {
  return "<sdf version='1.6'><model name='m'>" + content + "</model></sdf>";
}
std::string collision(const std::string& shape) {
  return model("<link name='l'><collision name='c'><geometry>" + shape +
               "</geometry></collision></link>");
}

TEST(SdfError, MalformedXmlIsReportedWithItsLine) {
  EXPECT_TRUE(contains(load_error("<sdf version='1.6'>\n<model name='m'>\n<link>\n</model></sdf>"),
                       "bad.sdf:3"));
  EXPECT_TRUE(contains(load_error(""), "bad.sdf"));
  EXPECT_TRUE(contains(load_error("not xml at all"), "bad.sdf"));
}

TEST(SdfError, AWrongRootIsNamed) {
  EXPECT_TRUE(contains(load_error("<gazebo/>"), "<gazebo>, expected <robot>, <sdf> or <model>"));
  EXPECT_TRUE(contains(load_error("<sdf version='1.6'></sdf>"), "no <model>"));
}

TEST(SdfError, AVersionThatIsNoNumberIsReportedWithItsLine) {
  for (const char* version : {"", "one", "1", "1.6.2", "1.x", "model://no"}) {
    const std::string error =
        load_error("\n<sdf version='" + std::string(version) + "'><model name='m'/></sdf>");
    EXPECT_TRUE(contains(error, "bad.sdf:2: <sdf> version is '" + std::string(version) + "'"));
  }
}

TEST(SdfError, AWorldFileWithoutAWorldIsRefused) {
  const std::string error = error_of([] {
    load_world_string("<sdf version='1.6'></sdf>", "empty.world", Resources(), [](const auto&) {});
  });
  EXPECT_TRUE(contains(error, "empty.world: holds 0 <world> elements, expected 1"));
}

TEST(SdfError, AModelWithoutLinksIsRefused) {
  EXPECT_TRUE(contains(load_error(model("")), "bad.sdf: A model must have at least one link"));
}

TEST(SdfError, ShapesMustHaveASize) {
  EXPECT_TRUE(contains(load_error(collision("<box><size>1 0 1</size></box>")), "box size"));
  EXPECT_TRUE(contains(load_error(collision("<box><size>1 0 1</size></box>")), "collision 'c'"));
  EXPECT_TRUE(
      contains(load_error(collision("<sphere><radius>-1</radius></sphere>")), "sphere radius"));
  EXPECT_TRUE(
      contains(load_error(collision("<cylinder><radius>1</radius><length>0</length></cylinder>")),
               "cylinder length"));
}

TEST(SdfError, CorrectionsOfContactsMustBeFinite) {
  for (const char* name : {"min_depth", "max_vel"}) {
    const std::string element = "<" + std::string(name) + ">";
    const std::string error = load_error(
        model("<link name='l'><collision name='c'><geometry><sphere><radius>1</radius></sphere>"
              "</geometry><surface><contact><ode>" +
              element + "inf</" + name + "></ode></contact></surface></collision></link>"));
    EXPECT_TRUE(contains(
        error, "bad.sdf: link 'l' collision 'c': " + element + " is inf, must be a finite number"));
  }
}

TEST(SdfError, AMeshThatIsNotThereRefusesTheModel) {
  EXPECT_TRUE(contains(load_error(collision("<mesh><uri>model://gone/a.stl</uri></mesh>")),
                       "mesh 'model://gone/a.stl' not found; searched:"));
}

TEST(SdfError, InertiaMustBePositive) {
  EXPECT_TRUE(contains(
      load_error(model("<link name='l'><inertial><mass>0</mass></inertial></link>")), "bad.sdf"));
  EXPECT_TRUE(contains(
      load_error(model("<link name='l'><inertial><mass>1</mass><inertia><ixx>0</ixx><iyy>1</iyy>"
                       "<izz>1</izz></inertia></inertial></link>")),
      "must be > 0"));
}

TEST(SdfError, UnknownJointTypesAndLinksAreNamed) {
  const std::string links = "<link name='a'/><link name='b'/>";
  EXPECT_TRUE(
      contains(load_error(model(links + "<joint name='j' type='revolute2'><parent>a</parent>"
                                        "<child>b</child></joint>")),
               "legal: fixed, revolute, continuous, prismatic"));
  EXPECT_TRUE(contains(load_error(model(links + "<joint name='j' type='fixed'><parent>a</parent>"
                                                "<child>nowhere</child></joint>")),
                       "nowhere"));
  EXPECT_TRUE(contains(
      load_error(model(links +
                       "<joint name='j' type='revolute'><parent>a</parent><child>b</child>"
                       "<axis><xyz>0 0 1</xyz><limit><lower>2</lower><upper>1</upper></limit>"
                       "</axis></joint>")),
      "lower limit 2"));
}

TEST(SdfError, ABadStepSizeIsNamed) {
  const std::string error = error_of([] {
    load_world_string(
        "<sdf version='1.6'><world name='w'><physics type='ode'>"
        "<max_step_size>0</max_step_size></physics></world></sdf>",
        "bad.world", Resources(), [](const auto&) {});
  });
  EXPECT_TRUE(contains(error, "bad.world: <max_step_size>"));
}

TEST(ModelError, UnknownPluginsAreAWarningThatListsTheKnown) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, {});
  spec.plugins.push_back(make_plugin("who", "libwho_is_this.so", {}));
  world.add(std::move(spec));
  EXPECT_NE(world->find_model("m"), nullptr);
  EXPECT_EQ(world.report_count(Severity::kWarning, "model 'm': plugin 'who' (libwho_is_this.so)"),
            1u);
  EXPECT_EQ(world.report_count(Severity::kWarning, "rotors_gazebo_motor_model"), 1u);
}

TEST(ModelError, NamesAreUnique) {
  TestWorld world;
  world.add(make_body("m", SphereShape{0.1}, {}));
  EXPECT_TRUE(contains(error_of([&] { world.add(make_body("m", SphereShape{0.1}, {})); }), "'m'"));
  EXPECT_TRUE(contains(error_of([&] { world.add(make_body("", SphereShape{0.1}, {})); }), "name"));
  EXPECT_EQ(world->models().size(), 1u);
}

TEST(ModelError, AMovingPlaneIsRefused) {
  TestWorld world;
  const std::string error =
      error_of([&] { world.add(make_body("m", PlaneShape{Eigen::Vector3d::UnitZ()}, {})); });
  EXPECT_TRUE(contains(error, "m::link::collision"));
  EXPECT_TRUE(contains(error, "must be static"));
}

TEST(ModelError, JointsThatNameNoLinkAreRefused) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, {});
  spec.joints.push_back(make_joint("j", JointType::kRevolute, "link", "gone", {}, {0, 0, 1}));
  EXPECT_TRUE(contains(error_of([&] { world.add(spec); }), "joint 'j' names link 'gone'"));
  spec.joints.clear();
  spec.links.push_back(spec.links[0]);
  EXPECT_TRUE(contains(error_of([&] { world.add(spec); }), "two links are named 'link'"));
}

TEST(ModelError, ImpossiblePosesAreRefused) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, at(std::nan(""), 0, 0));
  EXPECT_TRUE(contains(error_of([&] { world.add(spec); }), "not finite"));
  spec.T_world_model = {Eigen::Quaterniond(0, 0, 0, 0), {0, 0, 0}};
  EXPECT_TRUE(contains(error_of([&] { world.add(spec); }), "zero quaternion"));
}

TEST(PluginParams, ErrorsNameModelPluginElementValueAndLegalRange) {
  TestWorld world;
  ModelSpec spec = make_quad();
  for (ParamNode& node : spec.plugins[1].params.children) {
    if (node.name == "timeConstantUp") node.text = "-3";
  }
  const std::string error = error_of([&] { world.add(spec); });
  for (const char* part :
       {"model 'quad'", "plugin 'motor_0'", "<timeConstantUp>", "'-3'", "in [1e-12"}) {
    EXPECT_TRUE(contains(error, part));
  }
}

TEST(PluginParams, ReadingIsStrict) {
  const PluginSpec plugin = make_plugin(
      "p", "p",
      {{"n", " 2.5 "}, {"bad", "2.5x"}, {"i", "2.5"}, {"v", "1 2"}, {"f", "maybe"}, {"e", ""}});
  const PluginParams params(plugin.params, "owner");
  EXPECT_DOUBLE_EQ(params.number("n", 0.0), 2.5);
  EXPECT_DOUBLE_EQ(params.number("absent", 7.0), 7.0);
  EXPECT_TRUE(contains(error_of([&] { params.number("bad", 0.0); }), "<bad> is '2.5x'"));
  EXPECT_TRUE(contains(error_of([&] { params.number("n", 0.0, {0.0, 1.0}); }), "in [0, 1]"));
  EXPECT_TRUE(contains(error_of([&] { params.integer("i", 0); }), "a whole number"));
  EXPECT_TRUE(contains(error_of([&] { params.vector3("v", {0, 0, 0}); }), "three finite numbers"));
  EXPECT_TRUE(contains(error_of([&] { params.flag("f", false); }), "true or false"));
  EXPECT_TRUE(contains(error_of([&] { params.required_text("e"); }), "<e> is missing or empty"));
}

}  // namespace
}  // namespace trident::sim
