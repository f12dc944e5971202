// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/static_frames.h"

#include "trident_base/string_util.h"
#include "trident_ros/message_checks.h"

namespace trident::bridges {
namespace {

constexpr int kLongestChain = 64;  // a loop of frames ends there

std::string without_slash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace

std::string StaticFrames::add(const tf2_msgs::TFMessage& message) {
  std::string first_problem;
  for (const geometry_msgs::TransformStamped& one : message.transforms) {
    const std::string problem = ros_utils::transform_problem(one);
    if (!problem.empty()) {
      if (first_problem.empty()) first_problem = problem;
      continue;
    }
    const auto& p = one.transform.translation;
    const auto& q = one.transform.rotation;
    parents_[without_slash(one.child_frame_id)] = {
        without_slash(one.header.frame_id),
        {Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized(), {p.x, p.y, p.z}}};
  }
  return first_problem;
}

/// Simulators give a vehicle's odometry in a frame of its own name: "usv1/world" is the world.
bool StaticFrames::is_world(const std::string& frame) const {
  return frame == world_ || ends_with(frame, "/" + world_);
}

std::optional<SE3> StaticFrames::world_from(const std::string& frame) const {
  SE3 T_here_frame;
  std::string here = without_slash(frame);
  for (int step = 0; !is_world(here); ++step) {
    const auto link = parents_.find(here);
    if (link == parents_.end() || step == kLongestChain) return std::nullopt;
    T_here_frame = link->second.T_parent_child * T_here_frame;
    here = link->second.parent;
  }
  return T_here_frame;
}

}  // namespace trident::bridges
