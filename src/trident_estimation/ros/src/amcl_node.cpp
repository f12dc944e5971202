// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_node.h"

#include <std_srvs/Empty.h>
#include <tf2/exceptions.h>

#include "trident_base/error.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_ros/message_checks.h"
#include "trident_ros/node_params.h"

namespace trident::estimation {

AmclNode::AmclNode(ros::NodeHandle& node, const ros::NodeHandle& private_node,
                   const AmclNodeParams& params)
    : private_node_(private_node),
      params_(params),
      localizer_(params_),
      output_(node, params_),
      map_(
          node, params_,
          [this](const nav_msgs::OccupancyGrid& message) { return take_map(message); },
          [this](const auto& pose) { on_initial_pose(pose); }),
      scans_(
          node, {params.odom_frame_id, params.base_frame_id, params.bag_loop_jump}, problems_,
          [this](const PlacedScan& placed) { on_scan(placed); },
          [this] { localizer_.forget_odometry(); }),
      diagnostics_(node, params_, localizer_, scans_, problems_) {
  serve(node);
  if (params_.save_pose_rate > 0.0) {
    save_timer_ = node.createWallTimer(ros::WallDuration(1.0 / params_.save_pose_rate),
                                       [this](const ros::WallTimerEvent&) { save_pose(); });
  }
}

AmclNode::~AmclNode() { save_pose(); }

void AmclNode::serve(ros::NodeHandle& node) {
  using Empty = std_srvs::Empty;
  using Call = boost::function<bool(Empty::Request&, Empty::Response&)>;
  initial_pose_ = node.subscribe("initialpose", 2, &AmclNode::on_initial_pose, this);
  const Call anywhere = [this](Empty::Request&, Empty::Response&) {
    if (localizer_.has_map()) localizer_.set_anywhere();
    return localizer_.has_map();
  };
  const Call force = [this](Empty::Request&, Empty::Response&) {
    if (localizer_.has_map()) localizer_.force_update();
    return localizer_.has_map();
  };
  global_localization_ = node.advertiseService("global_localization", anywhere);
  nomotion_update_ = node.advertiseService("request_nomotion_update", force);
}

/// Returns false for a map that is not usable; the last one then stays.
bool AmclNode::take_map(const nav_msgs::OccupancyGrid& message) {
  try {
    localizer_.set_map(maps::from_map_message(message));
  } catch (const Error& error) {
    problems_.note("map refused", error.what());
    return false;
  }
  if (message.header.frame_id != params_.global_frame_id) {
    problems_.note("map's frame", "the map's frame is '" +
                                      ros_utils::quoted(message.header.frame_id) +
                                      "', global_frame_id is '" + params_.global_frame_id + "'");
  }
  ROS_INFO("map of %u x %u cells of %g m", message.info.width, message.info.height,
           static_cast<double>(message.info.resolution));
  return true;
}

/// Returns the robot's motion from a past time to the newest that tf knows; the identity where tf
/// does not reach.
SE2 AmclNode::motion_since(const ros::Time& stamp) const {
  if (stamp.isZero()) return {};
  try {
    return scans_.T_odom_base(stamp).inverse() * scans_.T_odom_base(ros::Time(0));
  } catch (const tf2::TransformException&) {
    return {};
  }
}

void AmclNode::on_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  const std::string& frame = message.header.frame_id;
  if (!frame.empty() && frame != params_.global_frame_id) {
    problems_.note("initialpose refused", "initialpose is in frame '" + ros_utils::quoted(frame) +
                                              "', legal: '" + params_.global_frame_id + "'");
    return;
  }
  if (!localizer_.has_map()) {
    problems_.note("initialpose refused", "initialpose came before there was a map");
    return;
  }
  try {
    const std::string problem = ros_utils::stamp_problem(message.header.stamp, ros::Time::now());
    if (!problem.empty()) throw Error(problem);
    const SE2 T_global_base = maps::from_pose_message(message.pose.pose);
    localizer_.set_pose(T_global_base * motion_since(message.header.stamp),
                        planar_covariance(message.pose));
  } catch (const Error& error) {
    problems_.note("initialpose refused", std::string("initialpose: ") + error.what());
  }
}

void AmclNode::on_scan(const PlacedScan& placed) {
  if (!localizer_.has_map()) return;
  const AmclStep step = localizer_.update(placed);
  if (!step.problem.empty()) problems_.note("input", step.problem);
  if (step.hypotheses > 0) {
    ROS_INFO("the scan did not fit; %zu places in the map got particles", step.hypotheses);
  }
  if (step.is_updated) {
    output_.publish_pose(placed.stamp, localizer_.filter().estimate());
    output_.publish_particles(placed.stamp, localizer_.filter());
  }
  if (localizer_.T_global_odom()) {
    output_.publish_transform(placed.stamp, *localizer_.T_global_odom());
  }
}

/// Sets the parameters that the next start begins with.
void AmclNode::save_pose() {
  if (!localizer_.has_pose() || params_.save_pose_rate <= 0.0) return;
  const PoseEstimate& estimate = localizer_.filter().estimate();
  private_node_.setParam("initial_pose_x", estimate.T_map_base.p.x());
  private_node_.setParam("initial_pose_y", estimate.T_map_base.p.y());
  private_node_.setParam("initial_pose_a", estimate.T_map_base.angle);
  private_node_.setParam("initial_cov_xx", estimate.covariance(0, 0));
  private_node_.setParam("initial_cov_yy", estimate.covariance(1, 1));
  private_node_.setParam("initial_cov_aa", estimate.covariance(2, 2));
}

int amcl_main(int argc, char** argv) {
  ros::init(argc, argv, "amcl");
  ros::NodeHandle node, private_node("~");
  try {
    const auto params = ros_utils::load_params<AmclNodeParams>(private_node);
    const AmclNode amcl(node, private_node, params);
    ros::spin();
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace trident::estimation
