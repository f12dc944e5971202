// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/resources.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "test_world.h"

namespace trident {
namespace {

class ResourcesTest : public testing::Test {
 protected:
  ResourcesTest()
      : file_(folder_.write("models/crate/meshes/a.stl", "")),
        models_(folder_.path() + "/models"),
        model_path_("GAZEBO_MODEL_PATH", ""),
        resource_path_("GAZEBO_RESOURCE_PATH", ""),
        package_path_("ROS_PACKAGE_PATH", "") {}

  ScratchFolder folder_;
  std::string file_, models_;
  ScopedEnvironment model_path_, resource_path_, package_path_;
};

TEST_F(ResourcesTest, ExtraFoldersHoldModels) {
  EXPECT_EQ(Resources({models_}).find("model://crate/meshes/a.stl"), file_);
  EXPECT_EQ(Resources({models_}).find("model://crate"), models_ + "/crate");
  EXPECT_EQ(Resources().find("model://crate"), "");
}

TEST_F(ResourcesTest, TheModelPathMayHoldALiteralVariable) {
  const ScopedEnvironment path("GAZEBO_MODEL_PATH", "${GAZEBO_MODEL_PATH}::" + models_);
  EXPECT_EQ(Resources().find("model://crate/meshes/a.stl"), file_);
  EXPECT_EQ(Resources().searched(), models_);
}

TEST_F(ResourcesTest, TheResourcePathCountsToo) {
  const ScopedEnvironment path("GAZEBO_RESOURCE_PATH", folder_.path());
  EXPECT_EQ(Resources().find("models/crate/meshes/a.stl"), file_);
}

TEST_F(ResourcesTest, AbsolutePathsAndFileUrisAreTakenAsTheyAre) {
  EXPECT_EQ(Resources().find(file_), file_);
  EXPECT_EQ(Resources().find("file://" + file_), file_);
  EXPECT_EQ(Resources().find("/no/such/file"), "");
}

TEST_F(ResourcesTest, FileUrisMayMeanAModelFolder) {
  EXPECT_EQ(Resources({models_}).find("file://crate/meshes/a.stl"), file_);
}

TEST_F(ResourcesTest, RelativePathsStartWhereTheNamingFileLies) {
  EXPECT_EQ(Resources().find("meshes/a.stl", models_ + "/crate"), file_);
  EXPECT_EQ(Resources().find("meshes/a.stl", models_), "");
}

TEST_F(ResourcesTest, PackagesAreFoundThroughTheirManifest) {
  folder_.write("ws/src/group/my_robot/package.xml", "<package/>");
  const std::string mesh = folder_.write("ws/src/group/my_robot/b.stl", "");
  folder_.write("ws/src/not_a_package/b.stl", "");
  const ScopedEnvironment path("ROS_PACKAGE_PATH", folder_.path() + "/ws/src");
  const Resources resources;
  EXPECT_EQ(resources.find("package://my_robot/b.stl"), mesh);
  EXPECT_EQ(resources.find("model://my_robot/b.stl"), mesh);
  EXPECT_EQ(resources.find("package://my_robot"), folder_.path() + "/ws/src/group/my_robot");
  EXPECT_EQ(resources.find("package://my_robot/gone.stl"), "");
  EXPECT_EQ(resources.find("package://not_a_package/b.stl"), "");
}

TEST_F(ResourcesTest, ThePackagePathMayNameThePackageItself) {
  folder_.write("my_robot/package.xml", "<package/>");
  const ScopedEnvironment path("ROS_PACKAGE_PATH", folder_.path() + "/my_robot");
  EXPECT_EQ(Resources().find("package://my_robot"), folder_.path() + "/my_robot");
}

TEST_F(ResourcesTest, AnEmptySearchSaysSo) {
  EXPECT_TRUE(contains(Resources().searched(), "GAZEBO_MODEL_PATH"));
}

}  // namespace
}  // namespace trident
