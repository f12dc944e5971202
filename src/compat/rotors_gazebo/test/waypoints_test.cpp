// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "waypoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "trajectory_sender.h"

namespace trident::control {
namespace {

std::vector<Waypoint> read(const std::string& text) {
  std::istringstream in(text);
  return read_waypoints(in, "f.txt");
}

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Waypoints, reads_the_lines_of_rotors_example) {
  const auto waypoints = read("60 20 0 9 0\r\n\n# a comment\n60,20,20, 1 ,-90\n");
  ASSERT_EQ(waypoints.size(), 2u);
  EXPECT_EQ(waypoints[0].wait_s, 60.0);
  EXPECT_EQ(waypoints[0].x, 20.0);
  EXPECT_EQ(waypoints[0].z, 9.0);
  EXPECT_EQ(waypoints[1].y, 20.0);
  EXPECT_DOUBLE_EQ(waypoints[1].yaw, -M_PI / 2);
}

TEST(Waypoints, names_line_column_and_value_of_what_is_wrong) {
  EXPECT_EQ(error_of("1 2 3 4 5\n1 2 3 4\n"),
            "f.txt, line 2 has 4 values: it must have 5, wait_time x y z yaw_deg");
  EXPECT_EQ(error_of("1 2 three 4 5\n"), "f.txt, line 1, y is 'three': it must be a finite number");
  EXPECT_EQ(error_of("1 2 3 inf 5\n"), "f.txt, line 1, z is 'inf': it must be a finite number");
  EXPECT_EQ(error_of("-1 2 3 4 5\n"),
            "f.txt, line 1, wait_time is -1: it must be >= 0 s, <= 1e9 s");
  EXPECT_EQ(error_of("1e308 2 3 4 5\n"),
            "f.txt, line 1, wait_time is 1e308: it must be >= 0 s, <= 1e9 s");
  EXPECT_EQ(error_of("1e9 2 3 4 5\n1 2 3 4 5\n"),
            "f.txt, line 2: the waits up to here are more than 1e9 s");
  EXPECT_EQ(error_of("\n# only this\n"), "f.txt has no waypoints");
}

TEST(Waypoints, trajectory_sums_the_waits_and_turns_about_z) {
  const auto trajectory = trajectory_through(read("2 1 2 3 90\n0.5 4 5 6 0\n"));
  ASSERT_EQ(trajectory.points.size(), 2u);
  EXPECT_EQ(trajectory.joint_names, std::vector<std::string>{"base_link"});
  EXPECT_DOUBLE_EQ(trajectory.points[0].time_from_start.toSec(), 2.0);
  EXPECT_DOUBLE_EQ(trajectory.points[1].time_from_start.toSec(), 2.5);
  const auto& first = trajectory.points[0].transforms.at(0);
  EXPECT_EQ(first.translation.z, 3.0);
  EXPECT_DOUBLE_EQ(first.rotation.z, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(first.rotation.w, std::sqrt(0.5));
}

}  // namespace
}  // namespace trident::control
