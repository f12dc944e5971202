// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Shows the marked voxels of `voxel_grid` (costmap_2d/VoxelGrid) as cubes on `visualization_marker`
// (visualization_msgs/Marker), under the name and topics of upstream's program.
#include <costmap_2d/VoxelGrid.h>
#include <ros/ros.h>
#include <visualization_msgs/Marker.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace {

constexpr unsigned kMarks = 16;  // the bit of the lowest voxel that says that it is marked

void add_column(const costmap_2d::VoxelGrid& grid, std::size_t cell,
                visualization_msgs::Marker* marker) {
  const std::uint32_t marks = grid.data[cell] >> kMarks;
  const auto column = static_cast<double>(cell % grid.size_x);
  const auto row = static_cast<double>(cell / grid.size_x);
  for (unsigned level = 0; level < std::min<unsigned>(grid.size_z, kMarks); ++level) {
    if ((marks >> level & 1U) == 0) continue;
    geometry_msgs::Point center;
    center.x = static_cast<double>(grid.origin.x) + (column + 0.5) * grid.resolutions.x;
    center.y = static_cast<double>(grid.origin.y) + (row + 0.5) * grid.resolutions.y;
    center.z = static_cast<double>(grid.origin.z) + (level + 0.5) * grid.resolutions.z;
    marker->points.push_back(center);
  }
}

bool is_finite(const geometry_msgs::Point32& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// Empty, or what is wrong with a grid.
std::string problem_of(const costmap_2d::VoxelGrid& grid) {
  const geometry_msgs::Vector3& sides = grid.resolutions;
  for (const double side : {sides.x, sides.y, sides.z}) {
    if (!(side > 0.0 && side < 1e3)) {
      return "resolutions has " + std::to_string(side) + " m, legal: above 0, below 1000";
    }
  }
  if (!is_finite(grid.origin)) return "origin is not finite";
  const std::size_t cells = std::size_t{grid.size_x} * grid.size_y;
  if (grid.data.size() == cells) return "";
  return "data has " + std::to_string(grid.data.size()) +
         " columns, legal: size_x * size_y = " + std::to_string(cells);
}

visualization_msgs::Marker cubes_of(const costmap_2d::VoxelGrid& grid) {
  visualization_msgs::Marker marker;
  marker.header = grid.header;
  marker.ns = ros::this_node::getName();
  marker.type = visualization_msgs::Marker::CUBE_LIST;
  marker.pose.orientation.w = 1.0;
  marker.scale = grid.resolutions;
  marker.color.r = 1.0F;
  marker.color.a = 1.0F;
  const std::size_t cells = std::size_t{grid.size_x} * grid.size_y;
  for (std::size_t cell = 0; cell < cells; ++cell) add_column(grid, cell, &marker);
  return marker;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "costmap_2d_markers");
  ros::NodeHandle node;
  const ros::Publisher markers =
      node.advertise<visualization_msgs::Marker>("visualization_marker", 1);
  const boost::function<void(const costmap_2d::VoxelGridConstPtr&)> show =
      [&markers](const costmap_2d::VoxelGridConstPtr& grid) {
        const std::string problem = problem_of(*grid);
        if (problem.empty()) {
          markers.publish(cubes_of(*grid));
        } else {
          ROS_ERROR_THROTTLE(5.0, "voxel_grid is not shown: %s", problem.c_str());
        }
      };
  const ros::Subscriber grids = node.subscribe<costmap_2d::VoxelGrid>("voxel_grid", 1, show);
  ros::spin();
  return 0;
}
