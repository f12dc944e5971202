// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Node hector_mapping: hector's topics, services and parameters around trident_slam.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <hector_mapping/ResetMapping.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/String.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_slam/hector_slam_2d.h"
#include "trident_slam/slam_2d_capabilities.h"
#include "trident_slam_ros/run_program.h"
#include "trident_slam_ros/slam_node.h"
#include "trident_slam_ros/slam_parameters.h"

namespace trident::slam {
namespace {

constexpr char kUsualMethod[] = "hector_slam_2d";

/// Private parameters of the node beyond those of the method, with hector's defaults.
struct HectorNodeParams {
  HectorNodeParams() {
    options.base_frame = "base_link";
    options.map_update_interval = 2.0;
    options.pose_topic = "poseupdate";
    options.scan_queue_size = 5;
  }

  SlamNodeOptions options;
  bool publishes_correction = true;    ///< map -> odom
  bool publishes_odometry = false;     ///< scanmatch_odom
  bool publishes_scan_matcher = true;  ///< map -> `scan_matcher_frame`: the base as matched
  std::string scan_matcher_frame = "scanmatcher_frame";
  std::string command_topic = "syscommand";

  template <class Archive>
  void visit(Archive& ar) {
    options.visit(ar);
    ar.field("map_pub_period", options.map_update_interval, Range::non_negative(),
             "hector's name of map_update_interval [s]");
    ar.field("scan_subscriber_queue_size", options.scan_queue_size, Range::at_least(1),
             "scans that wait for the node");
    ar.field("use_tf_scan_transformation", options.uses_mount,
             "false: the laser is taken to sit at base_frame");
    ar.field("pub_map_odom_transform", publishes_correction, "publish map -> odom");
    ar.field("pub_odometry", publishes_odometry, "publish scanmatch_odom");
    ar.field("pub_map_scanmatch_transform", publishes_scan_matcher,
             "publish the matched pose as a transform");
    ar.field("tf_map_scanmatch_transform_frame_name", scan_matcher_frame,
             "child frame of that transform");
    ar.field("sys_msg_topic", command_topic, "topic of the command reset");
  }
};

/// hector's parameters that say what odometry is good for.
struct HectorOdometryParams {
  bool uses_start_estimate = false;
  bool has_known_poses = false;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("use_tf_pose_start_estimate", uses_start_estimate, "odometry starts each match");
    ar.field("map_with_known_poses", has_known_poses, "odometry is believed, nothing is matched");
  }
};

sensor_msgs::PointCloud cloud_of(const LaserScan& scan, const std_msgs::Header& header) {
  sensor_msgs::PointCloud cloud;
  cloud.header = header;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!scan.is_return(beam)) continue;
    const auto range = static_cast<double>(scan.ranges[beam]);
    const double angle = scan.angle(beam);
    const Eigen::Vector2d p =
        scan.T_base_laser * Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle));
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(p.x());
    point.y = static_cast<float>(p.y());
    cloud.points.push_back(point);
  }
  return cloud;
}

class HectorMapping {
 public:
  HectorMapping(const ros::NodeHandle& own, const SlamNodeOptions& options,
                const HectorNodeParams& hector, SlamNode::MakeSlam make)
      : map_frame_(options.map_frame),
        base_frame_(options.base_frame),
        hector_(hector),
        node_(own, options, std::move(make)) {
    ros::NodeHandle handle;
    pose_publisher_ = handle.advertise<geometry_msgs::PoseStamped>("slam_out_pose", 1, true);
    cloud_publisher_ = handle.advertise<sensor_msgs::PointCloud>("slam_cloud", 1);
    odometry_publisher_ = handle.advertise<nav_msgs::Odometry>("scanmatch_odom", 50);
    node_.on_scan(
        [this](const ScanRecord& record, const ScanPose2d& pose) { publish(record, pose); });
    command_ = handle.subscribe(hector.command_topic, 10, &HectorMapping::obey, this);
    place_ = handle.subscribe("initialpose", 1, &HectorMapping::place, this);
    reset_ = handle.advertiseService("reset_map", &HectorMapping::reset, this);
    pause_ = handle.advertiseService("pause_mapping", &HectorMapping::pause, this);
    restart_ =
        handle.advertiseService("restart_mapping_with_new_pose", &HectorMapping::restart, this);
  }

  void run() { node_.run(); }

