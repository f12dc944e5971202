// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Node hector_mapping: hector's topics, services and parameters around trident_slam.
#include <geometry_msgs/PoseStamped.h>
#include <hector_mapping/ResetMapping.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <exception>
#include <iostream>
#include <string>
#include <utility>

#include "trident_base/error.h"
#include "trident_estimation_ros/map_messages.h"
#include "trident_slam/slam_2d_abilities.h"
#include "trident_slam_ros/slam_node.h"
#include "trident_slam_ros/slam_parameters.h"

namespace trident {
namespace {

class HectorMapping {
 public:
  HectorMapping(const ros::NodeHandle& own, const SlamNodeOptions& options, SlamNode::MakeSlam make)
      : map_frame_(options.map_frame), node_(own, options, std::move(make)) {
    ros::NodeHandle handle;
    pose_publisher_ = handle.advertise<geometry_msgs::PoseStamped>("slam_out_pose", 1);
    node_.on_scan([this](const ScanRecord& record, const ScanPose2d& pose) {
      geometry_msgs::PoseStamped message;
      message.header.stamp.fromNSec(static_cast<std::uint64_t>(record.scan.stamp_ns));
      message.header.frame_id = map_frame_;
      message.pose = to_pose_message(pose.T_map_base);
      pose_publisher_.publish(message);
    });
    command_ = handle.subscribe("syscommand", 10, &HectorMapping::obey, this);
    place_ = handle.subscribe("initialpose", 1, &HectorMapping::place, this);
    reset_ = handle.advertiseService("reset_map", &HectorMapping::reset, this);
    pause_ = handle.advertiseService("pause_mapping", &HectorMapping::pause, this);
    restart_ =
        handle.advertiseService("restart_mapping_with_new_pose", &HectorMapping::restart, this);
  }

 private:
  void obey(const std_msgs::String& command) {
    if (command.data == "reset") node_.reset();
  }
  void place(const geometry_msgs::PoseWithCovarianceStamped& message) {
    set_pose(message.pose.pose);
  }
  bool reset(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
    node_.reset();
    response.success = true;
    return true;
  }
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    node_.set_paused(request.data);
    response.success = true;
    return true;
  }
  bool restart(hector_mapping::ResetMapping::Request& request,
               hector_mapping::ResetMapping::Response& /*response*/) {
    node_.reset();
    node_.set_paused(false);
    return set_pose(request.initial_pose);
  }
  bool set_pose(const geometry_msgs::Pose& pose) {
    try {
      const SE2 T_map_base = from_pose_message(pose);
      node_.with_slam([&T_map_base](Slam2d& slam) {
        auto* placed = dynamic_cast<Slam2dPlaced*>(&slam);
        if (placed == nullptr) throw Error("this method cannot be told where the robot is");
        placed->set_pose(T_map_base);
      });
      return true;
    } catch (const Error& error) {
      ROS_ERROR("pose: %s", error.what());
      return false;
    }
  }

  std::string map_frame_;
  ros::Publisher pose_publisher_;
  SlamNode node_;
  ros::Subscriber command_;
  ros::Subscriber place_;
  ros::ServiceServer reset_;
  ros::ServiceServer pause_;
  ros::ServiceServer restart_;
};

void run() {
  const ros::NodeHandle own("~");
  SlamNodeOptions options;
  options.base_frame = "base_link";
  options.map_update_interval = 2.0;
  options.pose_topic = "poseupdate";
  read_options(own, options);
  own.getParam("map_pub_period", options.map_update_interval);
  bool publishes_correction = true;
  own.getParam("pub_map_odom_transform", publishes_correction);
  if (!publishes_correction) options.transform_publish_period = 0.0;
  // What hector calls otherwise.
  GraphSlamOptions graph;
  own.getParam("map_resolution", graph.resolution);
  own.getParam("laser_min_dist", graph.min_laser_range);
  own.getParam("laser_max_dist", graph.max_laser_range);
  graph.is_asynchronous = true;
  graph.validate();
  const HectorMapping node(ros::NodeHandle(), options, slam_maker(own, {"hector_slam_2d"}, graph));
  ros::spin();
}

}  // namespace
}  // namespace trident

int main(int argc, char** argv) {
  ros::init(argc, argv, "hector_mapping");
  try {
    trident::run();
  } catch (const std::exception& error) {
    std::cerr << ros::this_node::getName() << ": " << error.what() << std::endl;
    return 1;
  }
  return 0;
}
