// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "plugin_conformance.h"
#include "quad_world.h"
#include "scratch_folder.h"

namespace trident::sim {
namespace {

constexpr double kDt = 0.01;

/// Over x, y in [-100, 100] and z in [0, 100]: 10 m/s along x at the ground, half of it at the top,
/// 2 m/s along y everywhere.
const char kField[] =
    "min_x: -100\nmin_y: -100\nn_x: 2\nn_y: 2\nres_x: 200\nres_y: 200\n"
    "vertical_spacing_factors: 0 1\nbottom_z: 0 0 0 0\ntop_z: 100 100 100 100\n"
    "u: 10 10 10 10 5 5 5 5\nv: 2 2 2 2 2 2 2 2\nw: 0 0 0 0 0 0 0 0\n";

ParamList field_params(const std::string& path, const ParamList& more = {}) {
  ParamList params{{"robotNamespace", "quad"},
                   {"linkName", "link"},
                   {"useCustomStaticWindField", "true"},
                   {"customWindFieldPath", path}};
  params.insert(params.end(), more.begin(), more.end());
  return params;
}
PluginSpec wind_plugin(const ParamList& params) {
  return make_plugin("wind", "librotors_gazebo_wind_plugin.so", params);
}

/// A body without weight, in the wind of the field of a file.
class WindFieldPlugin : public testing::Test {
 protected:
  WindFieldPlugin() : path_(folder_.write("wind.txt", kField)) {}

  Model& add(TestWorld& world, const ParamList& params) {
    ModelSpec spec = make_body("probe", SphereShape{0.1}, at(0, 0, 20), 2.0);
    spec.links[0].gravity = false;
    spec.plugins.push_back(wind_plugin(params));
    return world.add(std::move(spec));
  }
  std::string refusal(const ParamList& params) {
    TestWorld world;
    std::string error = error_of([&] { add(world, params); });
    EXPECT_EQ(world->find_model("probe"), nullptr);
    EXPECT_TRUE(contains(error, "model 'probe' plugin 'wind': "));
    return error;
  }
  /// Wind at the probe after one step from `p_world`.
  static Eigen::Vector3d wind_from(TestWorld& world, Model& probe, const Eigen::Vector3d& p_world) {
    auto* speed = world->ports().find_out<WindSample>("quad/wind_speed");
    if (!speed->wanted()) speed->add_listener();
    const std::uint64_t before = speed->count();
    world->set_model_pose(probe, at(p_world.x(), p_world.y(), p_world.z()));
    world->step();
    EXPECT_EQ(speed->count(), before + 1);
    EXPECT_EQ(speed->value.stamp, world->time());
    return speed->value.v_world;
  }

