// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/Trajectory.h>
#include <nav_msgs/Path.h>
#include <std_srvs/Trigger.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/conversions.h"
#include "core/setpoints.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "plugins/setpoint_plugin.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::swap_world;
using bridges::mavlink::swap_yaw;
using mavros_msgs::PositionTarget;
using mavros_msgs::Trajectory;
using trajectory_msgs::MultiDOFJointTrajectory;
using trajectory_msgs::MultiDOFJointTrajectoryPoint;

constexpr unsigned kNoVelocity = 7U << 3, kNoAcceleration = 7U << 6, kNoYawRate = 1U << 11;
constexpr int kLongest_s = 86'400;  // of a trajectory

/// A point as a set-point: what it does not have is ignored. Angles of the pose other than yaw are,
/// too.
LocalTarget target_of(const MultiDOFJointTrajectoryPoint& point, std::uint8_t frame) {
  LocalTarget target = position_target(frame);
  target.p_m = to_eigen(point.transforms.front().translation);
  target.yaw = yaw_of(to_rotation(point.transforms.front().rotation));
  if (!point.velocities.empty()) {
    target.mask &= static_cast<std::uint16_t>(~(kNoVelocity | kNoYawRate));
    target.v_m_s = to_eigen(point.velocities.front().linear);
    target.yaw_rate_rad_s = point.velocities.front().angular.z;
  }
  if (!point.accelerations.empty()) {
    target.mask &= static_cast<std::uint16_t>(~kNoAcceleration);
    target.a_m_s2 = to_eigen(point.accelerations.front().linear);
  }
  return target;
}

/// setpoint_trajectory/local: the point that is due is sent about 20 times a second, the last one
/// until another trajectory comes or the service reset is called.
class SetpointTrajectory : public SetpointPlugin {
 public:
  explicit SetpointTrajectory(Hub& hub)
      : SetpointPlugin(hub, hub.params.setpoint_trajectory, "setpoint_trajectory") {
    serve_frame();
    desired_ = hub.ros.advertise<nav_msgs::Path>("setpoint_trajectory/desired");
    hub.ros.subscribe<MultiDOFJointTrajectory>("setpoint_trajectory/local",
                                               [this](const auto& message) { begin(message); });
    hub.ros.serve<std_srvs::Trigger>("setpoint_trajectory/reset", [this](const auto&) {
      std_srvs::Trigger::Response response;
      response.success = static_cast<std::uint8_t>(!trajectory_.points.empty());
      if (response.success == 0U) response.message = "no trajectory is followed";
      trajectory_.points.clear();
      return response;
    });
    hub.vehicle.on_tick([this](SimTime) { send_due(); });
  }

 private:
  std::string problem_of_point(const MultiDOFJointTrajectoryPoint& point,
                               const ros::Duration& last) const {
    if (point.transforms.empty()) return "it has no transform";
    if (point.time_from_start < last) return "time_from_start is before that before it";
    if (point.time_from_start.sec > kLongest_s) return "time_from_start is more than a day";
    return problem_of(target_of(point, frame()));
  }

  std::string problem_of_trajectory(const MultiDOFJointTrajectory& message) const {
    ros::Duration last(0.0);
    for (std::size_t i = 0; i < message.points.size(); ++i) {
      const std::string problem = problem_of_point(message.points[i], last);
      if (!problem.empty()) return "point " + std::to_string(i) + ": " + problem;
      last = message.points[i].time_from_start;
    }
    return message.points.empty() ? "it has no points" : "";
  }

  void begin(const MultiDOFJointTrajectory& message) {
    const std::string problem = problem_of_trajectory(message);
    if (!problem.empty()) return refuse(problem);
    trajectory_ = message;
    begun_ = ros::Time::now();
    nav_msgs::Path path;
    path.header.stamp = begun_;
    path.header.frame_id = hub_.params.local_position.frame_id;
    for (const auto& point : message.points) {
      geometry_msgs::PoseStamped pose;
      pose.header.stamp = begun_ + point.time_from_start;
      pose.header.frame_id = path.header.frame_id;
      assign(pose.pose.position, to_eigen(point.transforms.front().translation));
      pose.pose.orientation = point.transforms.front().rotation;
      path.poses.push_back(pose);
    }
    desired_->publish(path);
  }

  void send_due() {
    if (trajectory_.points.empty()) return;
    const ros::Time now = ros::Time::now();
    const MultiDOFJointTrajectoryPoint* due = &trajectory_.points.front();
    for (const auto& point : trajectory_.points) {
      if (begun_ + point.time_from_start <= now) due = &point;
    }
    send_local(now, target_of(*due, frame()));
  }

  std::unique_ptr<bridges::NodePublisher<nav_msgs::Path>> desired_;
  MultiDOFJointTrajectory trajectory_;
  ros::Time begun_;
};

constexpr std::size_t kPoints = 5;  // of TRAJECTORY_REPRESENTATION_WAYPOINTS
constexpr float kUnset = std::numeric_limits<float>::quiet_NaN();

/// The points of a message, in their order.
template <class Message>
auto points_of(Message& m) {
  return std::array{&m.point_1, &m.point_2, &m.point_3, &m.point_4, &m.point_5};
}

