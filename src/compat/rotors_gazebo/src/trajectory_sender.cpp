// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trajectory_sender.h"

#include <chrono>
#include <cmath>
#include <thread>

namespace trident::control {
namespace {

using namespace std::chrono_literals;

constexpr auto kPollPeriod = 10ms;
constexpr auto kClockPollPeriod = 1ms;  // a world may run at a thousand times real time
constexpr auto kNoticePeriod = 10s;
// roscpp's socket thread sends within a millisecond, but does not say when it has; a socket that is
// closed afterwards still delivers.
constexpr auto kTimeToSend = 250ms;

}  // namespace

trajectory_msgs::MultiDOFJointTrajectory trajectory_through(
    const std::vector<Waypoint>& waypoints) {
  trajectory_msgs::MultiDOFJointTrajectory trajectory;
  trajectory.joint_names.push_back("base_link");
  double time_from_start_s = 0.0;
  for (const Waypoint& waypoint : waypoints) {
    time_from_start_s += waypoint.wait_s;
    trajectory_msgs::MultiDOFJointTrajectoryPoint point;
    point.time_from_start = ros::Duration(time_from_start_s);
    point.transforms.resize(1);
    point.velocities.resize(1);
    point.accelerations.resize(1);
    geometry_msgs::Transform& transform = point.transforms.front();
    transform.translation.x = waypoint.x;
    transform.translation.y = waypoint.y;
    transform.translation.z = waypoint.z;
    transform.rotation.z = std::sin(waypoint.yaw / 2.0);
    transform.rotation.w = std::cos(waypoint.yaw / 2.0);
    trajectory.points.push_back(point);
  }
  return trajectory;
}

bool wait_for(double seconds) {
  // In doubles: the sum of a ros::Time and a ros::Duration throws beyond 32 bits of seconds, which
  // a faulty clock may report. Zero means that no clock has been received yet.
  double begin_s = 0.0;
  while (ros::ok()) {
    const double now_s = ros::Time::now().toSec();
    if (begin_s == 0.0 || now_s < begin_s) begin_s = now_s;
    if (begin_s > 0.0 && now_s - begin_s >= seconds) return true;
    std::this_thread::sleep_for(kClockPollPeriod);
  }
  return false;
}

TrajectorySender::TrajectorySender(ros::NodeHandle& node)
    : publisher_(
          node.advertise<trajectory_msgs::MultiDOFJointTrajectory>("command/trajectory", 10)) {}

bool TrajectorySender::send(trajectory_msgs::MultiDOFJointTrajectory trajectory) {
  auto notice = std::chrono::steady_clock::now() + kNoticePeriod;
  while (ros::ok() && publisher_.getNumSubscribers() == 0) {
    if (std::chrono::steady_clock::now() >= notice) {
      ROS_WARN("still waiting for a subscriber of %s", publisher_.getTopic().c_str());
      notice += kNoticePeriod;
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
  if (!ros::ok()) return false;
  trajectory.header.stamp = ros::Time::now();
  const geometry_msgs::Vector3& first = trajectory.points.front().transforms.front().translation;
  ROS_INFO("Publishing %zu waypoint(s) on %s, the first at [%g, %g, %g] m.",
           trajectory.points.size(), publisher_.getTopic().c_str(), first.x, first.y, first.z);
  publisher_.publish(trajectory);
  std::this_thread::sleep_for(kTimeToSend);
  return true;
}

}  // namespace trident::control
