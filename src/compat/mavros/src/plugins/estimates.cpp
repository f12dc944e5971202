// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <nav_msgs/Odometry.h>

#include <cmath>
#include <limits>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::Matrix6;
using bridges::mavlink::swap_attitude;
using bridges::mavlink::swap_body;
using bridges::mavlink::swap_body_covariance;
using bridges::mavlink::swap_world;
using bridges::mavlink::swap_world_covariance;

/// A pose that somebody else has estimated. World ENU, body FLU.
struct EstimatedPose {
  Eigen::Vector3d p_m;
  Eigen::Quaterniond R_world_body;
};

EstimatedPose estimated(const geometry_msgs::Pose& pose) {
  return {to_eigen(pose.position), to_rotation(pose.orientation)};
}

/// NaN in the first field of MAVLink.
Matrix6 unknown() {
  Matrix6 covariance = Matrix6::Zero();
  covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  return covariance;
}

/// Where the vehicle is by somebody else: what the plugins of estimates share.
class EstimatePlugin : public Plugin {
 public:
  EstimatePlugin(Hub& hub, const std::string& name) : hub_(hub), name_(name) {}

 protected:
  /// False, and a refusal: the pose has numbers that are not finite.
  bool accept(const EstimatedPose& pose) {
    if (pose.p_m.allFinite() && pose.R_world_body.coeffs().allFinite()) return true;
    hub_.ros.refusals().note("estimates refused", name_ + ": pose is not finite");
    return false;
  }
  bool accept(const Eigen::Vector3d& velocity) {
    if (velocity.allFinite()) return true;
    hub_.ros.refusals().note("estimates refused", name_ + ": velocity is not finite");
    return false;
  }
  /// [us] for fields `usec`.
  static std::uint64_t microseconds(const ros::Time& stamp) { return stamp.toNSec() / 1000; }

  Hub& hub_;

 private:
  std::string name_;
};

/// vision_pose/pose and pose_cov become VISION_POSITION_ESTIMATE.
class VisionPose : public EstimatePlugin {
 public:
  explicit VisionPose(Hub& hub) : EstimatePlugin(hub, "vision_pose") {
    const TfParams& tf = hub.params.vision_pose.tf;
    if (tf.listen) {
      hub.ros.follow(tf, [this](const auto& pose) {
        send_pose(pose.stamp, {pose.p_m, pose.R_parent_child}, unknown());
      });
      return;
    }
    hub.ros.subscribe<geometry_msgs::PoseStamped>("vision_pose/pose", [this](const auto& m) {
      send_pose(m.header.stamp, estimated(m.pose), unknown());
    });
    hub.ros.subscribe<geometry_msgs::PoseWithCovarianceStamped>(
        "vision_pose/pose_cov", [this](const auto& m) {
          send_pose(m.header.stamp, estimated(m.pose.pose),
                    swap_world_covariance(to_matrix6(m.pose.covariance)));
        });
  }

 private:
  void send_pose(const ros::Time& stamp, const EstimatedPose& pose, const Matrix6& covariance) {
    if (!accept(pose)) return;
    const Eigen::Vector3d p = swap_world(pose.p_m);
    const Eigen::Vector3d angles = to_euler(swap_attitude(pose.R_world_body));
    mavlink_vision_position_estimate_t payload{};
    payload.usec = microseconds(stamp);
    payload.x = static_cast<float>(p.x());
    payload.y = static_cast<float>(p.y());
    payload.z = static_cast<float>(p.z());
    payload.roll = static_cast<float>(angles.x());
    payload.pitch = static_cast<float>(angles.y());
    payload.yaw = static_cast<float>(angles.z());
    to_upper_triangle(covariance, payload.covariance);
    send(hub_.vehicle, payload);
  }
};

