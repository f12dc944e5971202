// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_node.h"

#include <geometry_msgs/PoseArray.h>
#include <nav_msgs/GetMap.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_ros/message_checks.h"

namespace trident::estimation {
namespace {

constexpr double kAskForMapEvery = 0.5;  // wall time [s]
constexpr double kDiagnosticsEvery = 1.0;

/// ROS' row of (x, y, z, roll, pitch, yaw) for each of x, y, yaw.
constexpr int kRow[] = {0, 1, 5};

Eigen::Matrix3d planar_covariance(const geometry_msgs::PoseWithCovariance& pose) {
  Eigen::Matrix3d covariance;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      covariance(row, column) =
          pose.covariance[static_cast<std::size_t>(6 * kRow[row] + kRow[column])];
    }
  }
  return covariance;
}

}  // namespace

AmclNode::AmclNode(ros::NodeHandle& node, const ros::NodeHandle& private_node,
                   const AmclNodeParams& params)
    : node_(node), private_node_(private_node), params_(params), name_(ros::this_node::getName()) {
  advertise();
  const ScanInputParams input{params.odom_frame_id, params.base_frame_id, params.bag_loop_jump};
  scans_ = std::make_unique<ScanInput>(
      node, input, troubles_, [this](const PlacedScan& placed) { on_scan(placed); },
      [this] {
        if (amcl_) amcl_->forget_odometry();
        T_odom_scan_.reset();
      });
  diagnostics_timer_ =
      node.createWallTimer(ros::WallDuration(kDiagnosticsEvery),
                           [this](const ros::WallTimerEvent&) { publish_diagnostics(); });
  if (params_.save_pose_rate > 0.0) {
    save_timer_ = node.createWallTimer(ros::WallDuration(1.0 / params_.save_pose_rate),
                                       [this](const ros::WallTimerEvent&) { save_pose(); });
  }
}

AmclNode::~AmclNode() { save_pose(); }

void AmclNode::advertise() {
  pose_ = node_.advertise<geometry_msgs::PoseWithCovarianceStamped>("amcl_pose", 2, true);
  cloud_ = node_.advertise<geometry_msgs::PoseArray>("particlecloud", 2, true);
  diagnostics_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
  initial_pose_ = node_.subscribe("initialpose", 2, &AmclNode::on_initial_pose, this);
  const boost::function<bool(Empty::Request&, Empty::Response&)> anywhere =
      [this](Empty::Request&, Empty::Response&) {
        if (amcl_) amcl_->set_anywhere();
        return amcl_ != nullptr;
      };
  const boost::function<bool(Empty::Request&, Empty::Response&)> force = [this](Empty::Request&,
                                                                                Empty::Response&) {
    if (amcl_) amcl_->force_update();
    return amcl_ != nullptr;
  };
  const boost::function<bool(nav_msgs::SetMap::Request&, nav_msgs::SetMap::Response&)> set_map =
      [this](nav_msgs::SetMap::Request& request, nav_msgs::SetMap::Response& response) {
        response.success = static_cast<std::uint8_t>(take_map(request.map));
        if (response.success != 0) on_initial_pose(request.initial_pose);
        return true;
      };
  global_localization_ = node_.advertiseService("global_localization", anywhere);
  nomotion_update_ = node_.advertiseService("request_nomotion_update", force);
  set_map_ = node_.advertiseService("set_map", set_map);
  if (params_.use_map_topic) {
    map_ = node_.subscribe<nav_msgs::OccupancyGrid>(
        "map", 1, [this](const nav_msgs::OccupancyGridConstPtr& message) {
          if (!amcl_ || !params_.first_map_only) take_map(*message);
        });
    return;
  }
  static_map_ = node_.serviceClient<nav_msgs::GetMap>("static_map");
  map_timer_ = node_.createWallTimer(ros::WallDuration(kAskForMapEvery),
                                     [this](const ros::WallTimerEvent&) { ask_for_map(); });
}

void AmclNode::ask_for_map() {
  nav_msgs::GetMap get;
  if (!amcl_ && static_map_.exists() && static_map_.call(get)) take_map(get.response.map);
  if (amcl_) map_timer_.stop();
}