/// trajectory/generated and trajectory/path become TRAJECTORY_REPRESENTATION_WAYPOINTS; what the
/// vehicle wants to do comes as trajectory/desired.
class TrajectoryPlugin : public Plugin {
 public:
  explicit TrajectoryPlugin(Hub& hub) : hub_(hub) {
    desired_ = hub.ros.advertise<Trajectory>("trajectory/desired");
    on<mavlink_trajectory_representation_waypoints_t>(hub.vehicle,
                                                      [this](const auto& p) { publish(p); });
    hub.ros.subscribe<Trajectory>("trajectory/generated",
                                  [this](const auto& message) { send_generated(message); });
    hub.ros.subscribe<nav_msgs::Path>("trajectory/path",
                                      [this](const auto& message) { send_path(message); });
  }

 private:
  using Payload = mavlink_trajectory_representation_waypoints_t;

  static void write_point(Payload& payload, std::size_t i, const Eigen::Vector3d& p,
                          const Eigen::Vector3d& v, const Eigen::Vector3d& a) {
    payload.pos_x[i] = static_cast<float>(p.x());
    payload.pos_y[i] = static_cast<float>(p.y());
    payload.pos_z[i] = static_cast<float>(p.z());
    payload.vel_x[i] = static_cast<float>(v.x());
    payload.vel_y[i] = static_cast<float>(v.y());
    payload.vel_z[i] = static_cast<float>(v.z());
    payload.acc_x[i] = static_cast<float>(a.x());
    payload.acc_y[i] = static_cast<float>(a.y());
    payload.acc_z[i] = static_cast<float>(a.z());
  }
  /// A message in which no point counts: NaN and command UINT16_MAX.
  static Payload empty_payload(const ros::Time& stamp) {
    Payload payload{};
    payload.time_usec = stamp.toNSec() / 1000;
    const Eigen::Vector3d unset = Eigen::Vector3d::Constant(kUnset);
    for (std::size_t i = 0; i < kPoints; ++i) {
      write_point(payload, i, unset, unset, unset);
      payload.pos_yaw[i] = payload.vel_yaw[i] = kUnset;
      payload.command[i] = UINT16_MAX;
    }
    return payload;
  }

  void send_generated(const Trajectory& message) {
    if (message.type != Trajectory::MAV_TRAJECTORY_REPRESENTATION_WAYPOINTS) {
      hub_.ros.refusals().note(
          "trajectories refused",
          "trajectory/generated: type is " + std::to_string(message.type) + ", legal: 0, points");
      return;
    }
    Payload payload = empty_payload(message.header.stamp);
    const auto points = points_of(message);
    for (std::size_t i = 0; i < kPoints && message.point_valid[i] != 0; ++i) {
      const PositionTarget& point = *points[i];
      write_point(payload, i, swap_world(to_eigen(point.position)),
                  swap_world(to_eigen(point.velocity)),
                  swap_world(to_eigen(point.acceleration_or_force)));
      payload.pos_yaw[i] = static_cast<float>(swap_yaw(point.yaw));
      payload.vel_yaw[i] = -point.yaw_rate;
      payload.command[i] = message.command[i];
      ++payload.valid_points;
    }
    send(hub_.vehicle, payload);
  }

  void send_path(const nav_msgs::Path& message) {
    Payload payload = empty_payload(message.header.stamp);
    const Eigen::Vector3d unset = Eigen::Vector3d::Constant(kUnset);
    for (std::size_t i = 0; i < std::min(kPoints, message.poses.size()); ++i) {
      const geometry_msgs::Pose& pose = message.poses[i].pose;
      write_point(payload, i, swap_world(to_eigen(pose.position)), unset, unset);
      payload.pos_yaw[i] = static_cast<float>(swap_yaw(yaw_of(to_rotation(pose.orientation))));
      ++payload.valid_points;
    }
    send(hub_.vehicle, payload);
  }

  void publish(const Payload& p) {
    Trajectory message;
    message.header.stamp = hub_.vehicle.stamp_us(p.time_usec);
    message.header.frame_id = hub_.params.local_position.frame_id;
    message.type = Trajectory::MAV_TRAJECTORY_REPRESENTATION_WAYPOINTS;
    const auto points = points_of(message);
    for (std::size_t i = 0; i < kPoints; ++i) {
      PositionTarget& point = *points[i];
      point.header = message.header;
      point.coordinate_frame = PositionTarget::FRAME_LOCAL_NED;
      assign(point.position, swap_world({p.pos_x[i], p.pos_y[i], p.pos_z[i]}));
      assign(point.velocity, swap_world({p.vel_x[i], p.vel_y[i], p.vel_z[i]}));
      assign(point.acceleration_or_force, swap_world({p.acc_x[i], p.acc_y[i], p.acc_z[i]}));
      point.yaw = static_cast<float>(swap_yaw(p.pos_yaw[i]));
      point.yaw_rate = -p.vel_yaw[i];
      message.command[i] = p.command[i];
      message.point_valid[i] = static_cast<std::uint8_t>(i < p.valid_points);
      message.time_horizon[i] = kUnset;
    }
    desired_->publish(message);
  }

  Hub& hub_;
  std::unique_ptr<bridges::NodePublisher<Trajectory>> desired_;
};

}  // namespace

std::unique_ptr<Plugin> make_setpoint_trajectory(Hub& hub) {
  return std::make_unique<SetpointTrajectory>(hub);
}
std::unique_ptr<Plugin> make_trajectory(Hub& hub) {
  return std::make_unique<TrajectoryPlugin>(hub);
}

}  // namespace trident::mavros