/// vision_speed/... become VISION_SPEED_ESTIMATE.
class VisionSpeed : public EstimatePlugin {
 public:
  explicit VisionSpeed(Hub& hub) : EstimatePlugin(hub, "vision_speed") {
    hub.ros.subscribe<geometry_msgs::TwistStamped>(
        "vision_speed/speed_twist",
        [this](const auto& m) { send_speed(m.header.stamp, to_eigen(m.twist.linear), unknown()); });
    hub.ros.subscribe<geometry_msgs::TwistWithCovarianceStamped>(
        "vision_speed/speed_twist_cov", [this](const auto& m) {
          send_speed(m.header.stamp, to_eigen(m.twist.twist.linear),
                     swap_world_covariance(to_matrix6(m.twist.covariance)));
        });
    hub.ros.subscribe<geometry_msgs::Vector3Stamped>(
        "vision_speed/speed_vector",
        [this](const auto& m) { send_speed(m.header.stamp, to_eigen(m.vector), unknown()); });
  }

 private:
  void send_speed(const ros::Time& stamp, const Eigen::Vector3d& v_m_s, const Matrix6& covariance) {
    if (!accept(v_m_s)) return;
    const Eigen::Vector3d v = swap_world(v_m_s);
    mavlink_vision_speed_estimate_t payload{};
    payload.usec = microseconds(stamp);
    payload.x = static_cast<float>(v.x());
    payload.y = static_cast<float>(v.y());
    payload.z = static_cast<float>(v.z());
    constexpr int kRows = 3;  // of the velocity, row by row
    for (int i = 0; i < kRows * kRows; ++i) {
      payload.covariance[i] = static_cast<float>(covariance(i / kRows, i % kRows));
    }
    send(hub_.vehicle, payload);
  }
};

/// mocap/pose or mocap/tf become ATT_POS_MOCAP.
class Mocap : public EstimatePlugin {
 public:
  explicit Mocap(Hub& hub) : EstimatePlugin(hub, "mocap") {
    hub.ros.subscribe<geometry_msgs::PoseStamped>(
        "mocap/pose", [this](const auto& m) { send_mocap(m.header.stamp, estimated(m.pose)); });
    hub.ros.subscribe<geometry_msgs::TransformStamped>("mocap/tf", [this](const auto& m) {
      send_mocap(m.header.stamp,
                 {to_eigen(m.transform.translation), to_rotation(m.transform.rotation)});
    });
  }

 private:
  void send_mocap(const ros::Time& stamp, const EstimatedPose& pose) {
    if (!accept(pose)) return;
    const Eigen::Vector3d p = swap_world(pose.p_m);
    const Eigen::Quaterniond q = swap_attitude(pose.R_world_body);
    mavlink_att_pos_mocap_t payload{};
    payload.time_usec = microseconds(stamp);
    assign_q(payload, q);
    payload.x = static_cast<float>(p.x());
    payload.y = static_cast<float>(p.y());
    payload.z = static_cast<float>(p.z());
    payload.covariance[0] = std::numeric_limits<float>::quiet_NaN();  // not known
    send(hub_.vehicle, payload);
  }
};

/// ODOMETRY from the vehicle as odometry/in, and odometry/out to the vehicle. In NED or FRD of the
/// world and FRD of the body.
class Odom : public EstimatePlugin {
 public:
  explicit Odom(Hub& hub)
      : EstimatePlugin(hub, "odometry"), frd_frame_(hub.params.frame_prefix + "odom") {
    in_ = hub.ros.advertise<nav_msgs::Odometry>("odometry/in");
    on<mavlink_odometry_t>(hub.vehicle, [this](const auto& p) { publish(p); });
    hub.ros.subscribe<nav_msgs::Odometry>("odometry/out",
                                          [this](const auto& m) { send_odometry(m); });
  }

