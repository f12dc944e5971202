// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_node_params.h"

#include <gtest/gtest.h>

#include <string>

#include "trident_ros/node_params.h"

namespace trident::estimation {
namespace {

TEST(AmclNodeParams, ErrorsAndWarningsHaveAmclsNames) {
  XmlRpc::XmlRpcValue value;
  value["initial_cov_xx"] = -1.0;
  try {
    ros_utils::NodeParams(value, "/amcl").read<AmclNodeParams>();
    FAIL() << "a negative variance was accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "parameter /amcl/initial_cov_xx: -1 is out of range; must be a number >= 0 m^2");
  }
  value["initial_cov_xx"] = 1;
  value["save_pose_rat"] = 0.5;
  ros_utils::NodeParams params(value, "/amcl");
  EXPECT_EQ(params.read<AmclNodeParams>().initial_cov_xx, 1.0);
  ASSERT_EQ(params.warnings().size(), 1U);
  EXPECT_EQ(params.warnings()[0],
            "parameter /amcl/save_pose_rat is unknown, not used; did you mean save_pose_rate?");
}

TEST(AmclNodeParams, TheReferenceIsThatOfTheStruct) {
  const std::string page = ros_utils::params_page(
      "amcl", "Private parameters of localization in a map, printed from the node's struct.",
      ros_utils::document_params<AmclNodeParams>());
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/amcl.md", page), page)
      << "set TRIDENT_WRITE_DOCS=1 to write it";
}

}  // namespace
}  // namespace trident::estimation
