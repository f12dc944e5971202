// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/fusion_output.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <trident_msgs/TeamState.h>

#include <utility>

#include "trident_estimation/fusion/team_model.h"
#include "trident_estimation_ros/fusion_messages.h"

namespace trident::estimation {
namespace {

constexpr float kNotKnown = -1.0F;

geometry_msgs::PoseWithCovariance pose_of(const Filter& belief, std::size_t robot) {
  const Eigen::Index first = TeamModel::kDofs * static_cast<Eigen::Index>(robot);
  geometry_msgs::PoseWithCovariance message;
  message.pose = to_pose(TeamModel::robot(belief.state(), robot).T_world_base);
  for (Eigen::Index i = 0; i < 36; ++i) {
    message.covariance[static_cast<std::size_t>(i)] =
        belief.covariance()(first + i / 6, first + i % 6);
  }
  return message;
}

}  // namespace

FusionOutput::FusionOutput(ros::NodeHandle& node, std::vector<FusedRobot> robots,
                           std::string common_frame, bool is_fused)
    : robots_(std::move(robots)),
      common_frame_(std::move(common_frame)),
      is_fused_(is_fused),
      state_(node.advertise<trident_msgs::TeamState>("team/state", 10)) {
  for (const FusedRobot& robot : robots_) {
    poses_.push_back(
        node.advertise<geometry_msgs::PoseWithCovarianceStamped>(robot.name + "/team_pose", 10));
  }
}

void FusionOutput::publish(const ros::Time& stamp, const Filter& belief,
                           const std::vector<std::optional<ros::Time>>& heard) {
  trident_msgs::TeamState state;
  state.header.stamp = stamp;
  state.header.frame_id = common_frame_;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    trident_msgs::TeamMember member;
    member.name = robots_[i].name;
    member.kind = robots_[i].kind;
    member.battery = kNotKnown;
    member.pose = pose_of(belief, i);
    member.age_s = heard[i] ? std::max(0.0, (stamp - *heard[i]).toSec()) : -1.0;
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header = state.header;
    pose.pose = member.pose;
    poses_[i].publish(pose);
    state.members.push_back(std::move(member));
    if (!is_fused_) continue;
    const SE3 T_world_map = TeamModel::robot(belief.state(), i).T_world_map();
    const geometry_msgs::Pose map = to_pose(T_world_map);
    geometry_msgs::TransformStamped transform;
    transform.header = state.header;
    transform.child_frame_id = map_frame(robots_[i].name);
    transform.transform.translation.x = map.position.x;
    transform.transform.translation.y = map.position.y;
    transform.transform.translation.z = map.position.z;
    transform.transform.rotation = map.orientation;
    broadcaster_.sendTransform(transform);
  }
  state_.publish(state);
}

}  // namespace trident::estimation
