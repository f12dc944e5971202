// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Materials, lights, scene and sensors of SDF files.
#include <gtest/gtest.h>

#include <fstream>

#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

WorldSpec load_looks(const std::string& content, std::vector<std::string>* warnings = nullptr,
                     const std::vector<std::string>& folders = {}) {
  return load_world_string("<sdf version='1.6'><world name='w'>" + content + "</world></sdf>",
                           "test.world", Resources(folders), [&](const std::string& text) {
                             if (warnings != nullptr) warnings->push_back(text);
                           });
}

std::string with_link(const std::string& content) {
  return "<model name='m'><static>true</static><link name='l'>" + content + "</link></model>";
}

VisualSpec visual_of(const std::string& content, std::vector<std::string>* warnings = nullptr,
                     const std::vector<std::string>& folders = {}) {
  const WorldSpec world =
      load_looks(with_link("<visual name='v'><geometry><box><size>1 1 1</size></box></geometry>" +
                           content + "</visual>"),
                 warnings, folders);
  return world.models.at(0).links.at(0).visuals.at(0);
}

SensorSpec sensor_of(const std::string& content) {
  return load_looks(with_link(content)).models.at(0).links.at(0).sensors.at(0);
}

TEST(SdfLook, AVisualWithoutMaterialIsGray) {
  const VisualSpec visual = visual_of("");
  EXPECT_FALSE(visual.material.is_given);
  EXPECT_EQ(visual.material.diffuse, Eigen::Vector4d(0.7, 0.7, 0.7, 1.0));
  EXPECT_TRUE(visual.casts_shadows);
  EXPECT_EQ(visual.transparency, 0.0);
}

TEST(SdfLook, ColorsAreRead) {
  const VisualSpec visual = visual_of(
      "<transparency>0.25</transparency><cast_shadows>0</cast_shadows>"
      "<material><ambient>0.1 0.2 0.3 1</ambient><diffuse>0.4 0.5 0.6 1</diffuse>"
      "<emissive>0 0.5 0 1</emissive></material>");
  EXPECT_TRUE(visual.material.is_given);
  EXPECT_TRUE(visual.material.ambient.isApprox(Eigen::Vector4d(0.1, 0.2, 0.3, 1.0), 1e-6));
  EXPECT_TRUE(visual.material.diffuse.isApprox(Eigen::Vector4d(0.4, 0.5, 0.6, 1.0), 1e-6));
  EXPECT_TRUE(visual.material.emissive.isApprox(Eigen::Vector4d(0.0, 0.5, 0.0, 1.0), 1e-6));
  EXPECT_DOUBLE_EQ(visual.transparency, 0.25);
  EXPECT_FALSE(visual.casts_shadows);
}

TEST(SdfLook, ScriptNamesOfGazeboAreColors) {
  const VisualSpec visual =
      visual_of("<material><script><name>Gazebo/Orange</name></script></material>");
  EXPECT_EQ(visual.material.script, "Gazebo/Orange");
  EXPECT_TRUE(visual.material.diffuse.isApprox(Eigen::Vector4d(1.0, 0.5088, 0.0468, 1.0), 1e-6));
}

TEST(SdfLook, AnUnknownScriptIsOneWarningUnlessAColorIsGiven) {
  std::vector<std::string> warnings;
  visual_of("<material><script><name>Mine/Shiny</name></script></material>", &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "link 'l' visual 'v': material script 'Mine/Shiny'"));
  warnings.clear();
  const VisualSpec visual = visual_of(
      "<material><script><name>Mine/Shiny</name></script><diffuse>1 0 0 1</diffuse></material>",
      &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(visual.material.diffuse.x(), 1.0);
}

TEST(SdfLook, ATextureIsFoundOrMissedAloud) {
  const ScratchFolder folder;
  std::ofstream(folder.path() + "/wall.png") << "x";
  const std::string material =
      "<material><pbr><metal><albedo_map>wall.png</albedo_map></metal></pbr></material>";
  std::vector<std::string> warnings;
  EXPECT_EQ(visual_of(material, &warnings, {folder.path()}).material.texture_file,
            folder.path() + "/wall.png");
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(visual_of(material, &warnings).material.texture_file, "");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "test.world:1: link 'l' visual 'v': texture 'wall.png' not "));
}

TEST(SdfLook, AMaterialScriptThatIsNotFoundIsReportedWithItsLine) {
  std::vector<std::string> warnings;
  visual_of("\n<material><script><name>no_such_material</name></script></material>", &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(
      warnings[0], "test.world:2: link 'l' visual 'v': material script 'no_such_material' is "));
}

