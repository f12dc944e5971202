// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Vector3.h>
#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>

#include <cstdint>
#include <string>

// Checks of incoming messages, so that no algorithm gets a number that is not finite. Each function
// returns an empty text, or what is wrong: the field, its value, what is legal.

namespace trident::ros_utils {

/// Largest legal coordinate [m]; the earth's center is 6.4e6 m away.
inline constexpr double kFarthestM = 1e8;
/// ros::Duration counts its seconds in 32 bits with a sign: two stamps below this can be subtracted
/// from each other, and to each a duration can be added, without ROS throwing.
inline constexpr std::uint32_t kLatestStampS = 2'147'000'000;
/// Largest legal lead of a stamp over the clock [s].
inline constexpr double kMaxAheadS = 86'400.0;
/// Longest legal duration of a sweep [s].
inline constexpr double kLongestSweepS = 60.0;

/// `now`: of the clock; zero: it is not known yet.
std::string stamp_problem(const ros::Time& stamp, const ros::Time& now);
/// `name`: of the field, for the text.
std::string number_problem(double value, double most, const std::string& name);
/// Finite, and no coordinate beyond kFarthestM [m]. `name`: of the field, for the text.
std::string point_problem(double x, double y, double z, const std::string& name);
/// Of length 1 within a tolerance.
std::string rotation_problem(const geometry_msgs::Quaternion& q, const std::string& name,
                             double tolerance = 0.01);
/// point_problem() and rotation_problem() of both parts.
std::string pose_problem(const geometry_msgs::Pose& pose);
/// The same; both frames have names, and different ones.
std::string transform_problem(const geometry_msgs::TransformStamped& transform);
/// Angles, ranges' limits and times; single ranges may be anything. A time_increment of NaN, from
/// drivers that know of none, counts as 0.
std::string scan_problem(const sensor_msgs::LaserScan& scan);

/// Text that may quote what a stranger sent: without control characters, and 200 bytes at most.
std::string quoted(const std::string& text);

}  // namespace trident::ros_utils
