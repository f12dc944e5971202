// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "spawn_options.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace trident::sim {
namespace {

std::string error_of(const std::vector<std::string>& arguments) {
  try {
    parse_spawn_options(arguments);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(SpawnOptions, reads_the_line_that_rotors_launch_files_give) {
  const SpawnOptions options =
      parse_spawn_options({"-param", "robot_description", "-urdf", "-x", "-1.5", "-y", "2", "-z",
                           "0.1", "-model", "firefly"});
  EXPECT_EQ(options.format, ModelFormat::urdf);
  EXPECT_EQ(options.source, ModelSource::parameter);
  EXPECT_EQ(options.source_name, "robot_description");
  EXPECT_EQ(options.model_name, "firefly");
  EXPECT_EQ(options.x, -1.5);
  EXPECT_EQ(options.y, 2.0);
  EXPECT_EQ(options.z, 0.1);
  EXPECT_EQ(options.gazebo_namespace, "/gazebo");
  EXPECT_FALSE(options.robot_namespace);
  EXPECT_FALSE(options.unpause);
}

TEST(SpawnOptions, reads_every_other_flag) {
  const SpawnOptions options = parse_spawn_options({"-sdf",       "-stdin",
                                                    "-model=box", "-reference_frame",
                                                    "a::b",       "-gazebo_namespace",
                                                    "/sim",       "-robot_namespace",
                                                    "",           "-R",
                                                    "0.1",        "-P=0.2",
                                                    "-Y",         "-3e-1",
                                                    "-J",         "arm",
                                                    "1.5",        "-J",
                                                    "hand",       "-2",
                                                    "-wait",      "table",
                                                    "-unpause",   "-package_to_model",
                                                    "-b"});
  EXPECT_EQ(options.format, ModelFormat::sdf);
  EXPECT_EQ(options.source, ModelSource::standard_input);
  EXPECT_EQ(options.model_name, "box");
  EXPECT_EQ(options.reference_frame, "a::b");
  EXPECT_EQ(options.gazebo_namespace, "/sim");
  EXPECT_EQ(options.robot_namespace, "");
  EXPECT_EQ(options.roll, 0.1);
  EXPECT_EQ(options.pitch, 0.2);
  EXPECT_EQ(options.yaw, -0.3);
  const std::vector<std::pair<std::string, double>> joints = {{"arm", 1.5}, {"hand", -2.0}};
  EXPECT_EQ(options.joint_positions, joints);
  EXPECT_EQ(options.wait_for_model, "table");
  EXPECT_TRUE(options.unpause && options.package_to_model && options.delete_on_exit);
}

TEST(SpawnOptions, help_needs_nothing_else) { EXPECT_TRUE(parse_spawn_options({"-h"}).help); }

TEST(SpawnOptions, names_what_is_wrong) {
  EXPECT_EQ(error_of({"-file", "a", "-model", "m"}), "one of -urdf, -sdf is needed");
  EXPECT_EQ(error_of({"-urdf", "-model", "m"}),
            "one of -file, -param, -database, -stdin is needed");
  EXPECT_EQ(error_of({"-urdf", "-file", "a"}), "-model NAME is needed");
  EXPECT_EQ(error_of({"-urdf", "-sdf"}), "-sdf does not go together with -urdf");
  EXPECT_EQ(error_of({"-file", "a", "-param", "b"}), "-param does not go together with -file");
  EXPECT_EQ(error_of({"-model"}), "-model needs a value after it");
  EXPECT_EQ(error_of({"-x", "1m"}), "-x is '1m': it must be a finite number");
  EXPECT_EQ(error_of({"-z", "nan"}), "-z is 'nan': it must be a finite number");
  EXPECT_EQ(error_of({"-y", ""}), "-y is '': it must be a finite number");
  EXPECT_EQ(error_of({"-J", "arm", "up"}), "-J arm is 'up': it must be a finite number");
  EXPECT_EQ(error_of({"-unpause=1"}), "-unpause takes no value, but has '1'");
  EXPECT_EQ(error_of({"-trimesh"}), "'-trimesh' is not an option of spawn_model; -h lists them");
}

TEST(SpawnOptions, turns_package_meshes_into_model_meshes_only) {
  EXPECT_EQ(
      meshes_from_package_to_model(
          R"(<mesh filename="package://a/b.dae"/><mesh scale="1 1 1" filename='package://c.stl'/>)"
          R"(<uri>package://d</uri>)"),
      R"(<mesh filename="model://a/b.dae"/><mesh scale="1 1 1" filename='model://c.stl'/>)"
      R"(<uri>package://d</uri>)");
}

}  // namespace
}  // namespace trident::sim
