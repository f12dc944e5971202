// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/input_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "trident_base/string_util.h"
#include "trident_ros/message_checks.h"

namespace trident::nav {
namespace {

constexpr double kLengthTolerance = 0.05;
constexpr double kMinUp = 1.0 - 1e-3;  // z of the turned z axis

std::string tilt_problem(const geometry_msgs::Quaternion& q) {
  const double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  const double up = 1.0 - 2.0 * (q.x * q.x + q.y * q.y) / square;
  if (up > kMinUp) return "";
  return "orientation has x = " + number_text(q.x) + ", y = " + number_text(q.y) +
         ", legal: 0, a turn about the z axis";
}

// Of one coordinate of a cloud's points.
std::string field_problem(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&](const auto& one) { return one.name == name; });
  if (field == cloud.fields.end()) return "fields: there is no " + name;
  if (field->datatype != sensor_msgs::PointField::FLOAT32) {
    return "field " + name + " has datatype " + std::to_string(field->datatype) +
           ", legal: 7, FLOAT32";
  }
  if (std::uint64_t{field->offset} + sizeof(float) <= cloud.point_step) return "";
  return "field " + name + " has offset " + std::to_string(field->offset) +
         ", legal: up to point_step - 4 = " + std::to_string(std::int64_t{cloud.point_step} - 4);
}

// Of a scan that was cut: far fewer ranges than its angles say.
std::string count_problem(const sensor_msgs::LaserScan& scan) {
  const auto span = static_cast<double>(scan.angle_max) - static_cast<double>(scan.angle_min);
  const double steps = span / static_cast<double>(scan.angle_increment);
  if (!(steps > 0.0 && steps < 1e7)) return "";  // angle_max is often left out
  const double expected = std::round(steps) + 1.0;
  const double tolerated = std::max(2.0, 0.02 * expected);
  if (static_cast<double>(scan.ranges.size()) >= expected - tolerated) return "";
  return "ranges has " + std::to_string(scan.ranges.size()) +
         " beams, legal: " + number_text(expected) +
         ", as angle_min, angle_max and angle_increment say";
}

// For texts: without the digits that a float does not have.
double rounded(float value) {
  constexpr double kDigits = 1e6;
  return std::round(static_cast<double>(value) * kDigits) / kDigits;
}

// Of a scan in which no beam says anything: a lidar that is covered or broken.
std::string blindness_problem(const sensor_msgs::LaserScan& scan) {
  const bool sees = std::any_of(scan.ranges.begin(), scan.ranges.end(),
                                [&](float range) { return range >= scan.range_min; });
  if (sees) return "";
  return "all " + std::to_string(scan.ranges.size()) +
         " ranges are NaN or below range_min = " + number_text(rounded(scan.range_min)) +
         " m, legal: at least one that is not";
}

}  // namespace

std::string goal_problem(const geometry_msgs::Pose& pose) {
  const geometry_msgs::Point& p = pose.position;
  std::string problem = ros_utils::point_problem(p.x, p.y, p.z, "position");
  if (problem.empty()) {
    problem = ros_utils::rotation_problem(pose.orientation, "orientation", kLengthTolerance);
  }
  return problem.empty() ? tilt_problem(pose.orientation) : problem;
}

std::string odometry_problem(const nav_msgs::Odometry& message, const ros::Time& now) {
  const geometry_msgs::Twist& twist = message.twist.twist;
  std::string problem = ros_utils::stamp_problem(message.header.stamp, now);
  if (problem.empty()) problem = ros_utils::number_problem(twist.linear.x, kFastest, "linear.x");
  if (problem.empty()) problem = ros_utils::number_problem(twist.linear.y, kFastest, "linear.y");
  if (!problem.empty()) return problem;
  return ros_utils::number_problem(twist.angular.z, kFastest, "angular.z");
}

std::string beams_problem(const sensor_msgs::LaserScan& scan) {
  std::string problem = ros_utils::scan_problem(scan);
  if (!problem.empty()) return problem;
  if (!(scan.range_min >= 0.0F && std::isfinite(scan.range_max))) {
    return "range_min is " + number_text(scan.range_min) + " m, range_max " +
           number_text(scan.range_max) + " m, legal: 0 <= range_min < range_max, finite";
  }
  problem = count_problem(scan);
  return problem.empty() ? blindness_problem(scan) : problem;
}

std::string cloud_problem(const sensor_msgs::PointCloud2& cloud) {
  for (const char* name : {"x", "y", "z"}) {
    std::string problem = field_problem(cloud, name);
    if (!problem.empty()) return problem;
  }
  // Of numbers below 2^32, so that the product of three may go beyond 64 bits.
  const double needed = static_cast<double>(cloud.width) * cloud.height * cloud.point_step;
  if (needed == static_cast<double>(cloud.data.size())) return "";
  return "data has " + std::to_string(cloud.data.size()) + " bytes, legal: width * height * " +
         "point_step = " + number_text(needed);
}

actionlib_msgs::GoalID within_time(actionlib_msgs::GoalID id, const ros::Time& now) {
  // Before the first message of a simulated clock, `now` is the zero that means no stamp.
  const ros::Time latest = now.isZero() ? ros::Time(0, 1) : now;
  if (!ros_utils::stamp_problem(id.stamp, {}).empty() || id.stamp > latest) id.stamp = latest;
  return id;
}

}  // namespace trident::nav