/// False: the map is not usable; the last one stays.
bool AmclNode::take_map(const nav_msgs::OccupancyGrid& message) {
  try {
    auto amcl = std::make_unique<Amcl>(params_.filter, maps::from_map_message(message));
    amcl_ = std::move(amcl);
  } catch (const Error& error) {
    troubles_.note("map refused", error.what());
    return false;
  }
  if (message.header.frame_id != params_.global_frame_id) {
    troubles_.note("map's frame", "the map's frame is '" +
                                      ros_utils::quoted(message.header.frame_id) +
                                      "', global_frame_id is '" + params_.global_frame_id + "'");
  }
  has_pose_ = false;
  T_global_odom_.reset();
  start_pose();
  ROS_INFO("map of %u x %u cells of %g m", message.info.width, message.info.height,
           static_cast<double>(message.info.resolution));
  return true;
}

void AmclNode::start_pose() {
  const Eigen::Vector3d variances(params_.initial_cov_xx, params_.initial_cov_yy,
                                  params_.initial_cov_aa);
  amcl_->set_pose(
      SE2::from_xy_yaw(params_.initial_pose_x, params_.initial_pose_y, params_.initial_pose_a),
      variances.asDiagonal());
  if (params_.start_anywhere) amcl_->set_anywhere();
}

/// The robot's motion from a past time to the newest that tf knows; none where tf does not tell.
SE2 AmclNode::motion_since(const ros::Time& stamp) const {
  if (stamp.isZero()) return {};
  try {
    return scans_->T_odom_base(stamp).inverse() * scans_->T_odom_base(ros::Time(0));
  } catch (const tf2::TransformException&) {
    return {};
  }
}

void AmclNode::on_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  const std::string& frame = message.header.frame_id;
  if (!frame.empty() && frame != params_.global_frame_id) {
    troubles_.note("initialpose refused", "initialpose is in frame '" + ros_utils::quoted(frame) +
                                              "', legal: '" + params_.global_frame_id + "'");
    return;
  }
  if (!amcl_) {
    troubles_.note("initialpose refused", "initialpose came before there was a map");
    return;
  }
  try {
    const std::string problem = ros_utils::stamp_problem(message.header.stamp, ros::Time::now());
    if (!problem.empty()) throw Error(problem);
    const SE2 T_global_base = maps::from_pose_message(message.pose.pose);
    amcl_->set_pose(T_global_base * motion_since(message.header.stamp),
                    planar_covariance(message.pose));
  } catch (const Error& error) {
    troubles_.note("initialpose refused", std::string("initialpose: ") + error.what());
    return;
  }
  T_global_odom_.reset();
  if (T_odom_scan_) {
    T_global_odom_ = amcl_->estimate().T_map_base * T_odom_scan_->inverse();
  }
}

void AmclNode::on_scan(const PlacedScan& placed) {
  if (!amcl_) return;
  const AmclStep step = amcl_->update(placed.scan, placed.T_odom_base, placed.T_start_end);
  if (!step.problem.empty()) troubles_.note("input", step.problem);
  searches_ += step.is_searched ? 1 : 0;
  if (step.hypotheses > 0) {
    ROS_INFO("the scan did not fit; %zu places in the map got particles", step.hypotheses);
  }
  if (step.is_updated) {
    ++updates_;
    has_pose_ = true;
    T_odom_scan_ = placed.T_odom_base;
    T_global_odom_ = amcl_->estimate().T_map_base * placed.T_odom_base.inverse();
    publish_pose(placed.stamp);
    publish_particles(placed.stamp);
  }
  publish_transform(placed.stamp);
}

/// Stamped ahead, so that who asks for the robot's pose now need not wait for the next scan.
void AmclNode::publish_transform(const ros::Time& stamp) {
  if (!T_global_odom_ || !params_.tf_broadcast) return;
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = params_.global_frame_id;
  transform.header.stamp = stamp + ros::Duration(params_.transform_tolerance);
  transform.child_frame_id = params_.odom_frame_id;
  const geometry_msgs::Pose pose = maps::to_pose_message(*T_global_odom_);
  transform.transform.translation.x = pose.position.x;
  transform.transform.translation.y = pose.position.y;
  transform.transform.rotation = pose.orientation;
  broadcaster_.sendTransform(transform);
}