  ScratchFolder folder_;
  std::string path_;
};

TEST_F(WindFieldPlugin, ShowsTheWindWhereTheLinkIs) {
  TestWorld world;
  Model& probe = add(world, field_params(path_, {{"frameId", "map"}}));
  EXPECT_TRUE(is_near(wind_from(world, probe, {0, 0, 20}), {9, 2, 0}, 1e-12));
  EXPECT_TRUE(is_near(wind_from(world, probe, {90, -90, 60}), {7, 2, 0}, 1e-12));
  EXPECT_EQ(world->ports().find_out<WindSample>("quad/wind_speed")->value.frame, "map");
}

TEST_F(WindFieldPlugin, ShowsTheConstantWindOutside) {
  TestWorld world;
  Model& probe =
      add(world, field_params(path_, {{"windSpeedMean", "3"}, {"windDirection", "0 0 2"}}));
  EXPECT_TRUE(is_near(wind_from(world, probe, {0, 0, 101}), {0, 0, 3}, 1e-12));
  EXPECT_TRUE(is_near(wind_from(world, probe, {101, 0, 20}), {0, 0, 3}, 1e-12));
  EXPECT_TRUE(is_near(wind_from(world, probe, {0, 0, 50}), {7.5, 2, 0}, 1e-12));
}

TEST_F(WindFieldPlugin, ThereIsNoWindOutsideByDefault) {
  TestWorld world;
  Model& probe = add(world, field_params(path_));
  EXPECT_EQ(wind_from(world, probe, {0, 0, -1}), Eigen::Vector3d(0, 0, 0));
}

TEST_F(WindFieldPlugin, TakesThePlaceOfTheForces) {
  TestWorld world;
  Model& probe = add(world, field_params(path_, {{"windForceMean", "3"},
                                                 {"windGustStart", "0"},
                                                 {"windGustDuration", "9"},
                                                 {"windGustForceMean", "4"}}));
  auto* force = world->ports().find_out<WrenchSample>("quad/external_force");
  force->add_listener();
  world->step(10);
  EXPECT_EQ(probe.bodies[0]->velocity(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(force->count(), 0u);
}

TEST_F(WindFieldPlugin, AFieldThatIsNotUsedIsNotRead) {
  TestWorld world;
  ParamList params = field_params("nowhere.txt");
  params[2].second = "false";
  Model& probe = add(world, params);
  EXPECT_EQ(wind_from(world, probe, {0, 0, 20}), Eigen::Vector3d(0, 0, 0));
}

TEST_F(WindFieldPlugin, DragsTheRotorsOfItsNamespace) {
  QuadOptions options;
  options.rotor_drag = 2e-4;
  QuadWorld quad(options);
  Model& probe = add(quad.world, field_params(path_));
  const double gain = 4 * 400 * options.rotor_drag / options.mass_kg() * kDt;
  for (const double z : {20.0, 60.0, 500.0}) {
    quad.settle({400, 400, 400, 400});
    quad->set_model_pose(probe, at(0, 0, z));
    quad->step();
    const Eigen::Vector2d wind =
        z > 100.0 ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(10 - z / 20, 2);
    EXPECT_NEAR(quad.body().velocity().x(), gain * wind.x(), 1e-9) << z;
    EXPECT_NEAR(quad.body().velocity().y(), gain * wind.y(), 1e-9) << z;
  }
}

TEST_F(WindFieldPlugin, TheFileIsFoundAsOtherFilesAre) {
  const ScopedEnvironment no_models("GAZEBO_MODEL_PATH", "");
  const ScopedEnvironment packages("ROS_PACKAGE_PATH", folder_.path());
  folder_.write("winds/package.xml", "<package/>");
  folder_.write("winds/fields/hill.txt", kField);
  const auto works = [&](const std::string& path, const Resources& resources) {
    TestWorld world(world_spec(), {}, resources);
    Model& probe = add(world, field_params(path));
    EXPECT_TRUE(is_near(wind_from(world, probe, {0, 0, 20}), {9, 2, 0}, 1e-12)) << path;
  };
  works("package://winds/fields/hill.txt", Resources());
  works("model://winds/fields/hill.txt", Resources());
  works("file://" + path_, Resources());
  works("fields/hill.txt", Resources({folder_.path() + "/winds"}));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  works("winds/fields/hill.txt", Resources());
  std::filesystem::current_path(before);
}

TEST_F(WindFieldPlugin, AMissingPathOrFileRefusesTheModel) {
  ParamList no_path = field_params("");
  EXPECT_TRUE(contains(refusal(no_path), "<customWindFieldPath> is missing or empty"));
  no_path.pop_back();
  EXPECT_TRUE(contains(refusal(no_path), "<customWindFieldPath> is missing or empty"));
  EXPECT_TRUE(contains(refusal(field_params("gone.txt")),
                       "<customWindFieldPath> is 'gone.txt', expected a file; searched: "));
  EXPECT_TRUE(contains(refusal(field_params(folder_.path())), "expected a file"));
}

TEST_F(WindFieldPlugin, ABadFileRefusesTheModelWithFileAndField) {
  std::string text = kField;
  text.replace(text.find("res_y: 200"), 10, "res_y: 0  ");
  const std::string bad = folder_.write("bad.txt", text);
  EXPECT_TRUE(contains(refusal(field_params(bad)), "<customWindFieldPath>: " + bad +
                                                       ":6: res_y is '0', expected a number > 0"));
}

TEST_F(WindFieldPlugin, AFlagThatIsNoFlagIsRefused) {
  ParamList params = field_params(path_);
  params[2].second = "perhaps";
  EXPECT_TRUE(contains(refusal(params), "<useCustomStaticWindField> is 'perhaps', expected true"));
}

TEST_F(WindFieldPlugin, Conforms) {
  ParamList params = field_params(path_);
  params[1].second = "base_link";
  expect_plugin_conforms({"librotors_gazebo_wind_plugin.so",
                          params,
                          {"linkName", "customWindFieldPath"},
                          {"windSpeedMean", "windDirection"}});
}

}  // namespace
}  // namespace trident::sim