 private:
  void publish(const mavlink_odometry_t& p) {
    const bool is_ned = p.frame_id == MAV_FRAME_LOCAL_NED;
    const Eigen::Quaterniond q(p.q[0], p.q[1], p.q[2], p.q[3]);
    nav_msgs::Odometry& odometry = odometry_;
    odometry.header.stamp = hub_.vehicle.stamp_us(p.time_usec);
    odometry.header.frame_id = is_ned ? hub_.params.local_position.frame_id : frd_frame_;
    odometry.child_frame_id = hub_.params.local_position.child_frame_id;
    const Eigen::Vector3d position(p.x, p.y, p.z);
    assign(odometry.pose.pose.position, is_ned ? swap_world(position) : swap_body(position));
    assign_rotation(odometry.pose.pose.orientation, is_ned ? swap_attitude(q) : swap_both(q));
    const Matrix6 covariance = from_upper_triangle(p.pose_covariance);
    assign_matrix6(odometry.pose.covariance,
                   is_ned ? swap_world_covariance(covariance) : swap_body_covariance(covariance));
    assign(odometry.twist.twist.linear, swap_body({p.vx, p.vy, p.vz}));
    assign(odometry.twist.twist.angular, swap_body({p.rollspeed, p.pitchspeed, p.yawspeed}));
    assign_matrix6(odometry.twist.covariance,
                   swap_body_covariance(from_upper_triangle(p.velocity_covariance)));
    in_->publish(odometry);
  }
  /// Of FRD in FRD to FLU in FLU: both turn by half about x.
  static Eigen::Quaterniond swap_both(const Eigen::Quaterniond& q) {
    return {q.w(), q.x(), -q.y(), -q.z()};
  }

  void send_odometry(const nav_msgs::Odometry& m) {
    const EstimatedPose pose = estimated(m.pose.pose);
    const Eigen::Vector3d v_body = to_eigen(m.twist.twist.linear);
    if (!accept(pose) || !accept(v_body)) return;
    const Eigen::Vector3d p = swap_world(pose.p_m), v = swap_body(v_body);
    const Eigen::Vector3d w = swap_body(to_eigen(m.twist.twist.angular));
    const Eigen::Quaterniond q = swap_attitude(pose.R_world_body);
    mavlink_odometry_t payload{};
    payload.time_usec = microseconds(m.header.stamp);
    payload.frame_id = MAV_FRAME_LOCAL_NED;
    payload.child_frame_id = MAV_FRAME_BODY_FRD;
    payload.x = static_cast<float>(p.x());
    payload.y = static_cast<float>(p.y());
    payload.z = static_cast<float>(p.z());
    assign_q(payload, q);
    payload.vx = static_cast<float>(v.x());
    payload.vy = static_cast<float>(v.y());
    payload.vz = static_cast<float>(v.z());
    payload.rollspeed = static_cast<float>(w.x());
    payload.pitchspeed = static_cast<float>(w.y());
    payload.yawspeed = static_cast<float>(w.z());
    payload.estimator_type = MAV_ESTIMATOR_TYPE_VISION;
    to_upper_triangle(swap_world_covariance(to_matrix6(m.pose.covariance)),
                      payload.pose_covariance);
    to_upper_triangle(swap_body_covariance(to_matrix6(m.twist.covariance)),
                      payload.velocity_covariance);
    send(hub_.vehicle, payload);
  }

  std::unique_ptr<bridges::NodePublisher<nav_msgs::Odometry>> in_;
  std::string frd_frame_;
  nav_msgs::Odometry odometry_;  // its frames keep their memory
};

}  // namespace

std::unique_ptr<Plugin> make_odom(Hub& hub) { return std::make_unique<Odom>(hub); }
std::unique_ptr<Plugin> make_vision_pose_estimate(Hub& hub) {
  return std::make_unique<VisionPose>(hub);
}
std::unique_ptr<Plugin> make_vision_speed_estimate(Hub& hub) {
  return std::make_unique<VisionSpeed>(hub);
}
std::unique_ptr<Plugin> make_mocap_pose_estimate(Hub& hub) { return std::make_unique<Mocap>(hub); }

}  // namespace trident::mavros
