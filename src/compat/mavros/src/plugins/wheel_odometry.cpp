// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/wheel_odometry.h"

#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <mavros_msgs/WheelOdomStamped.h>
#include <nav_msgs/Odometry.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/conversions.h"
#include "core/transforms.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::Matrix6;
using geometry_msgs::TwistWithCovarianceStamped;
using mavros_msgs::WheelOdomStamped;

constexpr int kYaw = 5;  // of a covariance of x, y, z, roll, pitch, yaw

/// Covariance of x, y and yaw as that of a pose or a twist.
Matrix6 spatial(const Eigen::Matrix3d& planar) {
  Matrix6 result = Matrix6::Zero();
  result.topLeftCorner<2, 2>() = planar.topLeftCorner<2, 2>();
  result.block<2, 1>(0, kYaw) = planar.block<2, 1>(0, 2);
  result.block<1, 2>(kYaw, 0) = planar.block<1, 2>(2, 0);
  result(kYaw, kYaw) = planar(2, 2);
  return result;
}

/// RPM and WHEEL_DISTANCE as they come, and the odometry of two wheels.
class WheelOdometryPlugin : public Plugin {
 public:
  explicit WheelOdometryPlugin(Hub& hub)
      : hub_(hub), params_(hub.params.wheel_odometry), transform_(hub.ros, params_.tf) {
    if (params_.send_raw) {
      rpm_ = hub.ros.advertise<WheelOdomStamped>("wheel_odometry/rpm");
      distance_ = hub.ros.advertise<WheelOdomStamped>("wheel_odometry/distance");
    }
    if (params_.wheel0) begin_odometry();
    on<mavlink_rpm_t>(hub.vehicle, [this](const auto& p) { on_rpm({p.rpm1, p.rpm2}); });
    on<mavlink_wheel_distance_t>(hub.vehicle, [this](const auto& p) { on_distance(p); });
  }

 private:
  void begin_odometry() {
    odometry_.emplace(params_);
    if (params_.send_twist) {
      velocity_ = hub_.ros.advertise<TwistWithCovarianceStamped>("wheel_odometry/velocity");
    } else {
      odom_ = hub_.ros.advertise<nav_msgs::Odometry>("wheel_odometry/odom");
    }
  }

  /// False, and a refusal: a wheel's value is no number, or none of a wheel.
  bool accept(const std::vector<double>& values) {
    constexpr double kMax = 1e9;
    const bool is_good = std::all_of(values.begin(), values.end(),
                                     [](double value) { return std::abs(value) <= kMax; });
    if (!is_good) hub_.ros.refusals().note("wheels refused", "a wheel's value is beyond +-1e9");
    return is_good;
  }
  static void publish_raw(bridges::NodePublisher<WheelOdomStamped>* topic, const ros::Time& stamp,
                          const std::vector<double>& values) {
    if (topic == nullptr) return;
    WheelOdomStamped message;
    message.header.stamp = stamp;
    message.data = values;
    topic->publish(message);
  }

  /// ArduPilot's RPM has no time.
  void on_rpm(const std::vector<double>& rpm) {
    if (!accept(rpm)) return;
    const ros::Time now = ros::Time::now();
    publish_raw(rpm_.get(), now, rpm);
    if (!odometry_ || !params_.use_rpm) return;
    follow_yaw();
    publish(now, odometry_->add_turns(rpm, {static_cast<std::int64_t>(now.toNSec())}));
  }
  void on_distance(const mavlink_wheel_distance_t& p) {
    const std::size_t count = std::min(std::size_t{p.count}, std::size(p.distance));
    const std::vector<double> distance_m(std::begin(p.distance), std::begin(p.distance) + count);
    constexpr std::uint64_t kMaxTime_us = INT64_MAX / 1000;
    if (count == 0 || p.time_usec > kMaxTime_us || !accept(distance_m)) return;
    const ros::Time stamp = hub_.vehicle.stamp_us(p.time_usec);
    publish_raw(distance_.get(), stamp, distance_m);
    if (!odometry_ || params_.use_rpm) return;
    follow_yaw();
    const SimTime time{static_cast<std::int64_t>(p.time_usec) * 1000};
    publish(stamp, odometry_->add_distances(distance_m, time));
  }

  /// Before the vehicle has sent its heading, the odometry has no pose.
  void follow_yaw() {
    if (has_yaw_ || !hub_.known.has_attitude) return;
    has_yaw_ = true;
    odometry_->set_yaw(yaw_of(hub_.known.R_world_body));
  }
  void publish(const ros::Time& stamp, const std::optional<WheelMotion>& motion) {
    if (!motion) return;
    geometry_msgs::TwistWithCovariance twist;
    twist.twist.linear.x = motion->twist.x();
    twist.twist.linear.y = motion->twist.y();
    twist.twist.angular.z = motion->twist.z();
    assign_matrix6(twist.covariance, spatial(motion->twist_variance.asDiagonal()));
    if (velocity_) {
      TwistWithCovarianceStamped message;
      message.header.stamp = stamp;
      message.header.frame_id = params_.child_frame_id;
      message.twist = twist;
      velocity_->publish(message);
    }
    if (has_yaw_) publish_pose(stamp, *motion, twist);
  }
  void publish_pose(const ros::Time& stamp, const WheelMotion& motion,
                    const geometry_msgs::TwistWithCovariance& twist) {
    const Eigen::Vector3d p_m(motion.T_odom_base.p.x(), motion.T_odom_base.p.y(), 0.0);
    const Eigen::Quaterniond R = from_euler(0.0, 0.0, motion.T_odom_base.angle);
    transform_.send(stamp, p_m, R);
    if (!odom_) return;
    nav_msgs::Odometry odometry;
    odometry.header.stamp = stamp;
    odometry.header.frame_id = params_.frame_id;
    odometry.child_frame_id = params_.child_frame_id;
    assign(odometry.pose.pose.position, p_m);
    assign_rotation(odometry.pose.pose.orientation, R);
    assign_matrix6(odometry.pose.covariance, spatial(motion.pose_covariance));
    odometry.twist = twist;
    odom_->publish(odometry);
  }

  Hub& hub_;
  const WheelOdometryParams& params_;
  TransformOutput transform_;
  std::optional<WheelOdometry> odometry_;
  bool has_yaw_ = false;
  std::unique_ptr<bridges::NodePublisher<WheelOdomStamped>> rpm_, distance_;
  std::unique_ptr<bridges::NodePublisher<TwistWithCovarianceStamped>> velocity_;
  std::unique_ptr<bridges::NodePublisher<nav_msgs::Odometry>> odom_;
};

}  // namespace

std::unique_ptr<Plugin> make_wheel_odometry(Hub& hub) {
  return std::make_unique<WheelOdometryPlugin>(hub);
}

}  // namespace trident::mavros
