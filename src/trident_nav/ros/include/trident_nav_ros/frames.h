// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Path.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>

#include "trident_base/se3.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// A frame's name without the slash before it that ROS 1 launch files still have.
std::string frame_name(const std::string& name);

SE3 to_se3(const geometry_msgs::Transform& transform);
Pose2 to_pose2(const geometry_msgs::Transform& transform);
Pose2 to_pose2(const geometry_msgs::Pose& pose);
geometry_msgs::Pose to_message(const Pose2& pose);
/// A path whose poses are stamped as it is itself.
nav_msgs::Path path_message(const Path& path, const std::string& frame, double now_s);
/// `pose` is given in the axes of `frame`.
Pose2 placed_in(const Pose2& frame, const Pose2& pose);

/// The newest pose of a frame in another. Empty, with a sentence that names both frames and what is
/// wrong, when tf has none, or one older than `tolerance_s`. `stamp_s` gets its time; now if it is
/// static.
std::optional<Pose2> newest_pose(const tf2::BufferCore& buffer, const std::string& target,
                                 const std::string& source, double now_s, double tolerance_s,
                                 std::string* problem, double* stamp_s = nullptr);

}  // namespace trident::nav