TEST(SdfLook, LightsAndSceneAreRead) {
  const WorldSpec world = load_looks(
      "<light name='sun' type='directional'><pose>0 0 10 0 0 0</pose><diffuse>0.8 0.8 0.7 "
      "1</diffuse>"
      "<direction>0 3 -4</direction><cast_shadows>1</cast_shadows></light>"
      "<light name='lamp' type='point'><attenuation><range>7</range><quadratic>0.1</quadratic>"
      "</attenuation></light>"
      "<scene><ambient>0.2 0.2 0.2 1</ambient><background>0.5 0.6 0.9 1</background>"
      "<shadows>0</shadows></scene>");
  ASSERT_EQ(world.lights.size(), 2u);
  EXPECT_EQ(world.lights[0].name, "sun");
  EXPECT_EQ(world.lights[0].type, LightType::kDirectional);
  EXPECT_TRUE(world.lights[0].direction_light.isApprox(Eigen::Vector3d(0.0, 0.6, -0.8)));
  EXPECT_TRUE(world.lights[0].casts_shadows);
  EXPECT_EQ(world.lights[1].type, LightType::kPoint);
  EXPECT_DOUBLE_EQ(world.lights[1].range_m, 7.0);
  EXPECT_NEAR(world.lights[1].attenuation_quadratic, 0.1, 1e-6);
  EXPECT_NEAR(world.scene.background.z(), 0.9, 1e-6);
  EXPECT_FALSE(world.scene.shadows);
}

TEST(SdfSensor, IsReadWithItsElementsAndPlugins) {
  const SensorSpec sensor = sensor_of(
      "<sensor name='laser' type='ray'><pose>0.1 0 0.2 0 0 0</pose><update_rate>10</update_rate>"
      "<always_on>1</always_on><ray><scan><horizontal><samples>360</samples></horizontal></scan>"
      "<range><min>0.1</min><max>12</max></range></ray>"
      "<plugin name='p' filename='libgazebo_ros_laser.so'><topicName>scan</topicName></plugin>"
      "</sensor>");
  EXPECT_EQ(sensor.name, "laser");
  EXPECT_EQ(sensor.type, "ray");
  EXPECT_DOUBLE_EQ(sensor.update_rate_hz, 10.0);
  EXPECT_TRUE(sensor.always_on);
  EXPECT_TRUE(sensor.T_link_sensor.p.isApprox(Eigen::Vector3d(0.1, 0.0, 0.2)));
  const ParamNode* const ray = sensor.params.find("ray");
  ASSERT_NE(ray, nullptr);
  EXPECT_EQ(ray->find("scan")->find("horizontal")->find("samples")->text, "360");
  EXPECT_EQ(sensor.params.find("plugin"), nullptr);
  ASSERT_EQ(sensor.plugins.size(), 1u);
  EXPECT_EQ(sensor.plugins[0].filename, "libgazebo_ros_laser.so");
}

TEST(SdfSensor, ANegativeRateIsRefused) {
  const std::string error = error_of(
      [] { sensor_of("<sensor name='s' type='imu'><update_rate>-3</update_rate></sensor>"); });
  EXPECT_TRUE(contains(error, "link 'l' sensor 's': <update_rate> is -3")) << error;
}

TEST(SdfSensor, APluginOfASensorKnowsItAndItsLink) {
  struct Seen {
    std::string name, sensor, link, model_namespace;
    bool has_ray = false;
  } seen;
  struct Silent : Plugin {
    std::vector<Phase> phases() const override { return {}; }
  };
  PluginRegistry registry;
  registry.add("libprobe.so", {[&seen](const PluginContext& context) {
                                 seen = {context.name, context.sensor->name, context.link->name,
                                         context.params.text("robotNamespace", ""),
                                         context.sensor->params.find("ray") != nullptr};
                                 return std::make_unique<Silent>();
                               },
                               {}});
  const WorldSpec spec = load_looks("");
  World world(spec, Resources(std::vector<std::string>()), registry, {});
  SpawnRequest request;
  request.name = "robot";
  request.robot_namespace = "/r1";
  request.xml =
      "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' "
      "izz='1'"
      " ixy='0' ixz='0' iyz='0'/></inertial></link><gazebo reference='base'>"
      "<sensor name='laser' type='ray'><ray><range><max>5</max></range></ray>"
      "<plugin name='p' filename='libprobe.so'/></sensor></gazebo></robot>";
  world.spawn(request);
  EXPECT_EQ(seen.name, "robot::base::laser::p");
  EXPECT_EQ(seen.sensor, "laser");
  EXPECT_EQ(seen.link, "base");
  EXPECT_EQ(seen.model_namespace, "/r1");
  EXPECT_TRUE(seen.has_ray);
}

}  // namespace
}  // namespace trident::sim
