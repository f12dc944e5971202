// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/frames.h"

#include <tf2/exceptions.h>

#include <cmath>
#include <utility>

#include "trident_base/string_util.h"

namespace trident::nav {

std::string frame_name(const std::string& name) {
  return !name.empty() && name.front() == '/' ? name.substr(1) : name;
}

SE3 to_se3(const geometry_msgs::Transform& transform) {
  SE3 result;
  result.p = {transform.translation.x, transform.translation.y, transform.translation.z};
  result.R = Eigen::Quaterniond(transform.rotation.w, transform.rotation.x, transform.rotation.y,
                                transform.rotation.z)
                 .normalized();
  return result;
}

Pose2 to_pose2(const geometry_msgs::Transform& transform) {
  const SE3 pose = to_se3(transform);
  return {pose.p.x(), pose.p.y(), pose.rpy().z()};
}

Pose2 to_pose2(const geometry_msgs::Pose& pose) {
  geometry_msgs::Transform transform;
  transform.translation.x = pose.position.x;
  transform.translation.y = pose.position.y;
  transform.rotation = pose.orientation;
  return to_pose2(transform);
}

geometry_msgs::Pose to_message(const Pose2& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation.z = std::sin(0.5 * pose.yaw);
  message.orientation.w = std::cos(0.5 * pose.yaw);
  return message;
}

nav_msgs::Path path_message(const Path& path, const std::string& frame, double now_s) {
  nav_msgs::Path message;
  message.header.frame_id = frame;
  message.header.stamp.fromSec(now_s);
  for (const Pose2& pose : path) {
    geometry_msgs::PoseStamped stamped;
    stamped.header = message.header;
    stamped.pose = to_message(pose);
    message.poses.push_back(std::move(stamped));
  }
  return message;
}

Pose2 placed_in(const Pose2& frame, const Pose2& pose) {
  const Point2 p = transform(frame, {pose.x, pose.y});
  return {p.x, p.y, wrap_angle(frame.yaw + pose.yaw)};
}

std::optional<Pose2> newest_pose(const tf2::BufferCore& buffer, const std::string& target,
                                 const std::string& source, double now_s, double tolerance_s,
                                 std::string* problem, double* stamp_s) {
  try {
    const geometry_msgs::TransformStamped found =
        buffer.lookupTransform(target, source, ros::Time(0));
    const double age_s = now_s - found.header.stamp.toSec();
    if (stamp_s != nullptr) *stamp_s = found.header.stamp.isZero() ? now_s : now_s - age_s;
    if (found.header.stamp.isZero() || age_s <= tolerance_s) return to_pose2(found.transform);
    *problem = "the newest transform from " + source + " to " + target + " is " +
               number_text(std::round(age_s * 1e3) / 1e3) + " s old, transform_tolerance is " +
               number_text(tolerance_s) + " s";
  } catch (const tf2::TransformException& error) {
    *problem = "there is no transform from " + source + " to " + target + ": " + error.what();
  }
  return std::nullopt;
}

}  // namespace trident::nav
