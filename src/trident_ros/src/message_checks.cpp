// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/message_checks.h"

#include <cmath>
#include <cstdio>

#include "trident_base/string_util.h"

namespace trident::ros_utils {
namespace {

constexpr std::size_t kLongestQuote = 200;
constexpr std::uint32_t kNanosecondsPerSecond = 1'000'000'000;
constexpr double kOfTf2 = 0.0049;        // tf2 checks the square of the length to 1 %
constexpr double kLargestAngle = 100.0;  // [rad]: several turns: some drivers report such

/// As tf2 takes it.
std::string without_slash(const std::string& frame) {
  return frame.empty() || frame.front() != '/' ? frame : frame.substr(1);
}

std::string fixed(double value) {
  char text[64];  // NOLINT: of snprintf
  std::snprintf(text, sizeof(text), "%.3f", value);
  return text;
}

}  // namespace

std::string stamp_problem(const ros::Time& stamp, const ros::Time& now) {
  if (stamp.nsec >= kNanosecondsPerSecond) {
    return "stamp has " + std::to_string(stamp.nsec) + " ns, legal: below 1000000000";
  }
  if (stamp.sec >= kLatestStampS) {
    return "stamp is " + fixed(stamp.toSec()) + " s, legal: below " +
           std::to_string(kLatestStampS) + " s";
  }
  if (now.isZero() || now.sec >= kLatestStampS) return "";
  const double ahead = (stamp - now).toSec();
  if (ahead <= kMaxAheadS) return "";
  return "stamp is " + fixed(ahead) + " s ahead of the clock, legal: up to " +
         number_text(kMaxAheadS) + " s";
}

std::string number_problem(double value, double most, const std::string& name) {
  if (std::abs(value) <= most) return "";
  return name + " is " + number_text(value) + ", legal: up to +-" + number_text(most);
}

std::string point_problem(double x, double y, double z, const std::string& name) {
  if (std::abs(x) <= kFarthestM && std::abs(y) <= kFarthestM && std::abs(z) <= kFarthestM)
    return "";
  return name + " is (" + number_text(x) + ", " + number_text(y) + ", " + number_text(z) +
         ") m, legal: finite, up to +-" + number_text(kFarthestM) + " m";
}

std::string rotation_problem(const geometry_msgs::Quaternion& q, const std::string& name,
                             double tolerance) {
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (std::abs(length - 1.0) < tolerance) return "";
  return name + " is a quaternion of length " + number_text(length) + ", legal: 1";
}

std::string pose_problem(const geometry_msgs::Pose& pose) {
  const auto& p = pose.position;
  const std::string problem = point_problem(p.x, p.y, p.z, "position");
  return problem.empty() ? rotation_problem(pose.orientation, "orientation") : problem;
}

std::string transform_problem(const geometry_msgs::TransformStamped& transform) {
  const std::string parent = without_slash(transform.header.frame_id);
  const std::string child = without_slash(transform.child_frame_id);
  if (parent.empty() || child.empty()) return "a frame without a name";
  if (parent == child) return "both frames are the same";
  const auto& p = transform.transform.translation;
  const std::string problem = point_problem(p.x, p.y, p.z, "translation");
  return problem.empty() ? rotation_problem(transform.transform.rotation, "rotation", kOfTf2)
                         : problem;
}

namespace {

std::string angles_problem(const sensor_msgs::LaserScan& scan) {
  const std::string problem = number_problem(scan.angle_min, kLargestAngle, "angle_min");
  return problem.empty() ? number_problem(scan.angle_increment, kLargestAngle, "angle_increment")
                         : problem;
}

std::string sweep_problem(const sensor_msgs::LaserScan& scan) {
  const double lasts =
      static_cast<double>(scan.time_increment) * static_cast<double>(scan.ranges.size());
  if (std::isnan(lasts) || std::abs(lasts) <= kLongestSweepS) return "";
  return "time_increment is " + number_text(scan.time_increment) + " s for " +
         std::to_string(scan.ranges.size()) + " beams, legal: a sweep of up to " +
         number_text(kLongestSweepS) + " s";
}

}  // namespace

std::string scan_problem(const sensor_msgs::LaserScan& scan) {
  if (scan.ranges.empty()) return "ranges: no beam, legal: at least 1";
  std::string of_angles = angles_problem(scan);
  if (!of_angles.empty()) return of_angles;
  if (!(scan.range_max > 0.0F) || !(scan.range_min < scan.range_max)) {
    return "range_min " + number_text(scan.range_min) + " m, range_max " +
           number_text(scan.range_max) + " m, legal: 0 <= range_min < range_max";
  }
  return sweep_problem(scan);
}

std::string quoted(const std::string& text) {
  std::string result = text.substr(0, kLongestQuote);
  for (char& letter : result) {
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F) letter = '?';
  }
  return text.size() > kLongestQuote ? result + "..." : result;
}

}  // namespace trident::ros_utils
