// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Worlds and models with an element that cannot be used: refused, or loaded without it.
#include <gtest/gtest.h>

#include "models.h"
#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

const char kBall[] =
    "<link name='l'><collision name='c'><geometry><sphere><radius>0.1</radius></sphere>"
    "</geometry></collision></link>\n";
const char kGround[] =
    "<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane>"
    "<normal>0 0 1</normal><size>9 9</size></plane></geometry></collision></link></model>\n";

std::string ball(const std::string& name, const std::string& more = "") {
  return "<model name='" + name + "'>" + more + kBall + "</model>\n";
}

/// Line 1 is <sdf>, line 2 what `content` begins with.
std::string in_world(const std::string& content) {
  return "<sdf version='1.6'><world name='w'>\n" + content + "</world></sdf>";
}

WorldSpec load(const std::string& xml, OddElements odd, const Resources& resources = Resources()) {
  return load_world_string(
      xml, "odd.world", resources, [](const auto&) {}, odd);
}

/// Loads it in both modes: strictly it must throw, else one odd element is reported; returns it.
std::string odd_element_of(const std::string& xml, WorldSpec* spec = nullptr,
                           const Resources& resources = Resources()) {
  error_of([&] { load(xml, OddElements::kRefuse, resources); });
  const WorldSpec loaded = load(xml, OddElements::kLeaveOut, resources);
  if (spec != nullptr) *spec = loaded;
  EXPECT_EQ(loaded.odd_elements.size(), 1u) << testing::PrintToString(loaded.odd_elements);
  return loaded.odd_elements.empty() ? "" : loaded.odd_elements[0];
}

TEST(OddElements, AWorldWithoutAnyHasNone) {
  const WorldSpec world = load(in_world(ball("a") + kGround), OddElements::kLeaveOut);
  EXPECT_EQ(world.models.size(), 2u);
  EXPECT_TRUE(world.odd_elements.empty());
}

TEST(OddElements, ACollisionWhoseMeshIsMissingIsLeftOut) {
  WorldSpec world;
  const std::string odd = odd_element_of(
      in_world(
          "<model name='plant'><static>1</static><link name='l'>\n"
          "<collision name='c'><geometry><mesh><uri>model://plant/p.dae</uri></mesh></geometry>"
          "</collision></link></model>" +
          ball("a")),
      &world);
  EXPECT_TRUE(
      contains(odd, "odd.world:3: link 'l' collision 'c': mesh 'model://plant/p.dae' not "));
  EXPECT_TRUE(contains(odd, "; searched: "));
  EXPECT_TRUE(contains(odd, "; left out"));
  ASSERT_EQ(world.models.size(), 2u);
  EXPECT_TRUE(world.models[0].links[0].collisions.empty());
}

TEST(OddElements, ACollisionWithAShapeThatIsNotSimulatedIsLeftOut) {
  for (const char* shape :
       {"<cone><radius>1</radius></cone>", "<ellipsoid><radii>1 2 3</radii></ellipsoid>",
        "<image><uri>map.png</uri></image>"}) {
    WorldSpec world;
    const std::string odd = odd_element_of(
        in_world("<model name='m'><link name='l'>\n<collision name='c'><geometry>" +
                 std::string(shape) + "</geometry></collision></link></model>" + ball("a")),
        &world);
    const std::string name(shape, std::string(shape).find('>') + 1);
    EXPECT_TRUE(contains(odd, "odd.world:3: link 'l' collision 'c': <geometry> has " + name));
    EXPECT_TRUE(contains(odd, "simulated are box, sphere, "));
    ASSERT_EQ(world.models.size(), 2u);
    EXPECT_TRUE(world.models[0].links[0].collisions.empty());
  }
}

TEST(OddElements, AVisualWithAShapeThatIsNotSimulatedIsSaid) {
  std::vector<std::string> said;
  load_world_string(
      in_world(
          "<model name='m'><link name='l'>\n<visual name='v'><geometry><cone/></geometry>"
          "</visual><visual name='none'><geometry><empty/></geometry></visual></link></model>"),
      "odd.world", Resources(), [&](const auto& text) { said.push_back(text); },
      OddElements::kRefuse);
  ASSERT_EQ(said.size(), 1u) << testing::PrintToString(said);
  EXPECT_TRUE(contains(said[0], "odd.world:3: link 'l' visual 'v': <geometry> has <cone>"));
}

