// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/potential_topic.h"

#include <algorithm>
#include <cmath>

#include "trident_nav_ros/frames.h"
#include "trident_nav_ros/point_cloud.h"

namespace trident::nav {
namespace {

float greatest_of(const std::vector<float>& potential) {
  float greatest = 0.0F;
  for (const float value : potential) {
    if (std::isfinite(value)) greatest = std::max(greatest, value);
  }
  return greatest;
}

}  // namespace

sensor_msgs::PointCloud2 potential_cloud(const std::vector<float>& potential,
                                         const GridGeometry& geometry,
                                         const std_msgs::Header& header) {
  constexpr float kHeight_m = 20.0F;  // upstream's
  const float greatest = std::max(greatest_of(potential), 1e-6F);
  PointCloudWriter cloud({"x", "y", "z", "pot_value"});
  for (Cell cell{0, 0}; cell.y < geometry.height; ++cell.y) {
    for (cell.x = 0; cell.x < geometry.width; ++cell.x) {
      const float value = potential[geometry.index(cell)];
      if (!std::isfinite(value)) continue;
      const Point2 center = geometry.center(cell);
      cloud.add({static_cast<float>(center.x), static_cast<float>(center.y),
                 kHeight_m * value / greatest, value});
    }
  }
  return cloud.message(header);
}

nav_msgs::OccupancyGrid potential_grid(const std::vector<float>& potential,
                                       const GridGeometry& geometry, int greatest,
                                       const std_msgs::Header& header) {
  const float top = std::max(greatest_of(potential), 1e-6F);
  nav_msgs::OccupancyGrid message;
  message.header = header;
  message.info.resolution = static_cast<float>(geometry.resolution);
  message.info.width = static_cast<std::uint32_t>(geometry.width);
  message.info.height = static_cast<std::uint32_t>(geometry.height);
  message.info.origin = to_message(Pose2{geometry.origin_x, geometry.origin_y, 0.0});
  message.data.reserve(potential.size());
  for (const float value : potential) {
    const bool is_known = std::isfinite(value);
    const float shown = static_cast<float>(greatest) * value / top;
    message.data.push_back(is_known ? static_cast<std::int8_t>(shown) : std::int8_t{-1});
  }
  return message;
}

PotentialTopic::PotentialTopic(ros::NodeHandle node, const std::string& plugin)
    : is_cloud_(plugin.find("avfn") != std::string::npos) {
  publisher_ = is_cloud_ ? node.advertise<sensor_msgs::PointCloud2>("potential", 1)
                         : node.advertise<nav_msgs::OccupancyGrid>("potential", 1);
}

void PotentialTopic::publish(const PotentialSource* source, const GridGeometry& geometry,
                             const std_msgs::Header& header) {
  if (source == nullptr || publisher_.getNumSubscribers() == 0) return;
  const PotentialDisplay display = source->display();
  const std::vector<float> potential =
      display.is_wanted ? source->potential() : std::vector<float>{};
  if (potential.size() != geometry.size()) return;
  if (is_cloud_) {
    publisher_.publish(potential_cloud(potential, geometry, header));
  } else {
    publisher_.publish(potential_grid(potential, geometry, display.greatest, header));
  }
}

}  // namespace trident::nav
