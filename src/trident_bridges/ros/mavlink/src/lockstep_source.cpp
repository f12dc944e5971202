// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/lockstep_source.h"

#include <ros/ros.h>
#include <trident_msgs/EnrollSource.h>

#include <utility>

namespace trident::bridges {
namespace {

constexpr const char* kEnroll = "/gazebo/enroll_source";
constexpr const char* kSpawn = "/gazebo/spawn_urdf_model";
constexpr double kPoll_s = 0.05;

}  // namespace

LockstepSource::LockstepSource(Setup setup, PollLoop& loop, std::function<void(SimTime)> enrolled)
    : setup_(std::move(setup)),
      loop_(loop),
      enrolled_(std::move(enrolled)),
      thread_([this] { ask(); }) {}

LockstepSource::~LockstepSource() {
  is_ending_ = true;
  thread_.join();
}

/// Our simulator offers lockstep before it offers to spawn. False: no simulator waits, or the
/// node ends.
bool LockstepSource::await_service() {
  while (!is_ending_ && ros::ok()) {
    const bool is_simulator_there = ros::service::exists(kSpawn, false);
    if (ros::service::exists(kEnroll, false)) return true;
    if (is_simulator_there) return false;
    ros::WallDuration(kPoll_s).sleep();
  }
  return false;
}

void LockstepSource::ask() {
  if (!await_service()) return;
  trident_msgs::EnrollSource service;
  service.request.node = ros::this_node::getName();
  service.request.vehicles = setup_.vehicles;
  service.request.period = ros::Duration(setup_.period_s);
  service.request.enroll = true;
  if (!ros::service::call(kEnroll, service) || !service.response.success) {
    ROS_WARN("%s: refused: %s: the world does not wait for set-points", kEnroll,
             service.response.message.c_str());
    return;
  }
  const SimTime start{static_cast<std::int64_t>(service.response.start_time.toNSec())};
  loop_.post([this, start] { enrolled_(start); });
}

}  // namespace trident::bridges