TEST(OddElements, AValueBeyondTheSpecificationIsLeftOut) {
  WorldSpec world;
  const std::string odd =
      odd_element_of(in_world("<scene><ambient>0.2 0.3 0.4 1</ambient><sky><clouds>\n"
                              "<speed>-4</speed></clouds></sky></scene>" +
                              ball("a")),
                     &world);
  EXPECT_TRUE(contains(odd, "odd.world:3: <speed> is '-4', legal: double, at least 0"));
  EXPECT_NEAR(world.scene.ambient.x(), 0.2, 1e-6);
  EXPECT_EQ(world.models.size(), 1u);
}

TEST(OddElements, TextInPlaceOfNumbersIsLeftOut) {
  WorldSpec world;
  const std::string odd =
      odd_element_of(in_world(ball("a", "<pose>\n1 2 north</pose>") + ball("b")), &world);
  EXPECT_TRUE(contains(odd, "odd.world:2: <pose> is '1 2 north', legal: pose"));
  EXPECT_TRUE(is_near(world.models[0].T_world_model, SE3::identity(), 1e-12));
}

TEST(OddElements, ASecondModelOfANameGetsOneOfItsOwn) {
  WorldSpec world;
  const std::string odd =
      odd_element_of(in_world(ball("a") + ball("a", "<pose>3 0 0 0 0 0</pose>")), &world);
  EXPECT_TRUE(contains(odd, "odd.world:4: another <model> is named 'a'; this one is called 'a_1'"));
  ASSERT_EQ(world.models.size(), 2u);
  EXPECT_EQ(world.models[1].name, "a_1");
  EXPECT_DOUBLE_EQ(world.models[1].T_world_model.p.x(), 3.0);
}

TEST(OddElements, AModelWithoutLinksIsLeftOut) {
  WorldSpec world;
  const std::string odd = odd_element_of(in_world("<model name='e'></model>" + ball("a")), &world);
  EXPECT_TRUE(contains(odd, "odd.world:2: model 'e' has no link; left out"));
  EXPECT_EQ(world.models.size(), 1u);
}

TEST(OddElements, AJointThatNamesNoLinkIsLeftOut) {
  WorldSpec world;
  const std::string odd = odd_element_of(
      in_world(ball("a",
                    "<joint name='j' type='fixed'><parent>l</parent><child>gone</child>"
                    "</joint>") +
               ball("b")),
      &world);
  EXPECT_TRUE(contains(odd, "gone"));
  ASSERT_EQ(world.models.size(), 2u);
  EXPECT_TRUE(world.models[0].joints.empty());
}

TEST(OddElements, AJointWithoutAParentIsLeftOut) {
  WorldSpec world;
  const std::string odd = odd_element_of(
      in_world(ball("a", "<joint name='j' type='fixed'><child>l</child></joint>")), &world);
  EXPECT_TRUE(contains(odd, "odd.world:2: <joint>: XML Missing required element[parent]"));
  EXPECT_EQ(world.models.size(), 1u);
}

TEST(OddElements, AnIncludeThatIsNotFoundIsLeftOutAndReportedWithWhereItWasSearched) {
  const std::string xml = in_world("<include><uri>model://nowhere</uri></include>" + ball("a"));
  const WorldSpec world = load(xml, OddElements::kLeaveOut);
  ASSERT_EQ(world.odd_elements.size(), 1u);
  EXPECT_TRUE(contains(world.odd_elements[0],
                       "odd.world:2: <include> of 'model://nowhere' not found; searched: "));
  std::vector<std::string> warnings;
  load_world_string(xml, "odd.world", Resources(),
                    [&](const std::string& text) { warnings.push_back(text); });
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "odd.world:2: <include> of 'model://nowhere' not found"));
}

