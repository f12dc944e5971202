// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/setpoint_output.h"

#include "trident_bridges/autopilot/rover_steering.h"
#include "trident_bridges_ros/mavlink/setpoint_messages.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::bridges {
namespace {

using Kind = Setpoint::Kind;

/// To the Lee controller's node.
class MultirotorOutput : public SetpointOutput {
 public:
  MultirotorOutput(ros::NodeHandle& node, double max_thrust_N)
      : max_thrust_N_(max_thrust_N),
        trajectory_(node, "command/trajectory"),
        attitude_(node, "command/attitude_thrust"),
        rates_(node, "command/rate_thrust"),
        stop_(node, "command/stop") {}

  void publish(const Setpoint& setpoint, const SetpointContext& context) override {
    const std_msgs::Header header = setpoint_header(context.stamp, context.frame);
    const Setpoint local = in_frame(setpoint, context.T_world_frame.inverse());
    switch (setpoint.kind) {
      case Kind::kTrajectory:
        return trajectory_.publish(to_trajectory(local, header));
      case Kind::kAttitude:
        return attitude_.publish(to_attitude_thrust(local, max_thrust_N_, header));
      case Kind::kRates:
        return rates_.publish(to_rate_thrust(local, max_thrust_N_, header));
      default:
        return stop_.publish(header);
    }
  }
  bool has_reader() const override {
    return trajectory_.subscribers() > 0 && attitude_.subscribers() > 0 &&
           rates_.subscribers() > 0 && stop_.subscribers() > 0;
  }
  bool is_stamped() const override { return true; }

 private:
  double max_thrust_N_;
  NodePublisher<trajectory_msgs::MultiDOFJointTrajectory> trajectory_;
  NodePublisher<mav_msgs::AttitudeThrust> attitude_;
  NodePublisher<mav_msgs::RateThrust> rates_;
  NodePublisher<std_msgs::Header> stop_;
};

/// To whatever takes speeds; their frame is the body's.
class RoverOutput : public SetpointOutput {
 public:
  explicit RoverOutput(ros::NodeHandle& node) : velocity_(node, "cmd_vel") {}

  void publish(const Setpoint& setpoint, const SetpointContext& context) override {
    const Drive drive = steer(setpoint, context.state);
    geometry_msgs::Twist message;
    message.linear.x = drive.speed_m_s;
    message.angular.z = drive.yaw_rate;
    velocity_.publish(message);
  }
  bool has_reader() const override { return velocity_.subscribers() > 0; }
  bool is_stamped() const override { return false; }

 private:
  NodePublisher<geometry_msgs::Twist> velocity_;
};

/// To the vessel controller's node. A leg's path is given once, because it begins again whenever it
/// comes; its speed is given each time and shows the world that the set-point is there.
class BoatOutput : public SetpointOutput {
 public:
  explicit BoatOutput(ros::NodeHandle& node)
      : path_(node, "command/path"),
        cruise_(node, "command/cruise"),
        velocity_(node, "command/velocity"),
        station_(node, "command/pose"),
        stop_(node, "command/stop") {}

  void publish(const Setpoint& setpoint, const SetpointContext& context) override {
    const std_msgs::Header header = setpoint_header(context.stamp, context.frame);
    const Setpoint local = in_frame(setpoint, context.T_world_frame.inverse());
    switch (setpoint.kind) {
      case Kind::kLeg:
        if (!is_same_leg(local) || context.stamp == path_stamp_) {
          path_.publish(to_path(local, header));
          path_stamp_ = context.stamp;
        }
        cruise_.publish(to_cruise(local, header));
        break;
      case Kind::kStation:
        station_.publish(to_station(local, header));
        break;
      case Kind::kDrive:
        velocity_.publish(to_velocity(local, header));
        break;
      default:
        stop_.publish(header);
        break;
    }
    last_ = local;
  }
  bool has_reader() const override {
    return path_.subscribers() > 0 && cruise_.subscribers() > 0 && velocity_.subscribers() > 0 &&
           station_.subscribers() > 0 && stop_.subscribers() > 0;
  }
  bool is_stamped() const override { return true; }

 private:
  bool is_same_leg(const Setpoint& setpoint) const {
    return last_.kind == Kind::kLeg && last_.p_m == setpoint.p_m &&
           last_.p_from_m == setpoint.p_from_m;
  }

  NodePublisher<nav_msgs::Path> path_;
  NodePublisher<geometry_msgs::TwistStamped> cruise_;
  NodePublisher<geometry_msgs::TwistStamped> velocity_;
  NodePublisher<geometry_msgs::PoseStamped> station_;
  NodePublisher<std_msgs::Header> stop_;
  Setpoint last_;
  SimTime path_stamp_{-1};
};

}  // namespace

std::unique_ptr<SetpointOutput> make_setpoint_output(ros::NodeHandle& node,
                                                     mavlink::VehicleKind kind,
                                                     double max_thrust_N) {
  switch (kind) {
    case mavlink::VehicleKind::kRover:
      return std::make_unique<RoverOutput>(node);
    case mavlink::VehicleKind::kBoat:
      return std::make_unique<BoatOutput>(node);
    default:
      return std::make_unique<MultirotorOutput>(node, max_thrust_N);
  }
}

}  // namespace trident::bridges
