// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

const char kBoxLink[] =
    "<link name='link'><inertial><mass>2</mass></inertial>"
    "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision></link>";

std::string world_text(const std::string& content, const std::string& version = "1.6") {
  return "<?xml version='1.0'?>\n<sdf version='" + version + "'><world name='w'>" + content +
         "</world></sdf>";
}

WorldSpec load(const std::string& xml, std::vector<std::string>* warnings = nullptr,
               const std::vector<std::string>& folders = {}) {
  return load_world_string(xml, "test.world", Resources(folders), [&](const std::string& text) {
    if (warnings != nullptr) warnings->push_back(text);
  });
}

class SdfVersion : public testing::TestWithParam<const char*> {};

TEST_P(SdfVersion, MinimalWorldLoads) {
  const WorldSpec world = load(
      world_text("<model name='m'><pose>1 2 3 0 0 1.5</pose>" + std::string(kBoxLink) + "</model>",
                 GetParam()));
  ASSERT_EQ(world.models.size(), 1u);
  EXPECT_EQ(world.name, "w");
  EXPECT_TRUE(
      is_near(world.models[0].T_world_model, SE3::from_xyz_rpy({1, 2, 3}, 0, 0, 1.5), 1e-9));
  ASSERT_EQ(world.models[0].links.size(), 1u);
  EXPECT_DOUBLE_EQ(world.models[0].links[0].inertial.mass_kg, 2.0);
  const auto& box = std::get<BoxShape>(world.models[0].links[0].collisions[0].shape);
  EXPECT_EQ(box.size, Eigen::Vector3d(1, 2, 3));
}
INSTANTIATE_TEST_SUITE_P(All, SdfVersion,
                         testing::Values("1.4", "1.5", "1.6", "1.7", "1.8", "1.9"));

