// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/vehicle_sensors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_ros/message_checks.h"

namespace trident::bridges {
namespace {

constexpr std::uint32_t kQueueSize = 50;
constexpr std::size_t kMaxWaiting = 100;
/// A battery's state counts this long after its stamp [ns]: it comes by another connection than the
/// odometry, and its place between the states must not depend on which is faster.
constexpr std::int64_t kBatteryDelay_ns = 500'000'000;
/// Where no transform says what an odometry's frame is for so long, it is the world [s, wall time].
constexpr double kFramePatience_s = 2.0;

SimTime to_sim(const ros::Time& stamp) { return {static_cast<std::int64_t>(stamp.toNSec())}; }

std::string odometry_problem(const nav_msgs::Odometry& message) {
  const auto& v = message.twist.twist.linear;
  const auto& w = message.twist.twist.angular;
  std::string problem = ros_utils::pose_problem(message.pose.pose);
  if (problem.empty()) problem = ros_utils::point_problem(v.x, v.y, v.z, "twist.linear");
  if (problem.empty()) problem = ros_utils::point_problem(w.x, w.y, w.z, "twist.angular");
  if (problem.empty()) problem = ros_utils::stamp_problem(message.header.stamp, {});
  return problem;
}

}  // namespace

VehicleSensors::VehicleSensors(ros::NodeHandle& node, NodePollLoop& loop, Setup setup)
    : setup_(std::move(setup)), topic_(node.resolveName(setup_.odometry)) {
  subscriptions_.push_back(loop.subscribe<nav_msgs::Odometry>(
      node, setup_.odometry, kQueueSize, [this](const auto& m) { on_odometry(m); }));
  subscriptions_.push_back(loop.subscribe<sensor_msgs::BatteryState>(
      node, "battery", kQueueSize, [this](const auto& m) { on_battery(m); }));
}

/// False: where the frame lies may still be said.
bool VehicleSensors::find_frame(const std::string& frame) {
  if (frame == frame_) return true;
  auto found = setup_.frames.world_from(frame);
  if (!found) {
    if (frame_wanted_.isZero()) frame_wanted_ = ros::WallTime::now();
    if ((ros::WallTime::now() - frame_wanted_).toSec() < kFramePatience_s) return false;
    ROS_WARN("%s: no transform leads from '%s' to '%s': they are taken as one", topic_.c_str(),
             frame.c_str(), setup_.frames.world().c_str());
    found = SE3::identity();
  }
  frame_ = frame;
  T_world_frame_ = *found;
  return true;
}

void VehicleSensors::on_odometry(const nav_msgs::Odometry& message) {
  const std::string problem = odometry_problem(message);
  if (!problem.empty()) {
    setup_.refusals.note(topic_ + " refused", topic_ + " refused: " + problem);
    return;
  }
  const SimTime stamp = to_sim(message.header.stamp);
  if (!find_frame(message.header.frame_id)) {
    setup_.moved(stamp);
    return;
  }
  const auto& p = message.pose.pose.position;
  const auto& q = message.pose.pose.orientation;
  const auto& v = message.twist.twist.linear;
  const auto& w = message.twist.twist.angular;
  const SE3 T_frame_body{Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized(), {p.x, p.y, p.z}};
  const SE3 T_world_body = T_world_frame_ * T_frame_body;
  state_.p_world_m = T_world_body.p;
  state_.R_world_body = T_world_body.R.normalized();
  state_.v_world_m_s = state_.R_world_body * Eigen::Vector3d(v.x, v.y, v.z);
  state_.position_stamp = stamp;
  const double variance_m2 = std::max(message.pose.covariance[0], message.pose.covariance[7]);
  state_.position_stddev_m = std::isfinite(variance_m2) ? std::sqrt(std::max(variance_m2, 0.0)) : 0;
  readings_.w_body_rad_s = {w.x, w.y, w.z};
  take_battery(stamp);
  setup_.moved(stamp);
}

void VehicleSensors::on_battery(const sensor_msgs::BatteryState& message) {
  const double charge = message.percentage;
  if (!std::isnan(charge) && !(charge >= 0.0 && charge <= 1.0)) {
    setup_.refusals.note("battery refused", topic_ + ": battery refused: percentage " +
                                                std::to_string(charge) + ", legal: [0, 1] or NaN");
    return;
  }
  if (batteries_.size() >= kMaxWaiting) batteries_.erase(batteries_.begin());
  batteries_.push_back({to_sim(message.header.stamp), charge, message.voltage, -message.current});
}

void VehicleSensors::take_battery(SimTime now) {
  auto due = batteries_.begin();
  for (; due != batteries_.end() && due->stamp.ns + kBatteryDelay_ns <= now.ns; ++due) {
    state_.battery = due->charge;
    readings_.voltage_V = due->voltage_V;
    readings_.current_A = due->current_A;
  }
  batteries_.erase(batteries_.begin(), due);
}

}  // namespace trident::bridges
