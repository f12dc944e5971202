// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/map_server.h"

#include <utility>

#include "trident_base/error.h"
#include "trident_maps_ros/map_messages.h"

namespace trident::slam {

MapServer::MapServer(ros::NodeHandle node, ros::NodeHandle own, const SlamNodeOptions& options,
                     GuardedSlam& slam, OnProblem on_problem)
    : frame_(options.map_frame),
      slam_(slam),
      on_problem_(std::move(on_problem)),
      publisher_(node, options.map_topic,
                 {options.map_update_interval, options.map_changes_interval}),
      service_(own.advertiseService("dynamic_map", &MapServer::get_map, this)) {}

void MapServer::publish_if_due(const ros::Time& now) {
  if (task_.is_busy() || !publisher_.is_due(now)) return;
  task_.start([this, now, draw = slam_.map_snapshot()] {
    try {
      publisher_.publish(to_message(draw()), now);
    } catch (const Error& error) {
      on_problem_(error.what());
    }
  });
}

nav_msgs::OccupancyGrid MapServer::to_message(const OccupancyGrid& map) const {
  std_msgs::Header header;
  header.frame_id = frame_;
  header.stamp = ros::Time::now();
  return maps::to_map_message(map, header);
}

bool MapServer::get_map(nav_msgs::GetMap::Request& /*request*/,
                        nav_msgs::GetMap::Response& response) {
  response.map = message();
  return true;
}

}  // namespace trident::slam
