// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "plugin_conformance.h"

#include <gtest/gtest.h>

#include <set>

#include "plugin_cases.h"
#include "test_world.h"

namespace trident::sim {
namespace {

class BuiltinPlugin : public testing::TestWithParam<PluginCase> {};
void PrintTo(const PluginCase& plugin, std::ostream* out) { *out << plugin.filename; }

TEST_P(BuiltinPlugin, Conforms) { expect_plugin_conforms(GetParam()); }
INSTANTIATE_TEST_SUITE_P(All, BuiltinPlugin, testing::ValuesIn(builtin_plugin_cases()));

TEST(BuiltinPlugins, AllHaveAnExample) {
  PluginRegistry registry;
  register_builtin_plugins(registry);
  std::set<std::string> without;
  for (const std::string& name : registry.names()) {
    if (!registry.find(name)->example) without.insert(name);
  }
  // Three do nothing here: ROS is bound by the server, bags are written by rosbag, the true state
  // is sent by libgazebo_mavlink_interface.so. The others have no port with numbers, or want a file
  // or elements in elements; their tests are follow_test.cpp,
  // marine/{buoyancy,mooring,sea_plugin,usv_plugins,uuv_plugins,vessel_plugin,wind_on_vehicles}_test.cpp,
  // comms/radio_plugins_test.cpp and trident_description's test_vessels.py.
  const std::set<std::string> expected{"rotors_gazebo_ros_interface_plugin",
                                       "rotors_gazebo_bag_plugin",
                                       "gazebo_groundtruth_plugin",
                                       "trident_follow",
                                       "trident_mooring",
                                       "trident_radio",
                                       "trident_radio_medium",
                                       "trident_sea",
                                       "trident_environment",
                                       "trident_vessel",
                                       "WavefieldModelPlugin",
                                       "wavefield_model_plugin",
                                       "usv_gazebo_dynamics_plugin",
                                       "usv_gazebo_thrust_plugin",
                                       "usv_gazebo_wind_plugin",
                                       "buoyancy_gazebo_plugin",
                                       "uuv_thruster_ros_plugin",
                                       "uuv_underwater_object_ros_plugin",
                                       "freefloating_gazebo_control",
                                       "freefloating_gazebo_fluid"};
  EXPECT_EQ(without, expected);
}

TEST(BuiltinPlugins, EnumeratedValuesAreRefusedWithTheLegalOnes) {
  const auto refusal = [](const std::string& filename, ParamList params, const std::string& key,
                          const std::string& value) {
    params.emplace(params.begin(), key, value);
    TestWorld world;
    ModelSpec spec = make_quad();
    spec.plugins = {make_plugin("case", filename, params)};
    return error_of([&] { world.add(std::move(spec)); });
  };
  const ParamList motor = motor_params({}, 1);
  EXPECT_TRUE(
      contains(refusal("librotors_gazebo_motor_model.so", motor, "turningDirection", "left"),
               "<turningDirection> is 'left', expected cw or ccw"));
  EXPECT_TRUE(contains(refusal("librotors_gazebo_motor_model.so", motor, "motorType", "steam"),
                       "<motorType> is 'steam', expected velocity"));
  EXPECT_TRUE(contains(refusal("librotors_gazebo_motor_model.so", motor, "motorNumber", "99"),
                       "in [0, 31]"));
  EXPECT_TRUE(contains(refusal("librotors_gazebo_motor_model.so", motor, "jointName", "elbow"),
                       "a joint of the model: rotor_0_joint"));
  const ParamList base{{"robotNamespace", "ns"}, {"linkName", "base_link"}};
  ParamList windy = base;
  windy.emplace_back("windSpeedMean", "3");
  EXPECT_TRUE(contains(refusal("librotors_gazebo_wind_plugin.so", windy, "windDirection", "0 0 0"),
                       "a vector that is not zero"));
  EXPECT_TRUE(contains(
      refusal("librotors_gazebo_odometry_plugin.so", base, "noiseNormalPosition", "-1 0 0"),
      "values >= 0"));
}

TEST(PluginRegistry, FoldersPrefixAndSuffixDoNotMatter) {
  PluginRegistry registry;
  register_builtin_plugins(registry);
  for (const char* name : {"librotors_gazebo_imu_plugin.so", "rotors_gazebo_imu_plugin",
                           "/opt/ros/lib/librotors_gazebo_imu_plugin.so"}) {
    EXPECT_NE(registry.find(name), nullptr) << name;
  }
  EXPECT_EQ(registry.find("libsomething_else.so"), nullptr);
  EXPECT_TRUE(contains(error_of([&] { registry.add("rotors_gazebo_imu_plugin", {}); }), "twice"));
  EXPECT_TRUE(contains(error_of([&] { registry.load_shared_object("/no/such/lib.so"); }),
                       "/no/such/lib.so"));
}

}  // namespace
}  // namespace trident::sim