TEST(SdfWorld, PhysicsIsRead) {
  const PhysicsSpec physics = load(world_text(R"(
    <physics type='ode'><max_step_size>0.004</max_step_size><real_time_factor>2</real_time_factor>
      <real_time_update_rate>250</real_time_update_rate><max_contacts>7</max_contacts>
      <ode><solver><type>world</type><iters>12</iters><sor>1.1</sor></solver>
      <constraints><cfm>0.001</cfm><erp>0.3</erp><contact_max_correcting_vel>5</contact_max_correcting_vel>
      <contact_surface_layer>0.002</contact_surface_layer></constraints></ode></physics>
    <gravity>0 1 -9</gravity>)"))
                                  .physics;
  EXPECT_DOUBLE_EQ(physics.max_step_size_s, 0.004);
  EXPECT_DOUBLE_EQ(physics.real_time_factor, 2.0);
  EXPECT_DOUBLE_EQ(physics.real_time_update_rate_hz, 250.0);
  EXPECT_EQ(physics.max_contacts, 7);
  EXPECT_EQ(physics.solver, "world");
  EXPECT_EQ(physics.iterations, 12);
  EXPECT_DOUBLE_EQ(physics.sor, 1.1);
  EXPECT_DOUBLE_EQ(physics.cfm, 0.001);
  EXPECT_DOUBLE_EQ(physics.erp, 0.3);
  EXPECT_DOUBLE_EQ(physics.contact_max_correcting_vel, 5.0);
  EXPECT_DOUBLE_EQ(physics.contact_surface_layer, 0.002);
  EXPECT_EQ(physics.gravity, Eigen::Vector3d(0, 1, -9));
}

TEST(SdfWorld, OldWorldsHaveGravityInPhysics) {
  const WorldSpec world =
      load(world_text("<physics type='ode'><gravity>0 0 -3</gravity></physics>", "1.4"));
  EXPECT_EQ(world.physics.gravity, Eigen::Vector3d(0, 0, -3));
}

TEST(SdfWorld, DefaultsAreThoseOfGazebo) {
  const PhysicsSpec physics = load(world_text("")).physics;
  EXPECT_DOUBLE_EQ(physics.max_step_size_s, 0.001);
  EXPECT_EQ(physics.gravity, Eigen::Vector3d(0, 0, -9.8));
  EXPECT_EQ(physics.solver, "quick");
}

TEST(SdfWorld, SurfaceIsRead) {
  const WorldSpec world = load(world_text(R"(<model name='m'><link name='l'><collision name='c'>
    <geometry><sphere><radius>0.5</radius></sphere></geometry>
    <surface><friction><ode><mu>0.4</mu><mu2>0.3</mu2><slip1>0.1</slip1><fdir1>1 0 0</fdir1></ode></friction>
    <bounce><restitution_coefficient>0.7</restitution_coefficient><threshold>0.01</threshold></bounce>
    <contact><collide_bitmask>3</collide_bitmask><ode><kp>1e5</kp><kd>10</kd>
    <min_depth>0.003</min_depth><max_vel>0.1</max_vel></ode></contact></surface>
    </collision></link></model>)"));
  const Surface& surface = world.models[0].links[0].collisions[0].surface;
  EXPECT_DOUBLE_EQ(surface.mu, 0.4);
  EXPECT_DOUBLE_EQ(surface.mu2, 0.3);
  EXPECT_DOUBLE_EQ(surface.slip1, 0.1);
  EXPECT_EQ(surface.fdir1, Eigen::Vector3d(1, 0, 0));
  EXPECT_DOUBLE_EQ(surface.restitution, 0.7);
  EXPECT_DOUBLE_EQ(surface.bounce_threshold_m_s, 0.01);
  EXPECT_DOUBLE_EQ(surface.kp_n_m, 1e5);
  EXPECT_DOUBLE_EQ(surface.kd_ns_m, 10.0);
  EXPECT_EQ(surface.collide_bitmask, 3u);
  EXPECT_EQ(surface.min_depth_m, 0.003);
  EXPECT_EQ(surface.max_vel_m_s, 0.1);
}

TEST(SdfWorld, ContactsAreCorrectedAsInGazeboByDefault) {
  const auto surface_with = [](const std::string& contact) {
    return load(world_text("<model name='m'><link name='l'><collision name='c'><geometry><sphere>"
                           "<radius>0.5</radius></sphere></geometry><surface><contact><ode>" +
                           contact + "</ode></contact></surface></collision></link></model>"))
        .models[0]
        .links[0]
        .collisions[0]
        .surface;
  };
  EXPECT_EQ(surface_with("<kp>1e5</kp>").min_depth_m, 0.0);
  EXPECT_EQ(surface_with("<kp>1e5</kp>").max_vel_m_s, 0.01);
  EXPECT_GT(surface_with("<max_vel>-1</max_vel>").max_vel_m_s, 1e9) << "as the world says";
}

TEST(SdfWorld, AllShapesAreRead) {
  const char* shapes[] = {"<cylinder><radius>1</radius><length>2</length></cylinder>",
                          "<capsule><radius>1</radius><length>2</length></capsule>",
                          "<plane><normal>0 1 0</normal></plane>"};
  std::string model = "<model name='m'><static>true</static><link name='l'>";
  int number = 0;
  for (const char* shape : shapes) {
    model += "<collision name='c" + std::to_string(number++) + "'><geometry>" + shape +
             "</geometry></collision>";
  }
  const WorldSpec world = load(world_text(model + "</link></model>", "1.9"));
  const auto& collisions = world.models[0].links[0].collisions;
  ASSERT_EQ(collisions.size(), 3u);
  EXPECT_DOUBLE_EQ(std::get<CylinderShape>(collisions[0].shape).length, 2.0);
  EXPECT_DOUBLE_EQ(std::get<CapsuleShape>(collisions[1].shape).radius, 1.0);
  EXPECT_EQ(std::get<PlaneShape>(collisions[2].shape).normal, Eigen::Vector3d(0, 1, 0));
}

TEST(SdfWorld, IncludeFindsModelsAndOverridesNameAndPose) {
  const ScratchFolder folder;
  folder.write("crate/model.config",
               "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
  folder.write("crate/model.sdf", "<sdf version='1.6'><model name='crate'>" +
                                      std::string(kBoxLink) + "</model></sdf>");
  const WorldSpec world =
      load(world_text(
               "<include><uri>model://crate</uri><name>one</name><pose>5 0 0 0 0 0</pose></include>"
               "<include><uri>model://crate</uri><static>true</static></include>"),
           nullptr, {folder.path()});
  ASSERT_EQ(world.models.size(), 2u);
  EXPECT_EQ(world.models[0].name, "one");
  EXPECT_TRUE(is_near(world.models[0].T_world_model, at(5, 0, 0), 1e-12));
  EXPECT_EQ(world.models[1].name, "crate");
  EXPECT_TRUE(world.models[1].is_static);
}

TEST(SdfWorld, AMissingIncludeIsAWarningAndTheRestLoads) {
  std::vector<std::string> warnings;
  const WorldSpec world =
      load(world_text("<include><uri>model://no_such_model</uri></include><model name='m'>" +
                      std::string(kBoxLink) + "</model>"),
           &warnings);
  EXPECT_EQ(world.models.size(), 1u);
  ASSERT_FALSE(warnings.empty());
  EXPECT_TRUE(contains(warnings[0], "no_such_model"));
}

TEST(SdfWorld, PluginsKeepTheirElements) {
  const WorldSpec world = load(world_text(
      "<plugin name='p' filename='libp.so'><a>1</a><b><c key='v'> text </c></b></plugin>"));
  ASSERT_EQ(world.plugins.size(), 1u);
  EXPECT_EQ(world.plugins[0].filename, "libp.so");
  EXPECT_EQ(world.plugins[0].params.find("a")->text, "1");
  const ParamNode* c = world.plugins[0].params.find("b")->find("c");
  ASSERT_NE(c, nullptr);
  EXPECT_EQ(c->attributes.at(0).second, "v");
}

TEST(SdfWorld, SphericalCoordinatesAreRead) {
  const WorldSpec world = load(world_text(
      "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>"
      "<latitude_deg>47.3</latitude_deg><longitude_deg>8.5</longitude_deg>"
      "<elevation>500</elevation><heading_deg>10</heading_deg></spherical_coordinates>"));
  EXPECT_NEAR(world.spherical.latitude_deg, 47.3, 1e-9);
  EXPECT_NEAR(world.spherical.longitude_deg, 8.5, 1e-9);
  EXPECT_NEAR(world.spherical.elevation_m, 500.0, 1e-9);
  EXPECT_NEAR(world.spherical.heading_deg, 10.0, 1e-9);
}

TEST(SdfWorld, FilesAreFoundAndNamedInErrors) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.world", world_text("<model name='m'/>"));
  const auto load_file = [](const std::string& file) {
    load_world_file(file, Resources(), [](const std::string&) {});
  };
  EXPECT_TRUE(contains(error_of([&] { load_file(path); }), "a.world"));
  EXPECT_TRUE(contains(error_of([&] { load_file("/no/such.world"); }), "/no/such.world"));
}

}  // namespace
}  // namespace trident::sim
