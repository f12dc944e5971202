// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/transform_input.h"

#include <algorithm>
#include <utility>

#include "trident_ros/message_checks.h"

namespace trident::ros_utils {
namespace {

constexpr std::uint32_t kQueueSize = 100;

std::string name_of(const geometry_msgs::TransformStamped& transform) {
  return "transform '" + quoted(transform.header.frame_id) + "' -> '" +
         quoted(transform.child_frame_id) + "'";
}

}  // namespace

std::string TransformGate::add(const geometry_msgs::TransformStamped& transform,
                               const std::string& authority, bool is_static, const ros::Time& now) {
  std::string problem = transform_problem(transform);
  // tf2 adds to stamps of static transforms, too, but the value of these does not matter.
  const ros::Time clock = is_static ? ros::Time() : now;
  if (problem.empty()) problem = stamp_problem(transform.header.stamp, clock);
  if (!problem.empty()) return name_of(transform) + " is refused: " + problem;
  if (!is_static && is_too_old(transform)) {
    return name_of(transform) + " is refused: it is older than what is kept";
  }
  buffer_.setTransform(transform, authority, is_static);
  return "";
}

bool TransformGate::is_too_old(const geometry_msgs::TransformStamped& transform) {
  Child& child = children_[transform.child_frame_id];
  const ros::Time& stamp = transform.header.stamp;
  if (stamp >= child.newest || child.newest - stamp < buffer_.getCacheLength()) {
    child.newest = std::max(child.newest, stamp);
    child.behind = 0;
    return false;
  }
  if (++child.behind < kPatience) return true;
  clear();
  children_[transform.child_frame_id].newest = stamp;
  return false;
}

void TransformGate::clear() {
  buffer_.clear();
  children_.clear();
}

TransformInput::TransformInput(tf2::BufferCore& buffer, OnRefusal on_refusal)
    : gate_(buffer), on_refusal_(std::move(on_refusal)) {
  ros::NodeHandle node;
  node.setCallbackQueue(&queue_);
  const boost::function<void(const Event&)> changing = [this](const Event& event) {
    receive(event, false);
  };
  const boost::function<void(const Event&)> fixed = [this](const Event& event) {
    receive(event, true);
  };
  changing_ = node.subscribe<tf2_msgs::TFMessage>("/tf", kQueueSize, changing);
  static_ = node.subscribe<tf2_msgs::TFMessage>("/tf_static", kQueueSize, fixed);
  spinner_.start();
}

TransformInput::~TransformInput() {
  spinner_.stop();
  changing_.shutdown();
  static_.shutdown();
}

void TransformInput::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  gate_.clear();
}

void TransformInput::receive(const Event& event, bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_update_) {
    clear();
    ROS_WARN("time went back by %.3f s: transforms are forgotten", (last_update_ - now).toSec());
  }
  last_update_ = now;
  const std::string& authority = event.getPublisherName();
  for (const auto& transform : event.getConstMessage()->transforms) {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::string problem = gate_.add(transform, authority, is_static, now);
    lock.unlock();
    if (!problem.empty()) on_refusal_(problem);
  }
}

}  // namespace trident::ros_utils
