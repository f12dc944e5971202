// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <costmap_converter/ObstacleArrayMsg.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <tf2/buffer_core.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "trident_nav/control/controller.h"
#include "trident_nav/control/moving_obstacles.h"
#include "trident_ros/refusals.h"

namespace trident::nav {

/// The topics of a local planner below its name, under upstream's names. All have `local_plan`, and
/// hear `obstacles` (costmap_converter/ObstacleArrayMsg) and `via_points` (nav_msgs/Path) in any
/// frame of tf. TEB has `teb_poses`, `teb_markers` and `teb_feedback`; DWA and TrajectoryPlanner
/// `cost_cloud` and `trajectory_cloud`; MPPI `trajectories` and `optimal_trajectory`. What nobody
/// listens to is not computed.
class ControlTopics {
 public:
  /// `node`: of the local planner's name; `frame`: the local costmap's. What is referred to
  /// outlives it.
  ControlTopics(ros::NodeHandle node, const std::string& plugin, std::string frame,
                const tf2::BufferCore& buffer, ros_utils::Refusals& refusals);

  /// Before a command: hands over what was heard, and what the controller is to note. From the
  /// thread that commands, as publish().
  void prepare(double now_s, Controller& controller, MovingObstacles& moving);
  /// After it. `moving`: what the command was given.
  void publish(const Controller& controller, const Tracks& moving);

 private:
  void hear(ros::NodeHandle& node);
  void advertise(ros::NodeHandle& node, const std::string& plugin);
  void take_obstacles(double now_s, MovingObstacles& moving);
  std::optional<std::vector<Point2>> via_points(double now_s);
  void publish_bands(const ControlDetails& details, const Tracks& moving,
                     const std_msgs::Header& header);
  void publish_considered(const ControlDetails& details, const std_msgs::Header& header);
  void publish_selected(const ConsideredTrajectory& selected, const std_msgs::Header& header);

  std::string frame_;
  const tf2::BufferCore& buffer_;
  ros_utils::Refusals& refusals_;
  /// Those that the plugin does not have are empty.
  struct Publishers {
    ros::Publisher local_plan, teb_poses, teb_markers, teb_feedback;
    ros::Publisher cost_cloud, trajectory_cloud, trajectories, optimal;
  };
  Publishers out_;
  ros::Subscriber obstacles_in_, via_points_in_;
  std::optional<double> published_s_;  ///< Of the command that was published last.
  std::mutex mutex_;                   // guards what follows
  struct Heard {
    costmap_converter::ObstacleArrayMsgConstPtr obstacles;  ///< Not yet handed over.
    nav_msgs::PathConstPtr via_points;                      ///< The newest ones.
  };
  Heard heard_;
};

}  // namespace trident::nav