TEST(OddElements, AModelOfOneIncludeThatIsNotFoundIsReportedOnce) {
  WorldSpec world;
  const std::string lost = "<include><uri>model://nowhere</uri></include>";
  std::string odd =
      odd_element_of(in_world(ball("a") + "<model name='m'>\n" + lost + "</model>"), &world);
  EXPECT_TRUE(contains(odd, "odd.world:5: <include> of 'model://nowhere' not found")) << odd;
  EXPECT_EQ(world.models.size(), 1u);
  odd = odd_element_of(
      in_world(ball("a") + "<model name='m'><model name='n'>\n" + lost + "</model></model>"));
  EXPECT_TRUE(contains(odd, "<include> of 'model://nowhere' not found")) << odd;
}

std::string mesh(const std::string& tag, const std::string& name, const std::string& uri) {
  return "<" + tag + " name='" + name + "'><geometry><mesh><uri>" + uri +
         "</uri></mesh></geometry></" + tag + ">\n";
}

TEST(OddElements, AMissingMeshIsReportedOnceWithItsFirstPlaceAndCountedEverywhere) {
  const std::string uri = "model://gone/a.dae";
  std::vector<std::string> warnings;
  const WorldSpec spec = load_world_string(
      in_world("<model name='m'><static>1</static><link name='l'>\n" + mesh("visual", "v", uri) +
               mesh("collision", "c", uri) + mesh("collision", "d", uri) +
               mesh("visual", "w", "model://gone/look.dae") +
               mesh("visual", "x", "model://gone/look.dae") + "</link></model>" + ball("a")),
      "odd.world", Resources(), [&](const std::string& text) { warnings.push_back(text); },
      OddElements::kLeaveOut);
  ASSERT_EQ(spec.odd_elements.size(), 1u);
  EXPECT_TRUE(contains(spec.odd_elements[0],
                       "odd.world:4: link 'l' collision 'c': mesh 'model://gone/a.dae' not found; "
                       "searched: "));
  EXPECT_TRUE(contains(spec.odd_elements[0], "left out; used in 3 places"));
  ASSERT_EQ(spec.odd_repeats.size(), 1u);
  EXPECT_TRUE(contains(spec.odd_repeats[0], "odd.world:5: link 'l' collision 'd'"));
  EXPECT_EQ(warnings, std::vector<std::string>{
                          "odd.world:6: link 'l' visual 'w': mesh 'model://gone/look.dae' not "
                          "found; shown without it; used in 2 places"});
  PluginRegistry registry;
  std::vector<std::string> reported;
  WorldOptions options;
  options.odd_elements = OddElements::kLeaveOut;
  options.report = [&](Severity, const std::string& text) { reported.push_back(text); };
  const World world(spec, Resources(), registry, options);
  EXPECT_EQ(reported, spec.odd_elements);
  EXPECT_EQ(world.odd_elements().size(), 2u);
}

