// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_parameters.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "trident_slam/ekf_slam_2d.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/hector_slam_2d.h"
#include "trident_slam/particle_slam_2d.h"
#include "trident_slam_ros/gmapping_params.h"
#include "trident_slam_ros/slam_node_options.h"

namespace trident::slam {
namespace {

using ros_utils::NodeParams;
using XmlRpc::XmlRpcValue;

/// A YAML file that lives as long as the test.
class ConfigFile {
 public:
  explicit ConfigFile(const std::string& text) { std::ofstream(path_) << text; }
  ~ConfigFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = testing::TempDir() + "slam_method_" + std::to_string(getpid()) + ".yaml";
};

std::string error_of(const XmlRpcValue& value) {
  try {
    NodeParams params(value, "/slam");
    SlamMethod(params, "graph_slam_2d").maker()();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SlamMethod, ParametersAndFileGiveTheSameAlgorithm) {
  XmlRpcValue value;
  value["resolution"] = 0.1;
  value["map_start_pose"][0] = 1;
  value["map_start_pose"][1] = 2.5;
  value["map_start_pose"][2] = 0.0;
  NodeParams params(value, "/slam");
  const auto by_params = SlamMethod(params, "graph_slam_2d").params<GraphSlamOptions>();
  const ConfigFile file("resolution: 0.1\nmap_start_pose: [1, 2.5, 0]\n");
  XmlRpcValue with_file;
  with_file["config_file"] = file.path();
  NodeParams file_params(with_file, "/slam");
  const auto by_file = SlamMethod(file_params, "graph_slam_2d").params<GraphSlamOptions>();
  EXPECT_EQ(by_params.resolution, by_file.resolution);
  EXPECT_EQ(by_params.map_start_pose, by_file.map_start_pose);
}

TEST(SlamMethod, NodesKeepNoScansWithOrWithoutAFileUnlessAskedTo) {
  const ConfigFile silent("resolution: 0.1\n");
  for (const std::string& file : {std::string(), silent.path()}) {
    XmlRpcValue value;
    value["config_file"] = file;
    NodeParams params(value, "/slam");
    SlamMethod method(params, "graph_slam_2d");
    set_node_defaults(method);
    EXPECT_FALSE(method.params<GraphSlamOptions>().keep_scans) << file;
  }
  const ConfigFile asking("keep_scans: true\n");
  XmlRpcValue value;
  value["config_file"] = asking.path();
  NodeParams params(value, "/slam");
  SlamMethod method(params, "graph_slam_2d");
  set_node_defaults(method);
  EXPECT_TRUE(method.params<GraphSlamOptions>().keep_scans);
}

TEST(SlamMethod, ParametersThatAFileReplacesAreWarnedAbout) {
  const ConfigFile file("resolution: 0.1\n");
  XmlRpcValue value;
  value["config_file"] = file.path();
  value["resolution"] = 0.2;
  NodeParams params(value, "/slam");
  EXPECT_EQ(SlamMethod(params, "graph_slam_2d").params<GraphSlamOptions>().resolution, 0.1);
  EXPECT_EQ(params.warnings(),
            std::vector<std::string>{
                "parameters resolution of /slam are not used: config_file is " + file.path()});
}

TEST(SlamMethod, AnAliasCountsWhereTheOwnNameIsNotSet) {
  const std::vector<ParameterAlias> aliases = {{"resolution", "delta"}, {"resolution", "cell"}};
  XmlRpcValue value;
  value["cell"] = 0.3;
  value["delta"] = 0.2;
  NodeParams upstream(value, "/slam");
  EXPECT_EQ(SlamMethod(upstream, "graph_slam_2d", aliases).text("resolution"), "0.2");
  value["resolution"] = 0.1;
  NodeParams own(value, "/slam");
  EXPECT_EQ(SlamMethod(own, "graph_slam_2d", aliases).text("resolution"), "0.1");
  EXPECT_TRUE(own.warnings().empty());
}

TEST(SlamMethod, UnknownNamesSuggestThoseOfTheMethodThatRuns) {
  XmlRpcValue value;
  value["method"] = "particle_slam_2d";
  value["partikles"] = 5;
  NodeParams params(value, "/slam");
  SlamMethod(params, "graph_slam_2d");
  EXPECT_EQ(params.warnings(),
            std::vector<std::string>{
                "parameter /slam/partikles is unknown, not used; did you mean particles?"});
}

TEST(SlamMethod, ErrorsNameTheParameterOrTheLineOfTheFile) {
  XmlRpcValue value;
  value["resolution"] = -1.0;
  EXPECT_EQ(error_of(value),
            "parameter /slam/resolution: -1 is out of range; must be a number in [0.005, 1] m");
  value["method"] = "karto";
  EXPECT_NE(error_of(value).find("unknown SLAM method 'karto'"), std::string::npos);
  const ConfigFile file("# a comment\nresolutoin: 0.1\n");
  XmlRpcValue with_file;
  with_file["config_file"] = file.path();
  EXPECT_NE(error_of(with_file).find(file.path() + ":2: resolutoin: unknown key"),
            std::string::npos)
      << error_of(with_file);
}

void expect_page(const std::string& name, const std::string& what, const std::string& table) {
  const std::string page = ros_utils::params_page(name, what + ", printed from its struct.", table);
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/" + name + ".md", page), page)
      << "set TRIDENT_WRITE_DOCS=1 to write it";
}

TEST(SlamParameters, TheReferenceIsThatOfTheStructs) {
  expect_page("slam_node", "Private parameters that all SLAM nodes share",
              ros_utils::document_params<SlamMethodParams>() + '\n' +
                  ros_utils::document_params<SlamNodeOptions>());
  expect_page("slam_gmapping", "Private parameters of slam_gmapping beyond those of its method",
              ros_utils::document_params<GmappingParams>());
  expect_page("graph_slam_2d", "Keys of the YAML file, or private parameters, of graph_slam_2d",
              document<GraphSlamOptions>());
  expect_page("particle_slam_2d",
              "Keys of the YAML file, or private parameters, of particle_slam_2d",
              document<ParticleSlamParams>());
  expect_page("hector_slam_2d", "Keys of the YAML file, or private parameters, of hector_slam_2d",
              document<HectorSlamParams>());
  expect_page("ekf_slam_2d", "Keys of the YAML file, or private parameters, of ekf_slam_2d",
              document<EkfSlam2dParams>());
}

}  // namespace
}  // namespace trident::slam
