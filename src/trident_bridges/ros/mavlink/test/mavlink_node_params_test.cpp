// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/mavlink_node_params.h"

#include <gtest/gtest.h>

#include <string>

#include "trident_base/error.h"
#include "trident_ros/node_params.h"

namespace trident::bridges {
namespace {

std::string error_of(const XmlRpc::XmlRpcValue& value) {
  ros_utils::NodeParams params(value, "/mavlink_vehicles");
  try {
    params.read<MavlinkNodeParams>();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MavlinkNodeParams, WhatIsMissingOrNotLegalIsNamed) {
  XmlRpc::XmlRpcValue value;
  value["period"] = 0.02;
  EXPECT_NE(error_of(value).find("vehicles_file"), std::string::npos) << error_of(value);
  value["vehicles_file"] = "vehicles.yaml";
  EXPECT_EQ(error_of(value), "");
  value["period"] = 0.5;
  EXPECT_NE(error_of(value).find("period"), std::string::npos) << error_of(value);
  value["period"] = 0.02;
  value["origin"]["latitude"] = 91.0;
  EXPECT_NE(error_of(value).find("latitude"), std::string::npos) << error_of(value);
}

TEST(MavlinkNodeParams, TheReferenceIsThatOfTheStruct) {
  const std::string page = ros_utils::params_page(
      "mavlink_vehicle_node",
      "Private parameters of mavlink_vehicle_node, printed from the node's struct.",
      ros_utils::document_params<MavlinkNodeParams>());
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/mavlink_vehicle_node.md", page), page)
      << "set TRIDENT_WRITE_DOCS=1 to write it";
}

}  // namespace
}  // namespace trident::bridges
