// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/resources.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

class ResourcesTest : public testing::Test {
 protected:
  ResourcesTest()
      : file_(folder_.write("models/crate/meshes/a.stl", "")),
        models_(folder_.path() + "/models"),
        model_path_("GAZEBO_MODEL_PATH", ""),
        resource_path_("GAZEBO_RESOURCE_PATH", ""),
        plugin_path_("GAZEBO_PLUGIN_PATH", ""),
        package_path_("ROS_PACKAGE_PATH", "") {}

  ScratchFolder folder_;
  std::string file_, models_;
  ScopedEnvironment model_path_, resource_path_, plugin_path_, package_path_;
};

TEST_F(ResourcesTest, ExtraFoldersHoldModels) {
  EXPECT_EQ(Resources({models_}).find("model://crate/meshes/a.stl"), file_);
  EXPECT_EQ(Resources({models_}).find("model://crate"), models_ + "/crate");
  EXPECT_EQ(Resources().find("model://crate"), "");
}

TEST_F(ResourcesTest, TheModelPathMayHoldALiteralVariable) {
  const ScopedEnvironment path("GAZEBO_MODEL_PATH", "${GAZEBO_MODEL_PATH}::" + models_);
  const Resources resources;
  EXPECT_EQ(resources.find("model://crate/meshes/a.stl"), file_);
  EXPECT_EQ(resources.searched().substr(0, models_.size() + 1), models_ + ":");
  EXPECT_TRUE(resources.warnings().empty());  // an idiom of upstream's launch files
}

TEST_F(ResourcesTest, TheNameOfAnySearchPathIsNoWarningInAnyOfThem) {
  for (const char* value : {"$GAZEBO_MODEL_PATH:/a", "${GAZEBO_RESOURCE_PATH}:/a",
                            "/a:${GAZEBO_PLUGIN_PATH}:$GAZEBO_PLUGIN_PATH"}) {
    for (const char* variable :
         {"GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH", "GAZEBO_PLUGIN_PATH"}) {
      const ScopedEnvironment path(variable, value);
      EXPECT_TRUE(Resources().warnings().empty()) << variable << "=" << value;
    }
  }
}

TEST_F(ResourcesTest, OtherUnexpandedPartsAreReportedNextToTheNameOfTheSearchPath) {
  const ScopedEnvironment path("GAZEBO_MODEL_PATH", "${GAZEBO_MODEL_PATH}:${GAZEBO_MODEL_PATH}/a");
  const Resources resources;
  ASSERT_EQ(resources.warnings().size(), 1u);
  EXPECT_TRUE(
      contains(resources.warnings()[0], "GAZEBO_MODEL_PATH holds '${GAZEBO_MODEL_PATH}/a'"));
}

TEST_F(ResourcesTest, PartsThatNobodyHasExpandedAreReportedOncePerVariable) {
  const ScopedEnvironment path("GAZEBO_RESOURCE_PATH",
                               "${A}:" + folder_.path() + ":${HOME}/worlds:$B");
  const ScopedEnvironment plugins("GAZEBO_PLUGIN_PATH", "${HOME}/plugins:/opt/plugins");
  const Resources resources;
  EXPECT_EQ(resources.warnings().size(), 2u);
  EXPECT_EQ(resources.find("models/crate/meshes/a.stl"), file_);
  EXPECT_EQ(resources.plugin_folders(), std::vector<std::string>{"/opt/plugins"});
}

TEST_F(ResourcesTest, WhatComesWithTheSimulatorIsFoundWhateverTheVariablesSay) {
  const std::string shipped = std::string(TRIDENT_REPOSITORY) + "/worlds/models/ground_plane";
  for (const char* value : {"", "/no/such/folder", "${GAZEBO_MODEL_PATH}", ":::"}) {
    const ScopedEnvironment path("GAZEBO_MODEL_PATH", value);
    EXPECT_EQ(Resources().find("model://ground_plane"), shipped);
    // In the repository itself, the name leads there from the working directory.
    EXPECT_EQ(std::filesystem::absolute(Resources().find("worlds/empty.world")).string(),
              std::string(TRIDENT_REPOSITORY) + "/worlds/empty.world");
  }
}

