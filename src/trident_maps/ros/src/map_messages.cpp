// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_maps_ros/map_messages.h"

#include <cmath>
#include <limits>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_ros/message_checks.h"

namespace trident::maps {
namespace {

/// A resolution outside of these is an error of a field or of its unit, not a map.
constexpr double kFinest = 1e-4;   // of a map's cells [m]
constexpr double kCoarsest = 1e3;  // [m]

}  // namespace

geometry_msgs::Pose to_pose_message(const SE2& T_parent_child) {
  geometry_msgs::Pose pose;
  pose.position.x = T_parent_child.p.x();
  pose.position.y = T_parent_child.p.y();
  pose.orientation.z = std::sin(0.5 * T_parent_child.angle);
  pose.orientation.w = std::cos(0.5 * T_parent_child.angle);
  return pose;
}

/// Of a pose in the plane: roll and pitch are dropped, as map_server's origin has none. A
/// quaternion that is far from unit length is refused, since it says nothing about the heading.
SE2 from_pose_message(const geometry_msgs::Pose& pose) {
  const Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                             pose.orientation.z);
  const Eigen::Vector2d p(pose.position.x, pose.position.y);
  if (!(std::abs(p.x()) <= ros_utils::kFarthestM && std::abs(p.y()) <= ros_utils::kFarthestM) ||
      !(std::abs(q.norm() - 1.0) < 0.01)) {
    throw Error("pose: position (" + number_text(p.x()) + ", " + number_text(p.y()) +
                ") m, quaternion of length " + number_text(q.norm()) + ", legal: finite, up to " +
                number_text(ros_utils::kFarthestM) + " m, length 1");
  }
  const double yaw = std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                                1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
  return SE2::from_xy_yaw(p.x(), p.y(), yaw);
}

nav_msgs::OccupancyGrid to_map_message(const OccupancyGrid& grid, const std_msgs::Header& header) {
  nav_msgs::OccupancyGrid message;
  message.header = header;
  message.info.map_load_time = header.stamp;
  message.info.resolution = static_cast<float>(grid.resolution);
  message.info.width = static_cast<std::uint32_t>(grid.width);
  message.info.height = static_cast<std::uint32_t>(grid.height);
  message.info.origin = to_pose_message(grid.T_map_origin);
  message.data = grid.cells;
  return message;
}

namespace {

void check_size(const nav_msgs::OccupancyGrid& message) {
  const std::uint64_t width = message.info.width, height = message.info.height;
  if (width == 0 || height == 0 || width > std::numeric_limits<int>::max() / height ||
      message.data.size() != width * height) {
    throw Error("map: " + std::to_string(message.data.size()) + " cells, legal: width x height, " +
                std::to_string(width) + " x " + std::to_string(height) + ", at least 1 x 1");
  }
}

}  // namespace

OccupancyGrid from_map_message(const nav_msgs::OccupancyGrid& message) {
  check_size(message);
  const auto resolution = static_cast<double>(message.info.resolution);
  if (!(resolution >= kFinest && resolution <= kCoarsest)) {
    throw Error("map: resolution " + number_text(resolution) +
                " m, legal: " + number_text(kFinest) + " to " + number_text(kCoarsest) + " m");
  }
  OccupancyGrid grid;
  grid.width = static_cast<int>(message.info.width);
  grid.height = static_cast<int>(message.info.height);
  // A float on the wire: 0.05 is meant, not 0.0500000007.
  grid.resolution = std::round(resolution * 1e6) / 1e6;
  grid.T_map_origin = from_pose_message(message.info.origin);
  grid.cells = message.data;
  return grid;
}

}  // namespace trident::maps