TEST(OddElements, OfAnIncludedFileAreReportedWithThatFile) {
  const ScratchFolder folder;
  folder.write("crate/model.config",
               "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
  const std::string file = folder.write("crate/model.sdf",
                                        "<sdf version='1.6'>\n<model name='crate'>\n<static>maybe"
                                        "</static>" +
                                            std::string(kBall) + "</model></sdf>");
  WorldSpec world;
  const std::string odd =
      odd_element_of(in_world("<include><uri>model://crate</uri><name>box</name></include>"),
                     &world, Resources({folder.path()}));
  EXPECT_TRUE(contains(odd, file + ":3: <static> is 'maybe', legal: bool"));
  ASSERT_EQ(world.models.size(), 1u);
  EXPECT_EQ(world.models[0].name, "box");
}

TEST(OddElements, OfAnIncludedFileAreLeftOutThoughAPluginInItSpeaksOfARobot) {
  const ScratchFolder folder;
  folder.write("crate/model.config",
               "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
  const std::string file = folder.write(
      "crate/model.sdf",
      "<sdf version='1.6'><model name='crate'>\n<static>maybe</static>" + std::string(kBall) +
          "<plugin name='p' filename='libp.so'><robotNamespace>a</robotNamespace></plugin>"
          "</model></sdf>");
  WorldSpec world;
  const std::string odd = odd_element_of(in_world("<include><uri>model://crate</uri></include>"),
                                         &world, Resources({folder.path()}));
  EXPECT_TRUE(contains(odd, file + ":2: <static> is 'maybe', legal: bool"));
  EXPECT_EQ(world.models.size(), 1u);
}

TEST(OddElements, IncludesOfIncludedFilesAreFound) {
  const ScratchFolder folder;
  const auto write = [&](const std::string& name, const std::string& content) {
    folder.write(name + "/model.config",
                 "<model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>");
    folder.write(name + "/model.sdf",
                 "<sdf version='1.6'><model name='" + name + "'>" + content + "</model></sdf>");
  };
  write("wheel", kBall);
  write("cart", kBall + std::string("<include><uri>model://wheel</uri></include>"));
  const WorldSpec world = load(in_world("<include><uri>model://cart</uri></include>"),
                               OddElements::kRefuse, Resources({folder.path()}));
  ASSERT_EQ(world.models.size(), 1u);
  ASSERT_EQ(world.models[0].links.size(), 2u);
  EXPECT_EQ(world.models[0].links[1].name, "wheel::l");
}

TEST(OddElements, ASpawnedModelLoadsWithoutThem) {
  TestWorld strict;
  WorldOptions lenient_options;
  lenient_options.odd_elements = OddElements::kLeaveOut;
  TestWorld lenient(world_spec(), lenient_options);
  SpawnRequest request;
  request.name = "m";
  request.xml =
      "<sdf version='1.6'><model name='m'>" + std::string(kBall) +
      "<link name='sign'><collision name='c'><geometry><mesh><uri>model://gone.dae</uri></mesh>"
      "</geometry></collision></link></model></sdf>";
  error_of([&] { strict->spawn(request); });
  EXPECT_EQ(lenient->spawn(request).links.size(), 2u);
  ASSERT_EQ(lenient->odd_elements().size(), 1u);
  EXPECT_EQ(lenient.report_count(Severity::kWarning, "link 'sign' collision 'c'"), 1u);
}

TEST(OddElements, APluginWithABadValueIsLeftOut) {
  ModelSpec spec = make_quad();
  for (ParamNode& node : spec.plugins[1].params.children) {
    if (node.name == "timeConstantUp") node.text = "-3";
  }
  WorldOptions options;
  options.odd_elements = OddElements::kLeaveOut;
  TestWorld world(world_spec(), options);
  const std::size_t all = spec.plugins.size();
  EXPECT_EQ(world.add(spec).plugins.size(), all - 1);
  ASSERT_EQ(world->odd_elements().size(), 1u);
  EXPECT_TRUE(contains(world->odd_elements()[0], "<timeConstantUp> is '-3'"));
}

TEST(OddElements, AMeshThatCannotBeReadIsLeftOutOfItsModel) {
  const ScratchFolder folder;
  const std::string file = folder.write("bad.stl", "no mesh");
  ModelSpec spec = make_body("m", SphereShape{0.1}, {});
  spec.links[0].collisions.push_back({"bad", {}, MeshShape{file, {1, 1, 1}}, {}, {}});
  TestWorld strict;
  error_of([&] { strict.add(spec); });
  WorldOptions options;
  options.odd_elements = OddElements::kLeaveOut;
  TestWorld world(world_spec(), options);
  const Model& model = world.add(spec);
  EXPECT_EQ(model.collision_shapes(*model.links[0]).size(), 1u);
  ASSERT_EQ(world->odd_elements().size(), 1u);
  EXPECT_TRUE(contains(world->odd_elements()[0], "collision 'm::link::bad'"));
}

std::string model_of_mass(const std::string& mass, const std::string& ixx) {
  return in_world("<model name='a'><link name='l'>\n<inertial><pose>0 0 3 0 0 0</pose><mass>" +
                  mass + "</mass><inertia><ixx>" + ixx +
                  "</ixx><iyy>1.5</iyy><izz>1.5</izz></inertia></inertial></link></model>");
}

TEST(OddElements, AnInertiaThatCannotBeIsReplacedAloneAsInGazebo) {
  WorldSpec world;
  const std::string odd = odd_element_of(model_of_mass("2", "0"), &world);
  EXPECT_TRUE(contains(odd, "odd.world:3: link 'l' <inertial>: principal inertia is 0.0"));
  EXPECT_TRUE(contains(odd, "; 1 kg m^2 about each axis is used"));
  ASSERT_EQ(world.models.size(), 1u);
  const Inertial& inertial = world.models[0].links[0].inertial;
  EXPECT_DOUBLE_EQ(inertial.mass_kg, 2.0);
  EXPECT_TRUE(inertial.inertia_com.isIdentity());
  EXPECT_DOUBLE_EQ(inertial.T_link_com.p.z(), 3.0);
}

TEST(OddElements, MomentsOfInertiaThatNoBodyHasAreReportedAndUsed) {
  WorldSpec world;
  const std::string odd = odd_element_of(model_of_mass("2", "15"), &world);
  EXPECT_EQ(odd,
            "odd.world:3: link 'l' <inertial>: principal moments of inertia are 1.5, 1.5 and 15 kg "
            "m^2; of a body none is larger than the sum of the other two; used as it is, as in "
            "Gazebo");
  EXPECT_DOUBLE_EQ(world.models.at(0).links[0].inertial.inertia_com(0, 0), 15.0);
}

TEST(OddElements, AMassThatCannotBeIsReplacedAlone) {
  WorldSpec world;
  const std::string odd = odd_element_of(model_of_mass("-2", "1.5"), &world);
  EXPECT_TRUE(contains(odd, "odd.world:3: link 'l' <inertial>: mass is -2"));
  EXPECT_TRUE(contains(odd, "; 1 kg is used"));
  const Inertial& inertial = world.models.at(0).links[0].inertial;
  EXPECT_DOUBLE_EQ(inertial.mass_kg, 1.0);
  EXPECT_DOUBLE_EQ(inertial.inertia_com(0, 0), 1.5);
}

TEST(OddElements, PhysicsThatCannotBeIsReplacedByTheDefault) {
  const WorldSpec spec = load(in_world("<physics type='ode'><max_contacts>0</max_contacts>"
                                       "<max_step_size>0.002</max_step_size></physics>" +
                                       ball("a")),
                              OddElements::kLeaveOut);
  error_of([&] { TestWorld strict(spec); });
  WorldOptions options;
  options.odd_elements = OddElements::kLeaveOut;
  TestWorld world(spec, options);
  EXPECT_EQ(world->physics().max_contacts, 20);
  EXPECT_DOUBLE_EQ(world->physics().max_step_size_s, 0.002);
  ASSERT_EQ(world->odd_elements().size(), 1u);
  EXPECT_TRUE(
      contains(world->odd_elements()[0], "physics: max_contacts is '0', must be in [1, 100000]"));
}

TEST(OddElements, ScopedNamesThatDoNotFitTogetherAreJoined) {
  // As a world that Gazebo has saved: the frame of a nested model is attached to no part of it.
  WorldSpec world;
  const std::string odd = odd_element_of(
      "<sdf version='1.7'><world name='w'><model name='room'><link name='a::l'/>"
      "<frame name='a::__model__' attached_to='b::l'/><link name='b::l'/></model></world></sdf>",
      &world);
  EXPECT_TRUE(contains(odd, "'a::b' is read as 'a__b'"));
  ASSERT_EQ(world.models.size(), 1u);
  EXPECT_EQ(world.models[0].links.size(), 2u);
}

TEST(OddElements, ADeclarationMayStandBehindALicence) {
  const std::string xml = "<!-- free -->\n<?xml version='1.0'?>\n" + in_world(ball("a") + "<x");
  EXPECT_TRUE(contains(error_of([&] { load(xml, OddElements::kRefuse); }), "odd.world:"))
      << "lines";
  EXPECT_EQ(
      load("<!-- free -->\n<?xml version='1.0'?>\n" + in_world(ball("a")), OddElements::kRefuse)
          .models.size(),
      1u);
}

TEST(OddElements, AScriptThatNamesNoMaterialMeansNothing) {
  const WorldSpec world =
      load(in_world("<model name='a'><static>1</static><link name='l'><visual name='v'><geometry>"
                    "<sphere><radius>1</radius></sphere></geometry><material><script><uri>x</uri>"
                    "</script><diffuse>1 0 0 1</diffuse></material></visual></link></model>"),
           OddElements::kRefuse);
  EXPECT_DOUBLE_EQ(world.models[0].links[0].visuals[0].material.diffuse.x(), 1.0);
}

TEST(OddElements, ADoorOnTwoHingesHasASolutionWithoutConstraintForceMixing) {
  // Each hinge alone would do: ODE ended the process here.
  WorldSpec spec = world_spec();
  spec.physics.solver = "quick";
  spec.physics.cfm = 0.0;
  TestWorld world(spec);
  ModelSpec door = make_on_world(JointType::kRevolute, {1, 0, 0}, {0, 0, 1});
  door.joints.push_back(door.joints[0]);
  door.joints[1].name = "upper";
  door.joints[1].T_model_joint.p.z() += 1.0;
  Model& model = world.add(door);
  world->step(50);
  EXPECT_TRUE(is_near(model.links[0]->T_world_link().p, {1, 0, 0}, 1e-3));
}

/// Of masses [kg] so unlike that the rounding of one is the weight of the other.
WorldSpec unlike_door(double frame_kg, double door_kg) {
  const auto inertial = [](double mass) {
    const std::string inertia = std::to_string(0.01 * mass * 1e9) + "e-9";
    return "<inertial><mass>" + std::to_string(mass * 1e9) + "e-9</mass><inertia><ixx>" + inertia +
           "</ixx><iyy>" + inertia + "</iyy><izz>" + inertia + "</izz></inertia></inertial>";
  };
  const auto hinge = [](const std::string& z) {
    return "<joint name='hinge" + z + "' type='revolute'><pose>0 0 " + z +
           " 0 0 0</pose><parent>frame</parent><child>door</child><axis><xyz>0 0 1</xyz></axis>"
           "</joint>";
  };
  return load(
      in_world("<physics type='ode'><max_step_size>0.01</max_step_size><ode><solver><type>quick"
               "</type></solver><constraints><cfm>0</cfm></constraints></ode></physics>"
               "<model name='m'><link name='frame'>" +
               inertial(frame_kg) + "</link><link name='door'><pose>0.3 0.2 0.5 0.5 0.1 0</pose>" +
               inertial(door_kg) + "</link>" + hinge("0") + hinge("1") + "</model>"),
      OddElements::kRefuse);
}

TEST(OddElements, ALightDoorOnTwoHingesStaysOnThem) {
  // The exact solver has no number for it: ODE ended the process by an assertion.
  TestWorld world(unlike_door(1.0, 1e-6));
  Model& model = *world->find_model("m");
  world->step(100);
  const SE3 T_frame_door =
      model.links[0]->T_world_link().inverse() * model.links[1]->T_world_link();
  EXPECT_TRUE(is_near(T_frame_door.p, {0.3, 0.2, 0.5}, 0.01));
  EXPECT_EQ(world.report_count(Severity::kWarning, "without bound"), 0u);
}

TEST(OddElements, ADoorThatNoSolverCanHoldStandsStillAndIsNamed) {
  TestWorld world(unlike_door(1e6, 1e-9));
  world->step(1000);
  EXPECT_TRUE(world->find_model("m")->links[1]->T_world_link().p.allFinite());
  EXPECT_EQ(world.report_count(Severity::kWarning, "body 'm::door': its state grows without bound"),
            1u);
}

TEST(MissingFloor, IsReportedOnceWhenSomethingHasFallenFar) {
  TestWorld world;
  world.add(make_body("stone", SphereShape{0.1}, at(0, 0, 5)));
  world->step(400);  // 4 s: 78 m
  EXPECT_EQ(world.report_count(Severity::kWarning, "fallen"), 0u);
  world->step(800);
  EXPECT_EQ(world.report_count(Severity::kWarning, "model 'stone' has fallen 100 m"), 1u);
  EXPECT_EQ(world->diagnostics().entries().count("world 'default': no floor"), 1u);
}

TEST(MissingFloor, IsNotReportedWhereThereIsGround) {
  TestWorld world(load(in_world(kGround), OddElements::kRefuse));
  ModelSpec stone = make_body("stone", SphereShape{0.1}, at(0, 0, -1));  // beneath it
  world.add(std::move(stone));
  world->step(2000);
  EXPECT_EQ(world.report_count(Severity::kWarning, "fallen"), 0u);
}

}  // namespace
}  // namespace trident::sim
