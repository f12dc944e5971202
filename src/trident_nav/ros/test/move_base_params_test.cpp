// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/move_base_params.h"

#include <gtest/gtest.h>

#include <string>

#include "trident_base/error.h"
#include "trident_base/yaml_config.h"

namespace trident::nav {
namespace {

std::string error_of(const std::string& yaml) {
  Warnings warnings;
  const ConfigNode node = parse_yaml(yaml, "test.yaml");
  try {
    read_controller_config(&node, "DWAPlannerROS", &warnings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_named(const std::string& yaml, const std::string& words) {
  const std::string error = error_of(yaml);
  EXPECT_NE(error.find("DWAPlannerROS"), std::string::npos) << error;
  EXPECT_NE(error.find(words), std::string::npos) << error;
}

TEST(MoveBaseParamsTest, LeastVelocitiesMustNotExceedTheGreatest) {
  expect_named("{min_vel_x: 0.6, max_vel_x: 0.5}", "min_vel_x is 0.6, legal is at most max_vel_x");
  expect_named("{min_vel_x: 0.6}", "max_vel_x, which is 0.55");
  expect_named("{min_vel_theta: 2, max_vel_theta: 1}", "min_vel_theta is 2");
  expect_named("{min_vel_trans: 0.3, max_vel_trans: 0.2}", "min_vel_trans is 0.3");
  EXPECT_EQ(error_of("{min_vel_x: 0.5, max_vel_x: 0.5, min_vel_theta: 3}"), "");
}

TEST(MoveBaseParamsTest, LimitsThatAreNoneAreRefusedWithTheirRange) {
  expect_named("{max_vel_x: 0}", "> 0");
  expect_named("{acc_lim_x: -1}", "acc_lim_x");
  expect_named("{max_vel_theta: fast}", "fast");
  expect_named("{min_turning_radius: .nan}", "min_turning_radius");
}

}  // namespace
}  // namespace trident::nav