void AmclNode::publish_pose(const ros::Time& stamp) {
  const PoseEstimate& estimate = amcl_->estimate();
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.frame_id = params_.global_frame_id;
  message.header.stamp = stamp;
  message.pose.pose = maps::to_pose_message(estimate.T_map_base);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message.pose.covariance[static_cast<std::size_t>(6 * kRow[row] + kRow[column])] =
          estimate.covariance(row, column);
    }
  }
  pose_.publish(message);
}

void AmclNode::publish_particles(const ros::Time& stamp) {
  const bool is_due = params_.gui_publish_rate <= 0.0 || stamp < last_cloud_ ||
                      (stamp - last_cloud_).toSec() >= 1.0 / params_.gui_publish_rate;
  if (!is_due) return;
  last_cloud_ = stamp;
  geometry_msgs::PoseArray message;
  message.header.frame_id = params_.global_frame_id;
  message.header.stamp = stamp;
  message.poses.reserve(amcl_->particle_count());
  for (std::size_t i = 0; i < amcl_->particle_count(); ++i) {
    message.poses.push_back(maps::to_pose_message(amcl_->particle(i)));
  }
  cloud_.publish(message);
}

/// For the next start: the parameters that it begins with.
void AmclNode::save_pose() {
  if (!has_pose_ || params_.save_pose_rate <= 0.0) return;
  const PoseEstimate& estimate = amcl_->estimate();
  private_node_.setParam("initial_pose_x", estimate.T_map_base.p.x());
  private_node_.setParam("initial_pose_y", estimate.T_map_base.p.y());
  private_node_.setParam("initial_pose_a", estimate.T_map_base.angle);
  private_node_.setParam("initial_cov_xx", estimate.covariance(0, 0));
  private_node_.setParam("initial_cov_yy", estimate.covariance(1, 1));
  private_node_.setParam("initial_cov_aa", estimate.covariance(2, 2));
}

void AmclNode::publish_diagnostics() {
  if (diagnostics_.getNumSubscribers() == 0) return;
  using Status = diagnostic_msgs::DiagnosticStatus;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  Status status;
  status.name = name_ + ": Standard deviation";
  status.message = amcl_ ? "OK" : "no map yet";
  status.level = amcl_ ? Status::OK : Status::WARN;
  if (amcl_) {
    const PoseEstimate& estimate = amcl_->estimate();
    const Eigen::Vector3d sigma = estimate.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    const Eigen::Vector3d limit(params_.std_warn_level_x, params_.std_warn_level_y,
                                params_.std_warn_level_yaw);
    if ((sigma.array() > limit.array()).any()) {
      status.level = Status::WARN;
      status.message = "Too large";
    }
    const std::pair<const char*, double> values[] = {
        {"std_x", sigma.x()},
        {"std_y", sigma.y()},
        {"std_yaw", sigma.z()},
        {"agreement", estimate.agreement},
        {"cluster_weight", estimate.cluster_weight},
        {"particles", static_cast<double>(estimate.particles)},
        {"updates", static_cast<double>(updates_)},
        {"searches of the whole map", static_cast<double>(searches_)},
        {"scans", static_cast<double>(scans_->received())}};
    for (const auto& [key, value] : values) {
      status.values.push_back(ros_utils::key_value(key, number_text(value)));
    }
  }
  array.status.push_back(status);
  troubles_.add_to(array, name_);
  diagnostics_.publish(array);
}

int amcl_main(int argc, char** argv) {
  ros::init(argc, argv, "amcl");
  ros::NodeHandle node, private_node("~");
  try {
    const AmclNodeParams params = read_amcl_params(private_node);
    const AmclNode amcl(node, private_node, params);
    ros::spin();
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace trident::estimation
