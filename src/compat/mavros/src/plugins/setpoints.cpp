// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <geographic_msgs/GeoPoseStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <mavros_msgs/Thrust.h>

#include <optional>

#include "core/conversions.h"
#include "core/setpoints.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "plugins/setpoint_plugin.h"

namespace trident::mavros {
namespace {

class SetpointPosition : public SetpointPlugin {
 public:
  explicit SetpointPosition(Hub& hub)
      : SetpointPlugin(hub, hub.params.setpoint_position, "setpoint_position") {
    serve_frame();
    const TfParams& tf = hub.params.setpoint_position.tf;
    if (tf.listen) {
      hub.ros.repeat(
          tf, [this](const auto& pose) { send_pose(pose.stamp, pose.p_m, pose.R_parent_child); });
      return;
    }
    hub.ros.subscribe<geometry_msgs::PoseStamped>(
        "setpoint_position/local", [this](const auto& message) {
          send_pose(message.header.stamp, to_eigen(message.pose.position),
                    to_rotation(message.pose.orientation));
        });
    hub.ros.subscribe<geographic_msgs::GeoPoseStamped>(
        "setpoint_position/global", [this](const auto& message) { send_global(message); });
  }

 private:
  void send_pose(const ros::Time& stamp, const Eigen::Vector3d& p_m, const Eigen::Quaterniond& R) {
    LocalTarget target = position_target(frame());
    target.p_m = p_m;
    target.yaw = yaw_of(R);
    send_local(stamp, target);
  }
  void send_global(const geographic_msgs::GeoPoseStamped& message) {
    const auto& place = message.pose.position;
    GlobalTarget target;
    target.mask = position_target(frame()).mask;
    target.frame = MAV_FRAME_GLOBAL_INT;
    target.latitude_deg = place.latitude;
    target.longitude_deg = place.longitude;
    target.altitude_m = place.altitude - hub_.known.geoid_separation_m;
    target.motion.yaw = yaw_of(to_rotation(message.pose.orientation));
    const std::string problem = problem_of(target);
    if (!problem.empty()) return refuse(problem);
    send_to_target(hub_.vehicle,
                   global_payload(target, hub_.vehicle.boot_ms(message.header.stamp)));
  }
};

class SetpointVelocity : public SetpointPlugin {
 public:
  explicit SetpointVelocity(Hub& hub)
      : SetpointPlugin(hub, hub.params.setpoint_velocity, "setpoint_velocity") {
    serve_frame();
    hub.ros.subscribe<geometry_msgs::TwistStamped>(
        "setpoint_velocity/cmd_vel",
        [this](const auto& message) { send_twist(message.header.stamp, message.twist); });
    hub.ros.subscribe<geometry_msgs::Twist>(
        "setpoint_velocity/cmd_vel_unstamped",
        [this](const auto& message) { send_twist(ros::Time(), message); });
  }

 private:
  void send_twist(const ros::Time& stamp, const geometry_msgs::Twist& twist) {
    LocalTarget target = velocity_target(frame());
    target.v_m_s = to_eigen(twist.linear);
    target.yaw_rate_rad_s = twist.angular.z;
    send_local(stamp, target);
  }
};

class SetpointAccel : public SetpointPlugin {
 public:
  explicit SetpointAccel(Hub& hub)
      : SetpointPlugin(hub, hub.params.setpoint_accel, "setpoint_accel") {
    hub.ros.subscribe<geometry_msgs::Vector3Stamped>(
        "setpoint_accel/accel", [this](const auto& message) {
          LocalTarget target = acceleration_target(hub_.params.setpoint_accel.send_force);
          target.a_m_s2 = to_eigen(message.vector);
          send_local(message.header.stamp, target);
        });
  }
};

/// Attitude or body rates, with the thrust that came last.
class SetpointAttitude : public SetpointPlugin {
 public:
  explicit SetpointAttitude(Hub& hub)
      : SetpointPlugin(hub, hub.params.setpoint_attitude, "setpoint_attitude") {
    hub.ros.subscribe<mavros_msgs::Thrust>("setpoint_attitude/thrust",
                                           [this](const auto& message) { on_thrust(message); });
    const TfParams& tf = hub.params.setpoint_attitude.tf;
    if (tf.listen) {
      hub.ros.repeat(tf,
                     [this](const auto& pose) { send_attitude(pose.stamp, pose.R_parent_child); });
    } else if (hub.params.setpoint_attitude.use_quaternion) {
      hub.ros.subscribe<geometry_msgs::PoseStamped>(
          "setpoint_attitude/attitude", [this](const auto& message) {
            send_attitude(message.header.stamp, to_rotation(message.pose.orientation));
          });
    } else {
      hub.ros.subscribe<geometry_msgs::TwistStamped>(
          "setpoint_attitude/cmd_vel", [this](const auto& message) {
            AttitudeSetpoint target;
            target.mask = kOnlyRates;
            target.w_body_rad_s = to_eigen(message.twist.angular);
            send_with_thrust(message.header.stamp, target);
          });
    }
  }

 private:
  static constexpr std::uint8_t kOnlyAttitude = 7, kOnlyRates = 128;
  static constexpr double kMaxAge_s = 1.0;

  void on_thrust(const mavros_msgs::Thrust& message) {
    const double least = hub_.params.setpoint_attitude.reverse_thrust ? -1.0 : 0.0;
    if (!(message.thrust >= least && message.thrust <= 1.0F)) {
      return refuse("thrust is " + std::to_string(message.thrust) +
                    ", legal: " + std::to_string(static_cast<int>(least)) + " to 1");
    }
    thrust_ = message.thrust;
    thrust_at_ = hub_.vehicle.now();
  }
  void send_attitude(const ros::Time& stamp, const Eigen::Quaterniond& R_world_body) {
    AttitudeSetpoint target;
    target.mask = kOnlyAttitude;
    target.R_world_body = R_world_body;
    send_with_thrust(stamp, target);
  }
  void send_with_thrust(const ros::Time& stamp, AttitudeSetpoint target) {
    if (!thrust_at_ || (hub_.vehicle.now() - *thrust_at_).seconds() > kMaxAge_s) {
      return refuse("setpoint_attitude/thrust has not come for 1 s");
    }
    target.thrust = thrust_;
    const std::string problem = problem_of(target);
    if (!problem.empty()) return refuse(problem);
    send_to_target(hub_.vehicle, attitude_payload(target, hub_.vehicle.boot_ms(stamp)));
  }

  double thrust_ = 0.0;
  std::optional<SimTime> thrust_at_;
};

}  // namespace

std::unique_ptr<Plugin> make_setpoint_position(Hub& hub) {
  return std::make_unique<SetpointPosition>(hub);
}
std::unique_ptr<Plugin> make_setpoint_velocity(Hub& hub) {
  return std::make_unique<SetpointVelocity>(hub);
}
std::unique_ptr<Plugin> make_setpoint_accel(Hub& hub) {
  return std::make_unique<SetpointAccel>(hub);
}
std::unique_ptr<Plugin> make_setpoint_attitude(Hub& hub) {
  return std::make_unique<SetpointAttitude>(hub);
}

}  // namespace trident::mavros
