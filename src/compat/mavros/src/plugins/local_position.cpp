// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include <limits>

#include "core/conversions.h"
#include "core/transforms.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::Matrix6;
using bridges::mavlink::swap_world;

/// The triangle of LOCAL_POSITION_NED_COV: place, velocity, acceleration; 9 x 9, row by row.
Eigen::Matrix<double, 9, 9> nine_rows(const float (&field)[45]) {  // NOLINT: of the generator
  Eigen::Matrix<double, 9, 9> result;
  int at = 0;
  for (int i = 0; i < 9; ++i) {
    for (int j = i; j < 9; ++j) result(i, j) = result(j, i) = field[at++];
  }
  return result;
}

/// A 3 x 3 block as the first one of a 6 x 6 covariance.
Matrix6 with_block(const Eigen::Matrix3d& block) {
  Matrix6 result = Matrix6::Zero();
  result.topLeftCorner<3, 3>() = block;
  return result;
}

/// Where the vehicle is in its local frame.
class LocalPosition : public Plugin {
 public:
  explicit LocalPosition(Hub& hub)
      : hub_(hub),
        vehicle_(hub.vehicle),
        params_(hub.params.local_position),
        transform_(hub.ros, params_.tf) {
    RosSide& ros = hub.ros;
    pose_ = ros.advertise<geometry_msgs::PoseStamped>("local_position/pose");
    pose_cov_ = ros.advertise<geometry_msgs::PoseWithCovarianceStamped>("local_position/pose_cov");
    world_velocity_ = ros.advertise<geometry_msgs::TwistStamped>("local_position/velocity_local");
    body_velocity_ = ros.advertise<geometry_msgs::TwistStamped>("local_position/velocity_body");
    body_velocity_cov_ = ros.advertise<geometry_msgs::TwistWithCovarianceStamped>(
        "local_position/velocity_body_cov");
    accel_ = ros.advertise<geometry_msgs::AccelWithCovarianceStamped>("local_position/accel");
    odometry_ = ros.advertise<nav_msgs::Odometry>("local_position/odom");
    on<mavlink_local_position_ned_t>(vehicle_, [this](const auto& p) { on_position(p); });
    on<mavlink_local_position_ned_cov_t>(vehicle_, [this](const auto& p) { on_covariance(p); });
  }

 private:
  struct Where {
    std_msgs::Header header;
    Eigen::Vector3d p_m, v_world_m_s, v_body_m_s;
  };

  Where where(const ros::Time& stamp, const Eigen::Vector3d& p_ned,
              const Eigen::Vector3d& v_ned) const {
    Where result;
    result.header.stamp = stamp;
    result.header.frame_id = params_.frame_id;
    result.p_m = swap_world(p_ned);
    result.v_world_m_s = swap_world(v_ned);
    result.v_body_m_s = hub_.known.R_world_body.inverse() * result.v_world_m_s;
    return result;
  }

  void on_position(const mavlink_local_position_ned_t& p) {
    const Where at = where(vehicle_.stamp_ms(p.time_boot_ms), {p.x, p.y, p.z}, {p.vx, p.vy, p.vz});
    publish(at, nullptr);
  }

  void publish(const Where& at, const Matrix6* pose_covariance) {
    const Eigen::Quaterniond& q = hub_.known.R_world_body;
    geometry_msgs::PoseStamped pose;
    pose.header = at.header;
    assign(pose.pose.position, at.p_m);
    assign_rotation(pose.pose.orientation, q);
    pose_->publish(pose);

    geometry_msgs::TwistStamped twist;
    twist.header = at.header;
    assign(twist.twist.linear, at.v_world_m_s);
    assign(twist.twist.angular, q * hub_.known.w_body_rad_s);
    world_velocity_->publish(twist);
    twist.header.frame_id = params_.child_frame_id;
    assign(twist.twist.linear, at.v_body_m_s);
    assign(twist.twist.angular, hub_.known.w_body_rad_s);
    body_velocity_->publish(twist);

    nav_msgs::Odometry odometry;
    odometry.header = at.header;
    odometry.child_frame_id = params_.child_frame_id;
    odometry.pose.pose = pose.pose;
    odometry.twist.twist = twist.twist;
    if (pose_covariance != nullptr) assign_matrix6(odometry.pose.covariance, *pose_covariance);
    odometry_->publish(odometry);
    transform_.send(at.header.stamp, at.p_m, q);
  }

  void on_covariance(const mavlink_local_position_ned_cov_t& p) {
    const Where at = where(vehicle_.stamp_us(p.time_usec), {p.x, p.y, p.z}, {p.vx, p.vy, p.vz});
    const auto all = nine_rows(p.covariance);
    const Matrix6 pose_covariance =
        bridges::mavlink::swap_world_covariance(with_block(all.block<3, 3>(0, 0)));
    const Matrix6 world_velocity =
        bridges::mavlink::swap_world_covariance(with_block(all.block<3, 3>(3, 3)));
    publish(at, &pose_covariance);

    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header = at.header;
    assign(pose.pose.pose.position, at.p_m);
    assign_rotation(pose.pose.pose.orientation, hub_.known.R_world_body);
    assign_matrix6(pose.pose.covariance, pose_covariance);
    pose_cov_->publish(pose);

    const Eigen::Matrix3d R = hub_.known.R_world_body.inverse().toRotationMatrix();
    geometry_msgs::TwistWithCovarianceStamped twist;
    twist.header = at.header;
    twist.header.frame_id = params_.child_frame_id;
    assign(twist.twist.twist.linear, at.v_body_m_s);
    assign(twist.twist.twist.angular, hub_.known.w_body_rad_s);
    assign_matrix6(twist.twist.covariance,
                   with_block(R * world_velocity.topLeftCorner<3, 3>() * R.transpose()));
    body_velocity_cov_->publish(twist);

    geometry_msgs::AccelWithCovarianceStamped accel;
    accel.header = at.header;
    assign(accel.accel.accel.linear, swap_world({p.ax, p.ay, p.az}));
    assign_matrix6(accel.accel.covariance,
                   bridges::mavlink::swap_world_covariance(with_block(all.block<3, 3>(6, 6))));
    accel_->publish(accel);
  }

  Hub& hub_;
  VehicleSide& vehicle_;
  const PositionParams& params_;
  TransformOutput transform_;
  std::unique_ptr<bridges::NodePublisher<geometry_msgs::PoseStamped>> pose_;
  std::unique_ptr<bridges::NodePublisher<geometry_msgs::PoseWithCovarianceStamped>> pose_cov_;
  std::unique_ptr<bridges::NodePublisher<geometry_msgs::TwistStamped>> world_velocity_;
  std::unique_ptr<bridges::NodePublisher<geometry_msgs::TwistStamped>> body_velocity_;
  std::unique_ptr<bridges::NodePublisher<geometry_msgs::TwistWithCovarianceStamped>>
      body_velocity_cov_;
  std::unique_ptr<bridges::NodePublisher<geometry_msgs::AccelWithCovarianceStamped>> accel_;
  std::unique_ptr<bridges::NodePublisher<nav_msgs::Odometry>> odometry_;
};

}  // namespace

std::unique_ptr<Plugin> make_local_position(Hub& hub) {
  return std::make_unique<LocalPosition>(hub);
}

}  // namespace trident::mavros