TEST_F(ResourcesTest, WhatComesWithTheSimulatorIsFoundLast) {
  folder_.write("models/ground_plane/model.config", "");
  const std::string shipped = std::string(TRIDENT_REPOSITORY) + "/worlds/models";
  const ScopedEnvironment path("GAZEBO_MODEL_PATH", shipped + "/:" + models_);
  EXPECT_EQ(Resources().find("model://ground_plane"), models_ + "/ground_plane");
  const ScopedEnvironment other("GAZEBO_MODEL_PATH", shipped);
  const ScopedEnvironment resources("GAZEBO_RESOURCE_PATH", models_);
  EXPECT_EQ(Resources().find("model://ground_plane"), models_ + "/ground_plane");
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

TEST_F(ResourcesTest, PackagesGoByTheNameInTheirManifest) {
  folder_.write("ws/my-house-world/package.xml", "<package><name> my_house </name></package>");
  const std::string world = folder_.write("ws/my-house-world/worlds/house.world", "");
  folder_.write("ws/hidden/CATKIN_IGNORE", "");
  folder_.write("ws/hidden/deep/package.xml", "<package><name>hidden_one</name></package>");
  const ScopedEnvironment path("ROS_PACKAGE_PATH", folder_.path() + "/ws");
  EXPECT_EQ(Resources().find("package://my_house/worlds/house.world"), world);
  EXPECT_EQ(Resources().find("package://hidden_one"), "");
}

/// A package that exports paths to gazebo_ros; `depend`: what its manifest says besides.
std::string exporting(const std::string& name, const std::string& depend,
                      const std::string& attributes) {
  return "<package format='2'><name>" + name + "</name>" + depend + "<export><gazebo_ros " +
         attributes + "/></export></package>";
}

TEST_F(ResourcesTest, PackagesExportPathsToGazeboRos) {
  const char* const depend = "<depend>gazebo_ros</depend>";
  folder_.write("ws/a/package.xml",
                exporting("a", depend,
                          "gazebo_model_path='${prefix}/models:${prefix}/more' "
                          "gazebo_media_path='${prefix}' plugin_path='${prefix}/lib'"));
  const std::string wall = folder_.write("ws/a/more/wall/model.config", "");
  const std::string world = folder_.write("ws/a/worlds/maze.world", "");
  const ScopedEnvironment path("ROS_PACKAGE_PATH", folder_.path() + "/ws");
  const Resources resources;
  EXPECT_EQ(resources.find("model://wall/model.config"), wall);
  EXPECT_EQ(resources.find("worlds/maze.world"), world);
  EXPECT_EQ(resources.plugin_folders(), std::vector<std::string>{folder_.path() + "/ws/a/lib"});
  EXPECT_TRUE(contains(resources.searched(), folder_.path() + "/ws/a/more"));
}

TEST_F(ResourcesTest, FilesNamedBarelyAreFoundAmongTheMediaOfEachFolderAsInGazebo) {
  folder_.write("ws/a/package.xml",
                exporting("a", "<depend>gazebo_ros</depend>", "gazebo_media_path='${prefix}'"));
  const std::string tree = folder_.write("ws/a/Media/models/tree.dae", "");
  const std::string rock = folder_.write("media/models/rock.dae", "");
  const ScopedEnvironment packages("ROS_PACKAGE_PATH", folder_.path() + "/ws");
  const ScopedEnvironment path("GAZEBO_RESOURCE_PATH", folder_.path());
  EXPECT_EQ(Resources().find("file://tree.dae"), tree);
  EXPECT_EQ(Resources().find("rock.dae"), rock);
  EXPECT_EQ(Resources().find("file://crate/meshes/a.stl"), file_);
  EXPECT_EQ(Resources().find("model://tree.dae"), "");
}

TEST_F(ResourcesTest, ExportsComeBehindTheVariablesAndBeforeWhatIsShipped) {
  folder_.write("ws/a/package.xml", exporting("a", "<exec_depend>gazebo_ros</exec_depend>",
                                              "gazebo_model_path='${prefix}'"));
  folder_.write("ws/a/ground_plane/model.config", "");
  folder_.write("ws/a/crate/model.config", "");
  const ScopedEnvironment packages("ROS_PACKAGE_PATH", folder_.path() + "/ws");
  const ScopedEnvironment models("GAZEBO_MODEL_PATH", models_);
  EXPECT_EQ(Resources().find("model://crate"), models_ + "/crate");
  EXPECT_EQ(Resources().find("model://ground_plane"), folder_.path() + "/ws/a/ground_plane");
}

TEST_F(ResourcesTest, ExportsOfPackagesThatDoNotDependOnGazeboRosDoNotCount) {
  folder_.write("ws/a/package.xml", exporting("a", "", "gazebo_model_path='${prefix}'"));
  folder_.write("ws/a/wall/model.config", "");
  folder_.write("ws/b/package.xml", exporting("b", "<depend>gazebo_ros</depend>",
                                              "gazebo_model_path='`echo ${prefix}`'"));
  folder_.write("ws/b/door/model.config", "");
  const ScopedEnvironment path("ROS_PACKAGE_PATH", folder_.path() + "/ws");
  EXPECT_EQ(Resources().find("model://wall"), "");
  EXPECT_EQ(Resources().find("model://door"), "");  // no shell is asked
}

}  // namespace
}  // namespace trident::sim
