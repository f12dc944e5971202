// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>
#include <string>
#include <vector>

#include "trident_estimation/filter/filter.h"

namespace trident::estimation {

/// A robot as others know it.
struct FusedRobot {
  std::string name, kind;  ///< the name is the namespace of its topics
};

/// Publishes `team/state`, `<name>/team_pose`, and common_frame -> <name>/map where it is to.
class FusionOutput {
 public:
  /// Advertises at once. `is_fused`: whether transforms are published.
  FusionOutput(ros::NodeHandle& node, std::vector<FusedRobot> robots, std::string common_frame,
               bool is_fused);

  /// A belief about all robots at that moment. `heard`: the stamp of each one's newest pose.
  void publish(const ros::Time& stamp, const Filter& belief,
               const std::vector<std::optional<ros::Time>>& heard);

  /// The frame of a robot's map.
  static std::string map_frame(const std::string& name) { return name + "/map"; }

 private:
  std::vector<FusedRobot> robots_;
  std::string common_frame_;
  bool is_fused_;
  ros::Publisher state_;
  std::vector<ros::Publisher> poses_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace trident::estimation
