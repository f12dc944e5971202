// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>

// Checks of what comes to move_base. Each function that ends in `_problem` returns an empty text,
// or what is wrong: the field, its value, what is legal.

namespace trident::nav {

/// Largest legal speed that odometry reports [m/s] or [rad/s].
inline constexpr double kFastest = 1e4;

/// Of a pose that a robot on the ground can take: finite, turned about the z axis alone.
std::string goal_problem(const geometry_msgs::Pose& pose);
/// Stamp and the velocity in the plane. `now`: of the clock; zero: not known yet.
std::string odometry_problem(const nav_msgs::Odometry& message, const ros::Time& now);
/// Of what an obstacle layer takes; single ranges may be anything.
std::string beams_problem(const sensor_msgs::LaserScan& scan);
/// Whether x, y and z can be read of each point.
std::string cloud_problem(const sensor_msgs::PointCloud2& cloud);

/// The id with a stamp that an action server can count with: actionlib adds to it, and a goal or a
/// cancel request from the future would make it refuse all that come until then. A stamp that is
/// illegal or ahead of `now` becomes `now`; zero, which means none, stays.
actionlib_msgs::GoalID within_time(actionlib_msgs::GoalID id, const ros::Time& now);

}  // namespace trident::nav