 private:
  // In the thread of the algorithm.
  void publish(const ScanRecord& record, const ScanPose2d& pose) {
    std_msgs::Header header;
    header.stamp.fromNSec(static_cast<std::uint64_t>(record.scan.stamp_ns));
    header.frame_id = map_frame_;
    geometry_msgs::PoseStamped message;
    message.header = header;
    message.pose = maps::to_pose_message(pose.T_map_base);
    pose_publisher_.publish(message);
    if (hector_.publishes_odometry) {
      nav_msgs::Odometry odometry;
      odometry.header = header;
      odometry.child_frame_id = base_frame_;
      odometry.pose.pose = message.pose;
      odometry_publisher_.publish(odometry);
    }
    if (hector_.publishes_scan_matcher) publish_frame(header, message.pose);
    if (cloud_publisher_.getNumSubscribers() == 0) return;
    header.frame_id = base_frame_;
    cloud_publisher_.publish(cloud_of(record.scan, header));
  }
  void publish_frame(const std_msgs::Header& header, const geometry_msgs::Pose& pose) {
    geometry_msgs::TransformStamped transform;
    transform.header = header;
    transform.child_frame_id = hector_.scan_matcher_frame;
    transform.transform.translation.x = pose.position.x;
    transform.transform.translation.y = pose.position.y;
    transform.transform.rotation = pose.orientation;
    broadcaster_.sendTransform(transform);
  }
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
      const SE2 T_map_base = maps::from_pose_message(pose);
      node_.with_slam([&T_map_base](Slam2d& slam) {
        auto* placed = dynamic_cast<PoseInitializable*>(&slam);
        if (placed == nullptr) throw Error("this method does not accept an initial pose");
        placed->set_pose(T_map_base);
      });
      return true;
    } catch (const Error& error) {
      node_.report(std::string("pose: ") + error.what());
      return false;
    }
  }

  std::string map_frame_;
  std::string base_frame_;
  HectorNodeParams hector_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher pose_publisher_;
  ros::Publisher cloud_publisher_;
  ros::Publisher odometry_publisher_;
  SlamNode node_;
  ros::Subscriber command_;
  ros::Subscriber place_;
  ros::ServiceServer reset_;
  ros::ServiceServer pause_;
  ros::ServiceServer restart_;
};

/// hector's names for what graph_slam_2d calls otherwise.
const std::vector<ParameterAlias>& aliases() {
  static const std::vector<ParameterAlias> list = {{"resolution", "map_resolution"},
                                                   {"min_laser_range", "laser_min_dist"},
                                                   {"max_laser_range", "laser_max_dist"}};
  return list;
}

/// Parameters of a map that does not grow, of endpoints that are not in the plane, of debugging.
void accept_upstream_names(ros_utils::NodeParams& params) {
  params.accept_without_effect({"map_size", "map_start_x", "map_start_y", "laser_z_min_value",
                                "laser_z_max_value", "laser_z_min", "laser_z_max",
                                "advertise_map_service", "output_timing", "pub_drawings",
                                "pub_debug_output"});
}

/// The method with hector's defaults. A YAML file replaces all of these.
SlamMethod read_method(ros_utils::NodeParams& params) {
  const auto odometry = params.read<HectorOdometryParams>();
  SlamMethod method(params, kUsualMethod, aliases());
  set_node_defaults(method);
  method.set("is_asynchronous", "true");
  if (method.has_file()) return method;
  method.set_default("map_resolution", "0.025");
  method.set_default("laser_min_dist", "0.4");
  method.set_default("resolution", "0.025");
  method.set_default("min_laser_range", "0.4");
  if (method.name() == kUsualMethod) {
    const bool is_used = odometry.uses_start_estimate || odometry.has_known_poses;
    method.set_default("use_odometry", is_used ? "true" : "false");
  }
  return method;
}

void run() {
  const ros::NodeHandle own("~");  // ROS ends with the last handle
  ros_utils::NodeParams params(own);
  auto hector = params.read<HectorNodeParams>();
  if (!hector.publishes_correction) hector.options.transform_publish_period = 0.0;
  const SlamMethod method = read_method(params);
  accept_upstream_names(params);
  params.log_warnings();
  HectorMapping node(ros::NodeHandle(), hector.options, hector, method.maker());
  node.run();
}

}  // namespace
}  // namespace trident::slam

int main(int argc, char** argv) {
  return trident::slam::run_program(argc, argv, "hector_mapping", trident::slam::run);
}
