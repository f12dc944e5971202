// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "drive_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::sim {

BaseState base_state_in_world(const Model& model) {
  BaseState state;
  state.T_odom_base = model.T_world_model();
  const Link* link = model.canonical_link();
  if (link == nullptr) return state;
  const Eigen::Vector3d v_world = link_velocity_world(*link);
  // In the axes of the yaw alone: planar odometry does not show how the body rolls and pitches.
  const double yaw = SE2::projected(state.T_odom_base).angle;
  const double c = std::cos(yaw), s = std::sin(yaw);
  state.v_base = {c * v_world.x() + s * v_world.y(), c * v_world.y() - s * v_world.x(), 0.0};
  state.w_base = {0.0, 0.0, link->w_world().z()};
  return state;
}

OdometryOutput::OdometryOutput(const PluginContext& context, const OdometryNames& names,
                               bool with_topic, bool with_transform) {
  if (with_topic) {
    odometry_ = advertise<OdometrySample>(context, names.topic, PortRank::kOdometry);
    odometry_->value.parent_frame = names.odom_frame;
    odometry_->value.child_frame = names.base_frame;
  }
  if (with_transform) frame_ = advertise_frame(context, names.odom_frame, names.base_frame);
}

void OdometryOutput::set_covariance(const Covariance6& pose, const Covariance6& twist) {
  if (!odometry_) return;
  odometry_->value.pose_covariance = pose;
  odometry_->value.twist_covariance = twist;
}

void OdometryOutput::set_planar_covariance(const Eigen::Matrix3d& covariance) {
  if (!odometry_) return;
  // x, y and yaw in the order (x, y, z, roll, pitch, yaw) of geometry_msgs/PoseWithCovariance.
  constexpr std::size_t kRows[] = {0, 1, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      odometry_->value.pose_covariance[6 * kRows[i] + kRows[k]] =
          covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }
}

bool OdometryOutput::wanted() const {
  return (odometry_ && odometry_->wanted()) || (frame_ && frame_->wanted());
}

void OdometryOutput::publish(SimTime stamp, const BaseState& state) {
  if (frame_ && frame_->wanted()) {
    frame_->value.stamp = stamp;
    frame_->value.T_parent_child = state.T_odom_base;
    frame_->publish();
  }
  if (odometry_ && odometry_->wanted()) {
    OdometrySample& value = odometry_->value;
    value.stamp = stamp;
    value.T_parent_child = state.T_odom_base;
    value.v_child = state.v_base;
    value.w_child = state.w_base;
    odometry_->publish();
  }
}

Covariance6 planar_covariance(double x, double y, double yaw) {
  // As gazebo_ros' drives write for z, roll and pitch, which wheels do not measure.
  constexpr double kUnknown = 1e12;
  Covariance6 result{};
  const double diagonal[] = {x, y, kUnknown, kUnknown, kUnknown, yaw};
  for (std::size_t i = 0; i < 6; ++i) result[7 * i] = diagonal[i];
  return result;
}

WheelFrames::WheelFrames(const PluginContext& context, const std::vector<Joint*>& joints,
                         FramePrefix from) {
  for (Joint* joint : joints) {
    const std::string child = resolved_frame(context, joint->child->name, from);
    const std::string parent =
        joint->parent == nullptr ? "world" : resolved_frame(context, joint->parent->name, from);
    auto frame = advertise_frame(context, parent, child);
    if (frame) frames_.emplace_back(joint, std::move(frame));
  }
}

void WheelFrames::publish(SimTime stamp) {
  for (auto& [joint, port] : frames_) {
    if (!port->wanted()) continue;
    const SE3 T_world_parent = joint->parent == nullptr ? SE3() : joint->parent->T_world_link();
    port->value.stamp = stamp;
    port->value.T_parent_child = T_world_parent.inverse() * joint->child->T_world_link();
    port->publish();
  }
}

DrivenWheel::DrivenWheel(Joint& joint, double diameter_m, double torque_limit, double acceleration)
    : joint_(&joint),
      radius_m_(0.5 * diameter_m),
      torque_limit_(torque_limit),
      acceleration_(acceleration) {
  joint_->motor = JointMotor{0.0, torque_limit_};
}

double DrivenWheel::speed_limit() const {
  const double rate = joint_->axes[0].spec.velocity;
  return rate > 0.0 ? radius_m_ * rate : std::numeric_limits<double>::infinity();
}

void DrivenWheel::drive(double dt_s) {
  const double change = wanted_ - ramped_;
  // Without an acceleration the whole change is made in this step.
  const double most = acceleration_ > 0.0 ? acceleration_ * dt_s : std::abs(change);
  ramped_ += std::clamp(change, -most, most);
  joint_->motor = JointMotor{ramped_ / radius_m_, torque_limit_};
}

void DrivenWheel::reset() {
  wanted_ = ramped_ = 0.0;
  joint_->motor = JointMotor{0.0, torque_limit_};
}

void Steering::aim(double target_rad, double dt_s) const {
  const double error = target_rad - joint->position();
  // Over several steps, so that the angle is approached and not overshot.
  double rate = error / (10.0 * dt_s);
  if (speed > 0.0) rate = std::clamp(rate, -speed, speed);
  const bool is_there = speed > 0.0 && std::abs(error) < tolerance_rad;
  joint->motor = JointMotor{is_there ? 0.0 : rate, torque_limit};
}

}  // namespace trident::sim
