// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/Range.h>
#include <tf2_msgs/TFMessage.h>
#include <trident_msgs/Detection.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trident_estimation/fusion/team_fusion.h"
#include "trident_estimation_ros/fusion_node_params.h"
#include "trident_estimation_ros/fusion_output.h"
#include "trident_ros/any_message.h"
#include "trident_ros/refusals.h"

namespace trident::estimation {

/// The node team_fusion_node: messages into measurements, and at `update_rate` of them a belief
/// that is published. What is refused is counted in /diagnostics by topic; so is what became of the
/// measurements of each source, and whose covariances are too small.
class FusionNode {
 public:
  /// Subscribes at once. Throws Error for parameters that contradict one another.
  FusionNode(ros::NodeHandle& node, const FusionNodeParams& params);

 private:
  /// A robot, as its messages need it.
  struct Robot {
    std::string name;
    FusionRobotParams params;
  };

  void subscribe(ros::NodeHandle& node);
  void subscribe(ros::NodeHandle& node, std::size_t robot);
  void subscribe_poses(ros::NodeHandle& node, std::size_t robot, bool is_shared);
  template <class Message>
  void subscribe(ros::NodeHandle& node, const std::string& topic,
                 std::function<void(const Message&)> take);
  void subscribe_range(ros::NodeHandle& node, const FusionRangeParams& range);
  std::size_t index_of(const std::string& name) const;

  void on_pose(const std::string& topic, std::size_t robot, const std::string& type,
               const std::string& bytes);
  void on_shared_pose(const std::string& topic, std::size_t robot, const std::string& type,
                      const std::string& bytes);
  void on_detection(const std::string& topic, const trident_msgs::Detection& detection);
  void on_transforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event);
  void add_waterline(SimTime stamp, std::size_t robot);
  void note_heard(std::size_t robot, const ros::Time& stamp);
  void update();
  std::vector<std::string> accused_sources() const;
  void note_outcomes(const std::vector<Outcome>& outcomes);
  void publish_reports();
  std::string pose_topics_of(const std::string& name) const;

  FusionNodeParams params_;
  std::vector<Robot> robots_;
  TeamFusion fusion_;
  FusionOutput output_;
  ros_utils::Refusals refusals_;
  std::vector<std::optional<ros::Time>> heard_;  ///< newest pose, by robot
  ros::Time last_update_;
  std::vector<std::string> accused_;  ///< sources that were named, sorted
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher diagnostics_;
  ros::Timer update_timer_;
  ros::WallTimer report_timer_;
};

/// What the executable runs.
int team_fusion_main(int argc, char** argv);

}  // namespace trident::estimation
