// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_map_input.h"

#include <nav_msgs/GetMap.h>
#include <nav_msgs/SetMap.h>

#include <utility>

namespace trident::estimation {
namespace {

constexpr double kPollPeriod_s = 0.5;  // wall time

}  // namespace

AmclMapInput::AmclMapInput(ros::NodeHandle& node, const AmclNodeParams& params, OnMap on_map,
                           OnPose on_pose)
    : on_map_(std::move(on_map)), on_pose_(std::move(on_pose)) {
  const boost::function<bool(nav_msgs::SetMap::Request&, nav_msgs::SetMap::Response&)> set_map =
      [this](nav_msgs::SetMap::Request& request, nav_msgs::SetMap::Response& response) {
        const bool is_taken = on_map_(request.map);
        has_map_ = has_map_ || is_taken;
        response.success = static_cast<std::uint8_t>(is_taken);
        if (is_taken) on_pose_(request.initial_pose);
        return true;
      };
  set_map_ = node.advertiseService("set_map", set_map);
  if (params.use_map_topic) {
    topic_ = node.subscribe<nav_msgs::OccupancyGrid>(
        "map", 1,
        [this,
         takes_first_only = params.first_map_only](const nav_msgs::OccupancyGridConstPtr& message) {
          if (!has_map_ || !takes_first_only) take(*message);
        });
    return;
  }
  static_map_ = node.serviceClient<nav_msgs::GetMap>("static_map");
  timer_ = node.createWallTimer(ros::WallDuration(kPollPeriod_s),
                                [this](const ros::WallTimerEvent&) { poll_static_map(); });
}

void AmclMapInput::take(const nav_msgs::OccupancyGrid& message) {
  const bool is_taken = on_map_(message);
  has_map_ = has_map_ || is_taken;
}

void AmclMapInput::poll_static_map() {
  nav_msgs::GetMap get;
  if (!has_map_ && static_map_.exists() && static_map_.call(get)) take(get.response.map);
  if (has_map_) timer_.stop();
}

}  // namespace trident::estimation
