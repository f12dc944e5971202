// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/control_messages.h"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>

#include "trident_nav_ros/potential_topic.h"

namespace trident::nav {
namespace {

std_msgs::Header header() {
  std_msgs::Header header;
  header.frame_id = "odom";
  header.stamp = ros::Time(12, 0);
  return header;
}

ControlDetails two_bands() {
  ControlDetails details;
  details.trajectories = {{{{0.0, {0, 0, 0}, {0.2, 0, 0}}, {0.5, {0.1, 0.1, 0}, {}}}, 5.0},
                          {{{0.0, {0, 0, 0}, {0.2, 0, 0}},
                            {0.5, {0.1, 0, 0}, {0.4, 0, 0.1}},
                            {1.0, {0.3, 0, 0.05}, {}}},
                           2.0}};
  details.selected = 1;
  details.obstacles = {{1.0, 2.0}};
  details.via_points = {{0.5, 0.0}};
  return details;
}

TEST(ControlMessagesTest, FeedbackHasTimesVelocitiesAccelerationsAndObstacles) {
  Track walker;
  walker.position = {2.0, 3.0};
  walker.velocity = {0.0, -1.0};
  walker.radius_m = 0.3;
  const auto message = feedback_message(two_bands(), {walker}, header());
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.selected_trajectory_idx, 1);
  ASSERT_EQ(message.trajectories.size(), 2U);
  const auto& points = message.trajectories[1].trajectory;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1].time_from_start, ros::Duration(0.5));
  EXPECT_DOUBLE_EQ(points[1].velocity.linear.x, 0.4);
  EXPECT_DOUBLE_EQ(points[0].acceleration.linear.x, 0.4);
  EXPECT_DOUBLE_EQ(points[0].acceleration.angular.z, 0.2);
  const auto& obstacles = message.obstacles_msg.obstacles;
  ASSERT_EQ(obstacles.size(), 2U);
  EXPECT_EQ(obstacles[0].polygon.points[0].y, 2.0F);
  EXPECT_EQ(obstacles[1].velocities.twist.linear.y, -1.0);
  EXPECT_EQ(obstacles[1].radius, 0.3);
}

TEST(ControlMessagesTest, MarkersHaveUpstreamsNamespaces) {
  const auto bands = band_markers(two_bands(), header());
  ASSERT_EQ(bands.size(), 4U);
  EXPECT_EQ(bands[0].ns, "TebContainer");
  EXPECT_EQ(bands[0].points.size(), 6U);  // three segments
  EXPECT_EQ(bands[1].points.size(), 4U);
  EXPECT_EQ(bands[2].ns, "PointObstacles");
  EXPECT_EQ(bands[3].points.size(), 1U);
  const auto fan = fan_markers(two_bands(), header());
  ASSERT_EQ(fan.markers.size(), 2U);
  EXPECT_EQ(fan.markers[0].points.size(), 2U);
  EXPECT_EQ(fan.markers[0].colors.size(), 2U);
  EXPECT_EQ(fan.markers[1].points.size(), 4U);
}

TEST(ControlMessagesTest, CloudsHaveUpstreamsFields) {
  ControlDetails details = two_bands();
  details.cells = {{{0.5, 1.5}, 1.0, 2.0, 30.0, 4.0}};
  const auto costs = cost_cloud(details, header());
  ASSERT_EQ(costs.width, 1U);
  EXPECT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(costs, "occ_cost"), 30.0F);
  EXPECT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(costs, "total_cost"), 4.0F);
  const auto trajectories = trajectory_cloud(details, header());
  EXPECT_EQ(trajectories.width, 5U);
  EXPECT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(trajectories, "cost"), 5.0F);
}

costmap_converter::ObstacleArrayMsg one_obstacle() {
  costmap_converter::ObstacleArrayMsg message;
  message.header.stamp = ros::Time(99, 0);
  message.obstacles.resize(1);
  message.obstacles[0].polygon.points.resize(1);
  message.obstacles[0].radius = 0.2;
  return message;
}

TEST(ControlMessagesTest, ReportedObstaclesNameTheItemAndFieldThatIsNotLegal) {
  const ros::Time now(100, 0);
  EXPECT_EQ(obstacles_problem(one_obstacle(), now), "");
  auto message = one_obstacle();
  message.obstacles[0].radius = -1.0;
  EXPECT_EQ(obstacles_problem(message, now), "obstacles[0]: radius = -1 m, legal: 0 to 1000");
  message = one_obstacle();
  message.obstacles[0].polygon.points[0].x = NAN;
  EXPECT_NE(obstacles_problem(message, now).find("obstacles[0]: polygon is (nan"),
            std::string::npos);
  message.obstacles[0].polygon.points.clear();
  EXPECT_EQ(obstacles_problem(message, now),
            "obstacles[0]: polygon has no points, legal: at least one");
  message = one_obstacle();
  message.obstacles[0].velocities.twist.linear.y = INFINITY;
  EXPECT_NE(obstacles_problem(message, now).find("velocities.linear.y is inf"), std::string::npos);
  nav_msgs::Path points;
  points.poses.resize(2);
  points.poses[1].pose.position.y = NAN;
  EXPECT_NE(via_points_problem(points).find("poses[1]: position"), std::string::npos);
}

TEST(PotentialMessagesTest, KeepScaleAndGaps) {
  const GridGeometry geometry{2, 1, 0.5, -1.0, 0.0};
  const std::vector<float> potential = {50.0F, INFINITY};
  const auto grid = potential_grid(potential, geometry, 80, header());
  EXPECT_EQ(grid.data, (std::vector<std::int8_t>{80, -1}));
  EXPECT_EQ(grid.info.origin.position.x, -1.0);
  const auto cloud = potential_cloud(potential, geometry, header());
  ASSERT_EQ(cloud.width, 1U);
  EXPECT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(cloud, "x"), -0.75F);
  EXPECT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(cloud, "pot_value"), 50.0F);
}

}  // namespace
}  // namespace trident::nav
