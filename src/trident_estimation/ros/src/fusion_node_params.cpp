// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/fusion_node_params.h"

#include <utility>

#include "trident_base/error.h"

namespace trident::estimation {
namespace {

void check_names(const FusionRangeParams& range,
                 const std::map<std::string, FusionRobotParams>& robots) {
  for (const std::string& name : {range.robot, range.other}) {
    if (robots.count(name) == 0) {
      throw Error("parameter ranges: '" + name + "' is not a robot of the team");
    }
  }
  if (range.robot == range.other) {
    throw Error("parameter ranges: '" + range.robot + "' has no distance to itself");
  }
}

}  // namespace

void FusionNodeParams::validate() const {
  const auto robots = all_robots();
  if (robots.empty()) {
    throw Error(
        "no robot is given; legal: uav_pose_topic, ugv_pose_topic, usv_pose_topic, or robots");
  }
  for (const FusionRangeParams& range : ranges) check_names(range, robots);
  if (common_frame.empty()) throw Error("parameter common_frame is empty, legal: a frame");
}

std::map<std::string, FusionRobotParams> FusionNodeParams::all_robots() const {
  std::map<std::string, FusionRobotParams> all = robots;
  const std::pair<const char*, const std::string&> named[] = {
      {"uav", uav_pose_topic}, {"ugv", ugv_pose_topic}, {"usv", usv_pose_topic}};
  for (const auto& [name, topic] : named) {
    if (topic.empty()) continue;
    FusionRobotParams& robot = all[name];
    robot.pose_topic = topic;
    if (robot.kind.empty()) robot.kind = name;
  }
  return all;
}

TeamFusionOptions FusionNodeParams::options() const {
  TeamFusionOptions options;
  options.kind = fusion_method == 0 ? FilterKind::kEkf : FilterKind::kUkf;
  options.keep = SimTime::from_seconds(keep);
  options.start_patience = SimTime::from_seconds(start_patience);
  options.gate = gate;
  return options;
}

RobotStart robot_start(const FusionRobotParams& params) {
  RobotStart start;
  start.motion = {params.speed,    params.turn,      params.speed_time, params.turn_time,
                  params.leveling, params.map_drift, params.map_turn};
  start.p_world_map = params.map_start.head<3>();
  start.yaw_world_map = params.map_start(3);
  start.map_sigma = params.map_sigma;
  start.map_yaw_sigma = params.map_yaw_sigma;
  return start;
}

}  // namespace trident::estimation
