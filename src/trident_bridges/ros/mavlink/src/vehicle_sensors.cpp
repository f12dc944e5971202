// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/vehicle_sensors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/angle.h"
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
  listen(node, loop, setup_.odometry, &VehicleSensors::on_odometry);
  listen(node, loop, "battery", &VehicleSensors::on_battery);
  listen(node, loop, setup_.imu, &VehicleSensors::on_imu);
  listen(node, loop, "fix", &VehicleSensors::on_fix);
  listen(node, loop, "gnss_status", &VehicleSensors::on_gnss_status);
  listen(node, loop, "wind_reading", &VehicleSensors::on_wind);
}

template <class Message>
void VehicleSensors::listen(ros::NodeHandle& node, NodePollLoop& loop, const std::string& topic,
                            void (VehicleSensors::*handler)(const Message&)) {
  subscriptions_.push_back(loop.subscribe<Message>(
      node, topic, kQueueSize, [this, handler](const Message& m) { (this->*handler)(m); }));
}

/// Counts what is wrong. `what`: stands before the odometry's topic; a good message takes no
/// memory.
bool VehicleSensors::accept(const char* what, const std::string& problem) {
  if (problem.empty()) return true;
  const std::string topic = what + topic_;
  setup_.refusals.note(topic + " refused", topic + " refused: " + problem);
  return false;
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
  if (!accept("", odometry_problem(message))) return;
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
  // Of a time before a reset: they would hold back what comes now.
  if (state_.position_stamp && stamp < *state_.position_stamp) batteries_.clear();
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
    accept("battery of ", "percentage " + std::to_string(charge) + ", legal: [0, 1] or NaN");
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

void VehicleSensors::on_imu(const sensor_msgs::Imu& message) {
  const auto& f = message.linear_acceleration;
  const auto& w = message.angular_velocity;
  std::string problem = ros_utils::point_problem(f.x, f.y, f.z, "linear_acceleration");
  if (problem.empty()) problem = ros_utils::point_problem(w.x, w.y, w.z, "angular_velocity");
  if (!accept("IMU of ", problem)) return;
  readings_.imu =
      mavlink::ImuReading{to_sim(message.header.stamp), {f.x, f.y, f.z}, {w.x, w.y, w.z}};
  vibration_.add(*readings_.imu);
  readings_.vibration_m_s2 = vibration_.level_m_s2();
}

void VehicleSensors::on_fix(const sensor_msgs::NavSatFix& message) {
  mavlink::GnssReading reading = readings_.gnss.value_or(mavlink::GnssReading{});
  reading.stamp = to_sim(message.header.stamp);
  reading.has_fix = message.status.status >= sensor_msgs::NavSatStatus::STATUS_FIX;
  if (reading.has_fix) {
    std::string problem = ros_utils::number_problem(message.latitude, 90.0, "latitude");
    if (problem.empty()) problem = ros_utils::number_problem(message.longitude, 180.0, "longitude");
    if (problem.empty()) problem = ros_utils::number_problem(message.altitude, 1e7, "altitude");
    if (!accept("fix of ", problem)) return;
    reading.place = {message.latitude, message.longitude, message.altitude};
    reading.horizontal_stddev_m = std::sqrt(std::max(message.position_covariance[0], 0.0));
    reading.vertical_stddev_m = std::sqrt(std::max(message.position_covariance[8], 0.0));
  }
  readings_.gnss = reading;
}

/// Of a receiver that says more than NavSatFix can hold.
void VehicleSensors::on_gnss_status(const trident_msgs::GnssStatus& message) {
  if (!readings_.gnss) return;
  readings_.gnss->is_rtk_fixed = message.fix_type == trident_msgs::GnssStatus::FIXED;
  readings_.gnss->is_rtk_float = message.fix_type == trident_msgs::GnssStatus::FLOAT;
  readings_.gnss->satellites = message.satellites;
}

/// The bow points into an apparent wind of angle 0, and that of the own motion is part of it.
void VehicleSensors::on_wind(const trident_msgs::WindReading& message) {
  std::string problem = ros_utils::number_problem(message.speed, 500.0, "speed");
  if (problem.empty()) problem = ros_utils::number_problem(message.angle, 7.0, "angle");
  if (!accept("wind_reading of ", problem)) return;
  const double towards = state_.yaw() - message.angle + kPi;
  Eigen::Vector3d wind(message.speed * std::cos(towards), message.speed * std::sin(towards), 0.0);
  if (message.reference == trident_msgs::WindReading::RELATIVE) {
    wind.head<2>() += state_.v_world_m_s.head<2>();
  }
  readings_.wind_world_m_s = wind;
}

}  // namespace trident::bridges
