// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/vessel_controller_node.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Path.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Header.h>

#include <algorithm>

#include "trident_base/string_util.h"
#include "trident_control_ros/message_conversions.h"
#include "trident_ros/message_checks.h"
#include "trident_ros/schedule_fuzz.h"
#include "trident_ros/subscriptions.h"

namespace trident::control {
namespace {

using Kind = VesselCommand::Kind;

/// By the stamps of the states, not by the wall clock.
constexpr std::int64_t kDiagnosticsEveryNs = 1'000'000'000;

/// Speed and angle get the same number; which of them is read follows from the kind.
VesselCommand of_number(Kind kind, const std_msgs::Float64& message) {
  VesselCommand command;
  command.kind = kind;
  command.speed = command.angle = message.data;
  return command;
}

VesselCommand of_twist(const geometry_msgs::Twist& message) {
  VesselCommand command;
  command.speed = message.linear.x;
  command.rate = message.angular.z;
  return command;
}

VesselCommand of_cruise(const geometry_msgs::TwistStamped& message) {
  VesselCommand command;
  command.kind = Kind::kSpeed;
  command.speed = message.twist.linear.x;
  return command;
}

/// Legs are straight lines in the horizontal plane:
/// heights and orientations of the poses do not count.
VesselCommand of_path(const nav_msgs::Path& message) {
  VesselCommand command;
  command.kind = Kind::kPath;
  for (const auto& pose : message.poses) {
    command.waypoints.emplace_back(pose.pose.position.x, pose.pose.position.y);
  }
  return command;
}

VesselCommand of_pose(const geometry_msgs::PoseStamped& message) {
  const TrajectoryPoint point = to_trajectory_point(message.pose);
  VesselCommand command;
  command.kind = Kind::kStation;
  command.waypoints.emplace_back(point.p_world.head<2>());
  command.angle = point.yaw;
  return command;
}

diagnostic_msgs::KeyValue key_value(const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue result;
  result.key = key;
  result.value = value;
  return result;
}

}  // namespace

VesselControllerNode::VesselControllerNode(ros::NodeHandle& node, const VesselModel& model,
                                           const VesselControlParams& params)
    : controller_(model, params),
      motors_(node, controller_.topics().size()),
      name_(ros::this_node::getName()),
      accepted_(node.advertise<std_msgs::Header>("command/accepted_setpoint", 10)),
      cross_track_(node.advertise<std_msgs::Float64>("cross_track_error", 1)),
      diagnostics_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)) {
  for (const std::string& topic : controller_.topics()) {
    // VRX has std_msgs/Float32 for thrusts and thrust angles.
    single_.push_back(starts_with(topic, "thrusters/")
                          ? node.advertise<std_msgs::Float32>(topic, 1)
                          : node.advertise<std_msgs::Float64>(topic, 1));
  }
  listen_to_commands(node);
  odometry_ = std::make_unique<OdometryInput>(
      node, OdometryThread::kCaller,
      [this](const StampedOdometry& odometry) { on_odometry(odometry); });
}

VesselControllerNode::~VesselControllerNode() {
  odometry_.reset();
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
}

void VesselControllerNode::spin_once(std::chrono::milliseconds limit) {
  odometry_->spin_once(limit);
}

template <class Message, class Convert>
void VesselControllerNode::listen(ros::NodeHandle& node, const std::string& topic,
                                  const Convert& handler) {
  auto options = ros_utils::inline_subscription<Message>(
      topic, [handler](const boost::shared_ptr<Message const>& m) { handler(*m); }, &queue_);
  subscribers_.push_back(node.subscribe(options));
}

void VesselControllerNode::listen_to_commands(ros::NodeHandle& node) {
  for (const auto& [topic, kind] : {std::pair<std::string, Kind>{"command/heading", Kind::kHeading},
                                    {"command/course", Kind::kCourse},
                                    {"command/speed", Kind::kSpeed}}) {
    listen<std_msgs::Float64>(node, topic, [this, name = topic, k = kind](const auto& message) {
      accept(name, {}, of_number(k, message));
    });
  }
  listen<geometry_msgs::Twist>(
      node, "cmd_vel", [this](const auto& message) { accept("cmd_vel", {}, of_twist(message)); });
  listen_to_stamped_commands(node);
  listen<std_msgs::Float64>(node, "speed_through_water", [this](const auto& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    // A Float64 has no stamp: the value counts as measured at the newest state.
    const std::string problem = ros_utils::number_problem(message.data, 1e3, "speed_through_water");
    if (!problem.empty()) note("speed_through_water refused", true, problem + " m/s");
    controller_.set_log(now_, message.data);
  });
}

/// These have a header, whose stamp says at which state the command begins to act.
void VesselControllerNode::listen_to_stamped_commands(ros::NodeHandle& node) {
  listen<nav_msgs::Path>(node, "command/path", [this](const auto& message) {
    accept("command/path", message.header.stamp, of_path(message));
  });
  listen<geometry_msgs::PoseStamped>(node, "command/pose", [this](const auto& message) {
    accept("command/pose", message.header.stamp, of_pose(message));
  });
  listen<geometry_msgs::TwistStamped>(node, "command/velocity", [this](const auto& message) {
    accept("command/velocity", message.header.stamp, of_twist(message.twist));
  });
  listen<geometry_msgs::TwistStamped>(node, "command/cruise", [this](const auto& message) {
    accept("command/cruise", message.header.stamp, of_cruise(message));
  });
  listen<std_msgs::Header>(node, "command/stop", [this](const std_msgs::Header& message) {
    VesselCommand stop;
    stop.kind = Kind::kStop;
    accept("command/stop", message.stamp, stop);
  });
}

void VesselControllerNode::accept(const std::string& topic, const ros::Time& stamp,
                                  const VesselCommand& command) {
  ros_utils::hand_over("command received");
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const CommandVerdict verdict = controller_.push(to_sim_time(stamp), command);
    if (!verdict.clamped.empty()) note(topic + " clamped", false, topic + ": " + verdict.clamped);
    if (!verdict.refused.empty()) {
      note(topic + " refused", true, topic + ": " + verdict.refused + "; the last command stays");
      return;
    }
  }
  // One without a stamp counts at once, and is confirmed as such.
  std_msgs::Header confirmation;
  confirmation.stamp = stamp;
  confirmation.frame_id = topic;
  accepted_.publish(confirmation);
}

/// Under mutex_.
void VesselControllerNode::note(const std::string& kind, bool is_error, const std::string& text) {
  Problem& problem = problems_[kind];
  problem.is_error = is_error;
  problem.newest = text;
  // Each kind is logged once; how often it came is in /diagnostics.
  if (++problem.count > 1) return;
  if (is_error) {
    ROS_ERROR("%s", text.c_str());
  } else {
    ROS_WARN("%s", text.c_str());
  }
}

void VesselControllerNode::on_odometry(const StampedOdometry& odometry) {
  ros_utils::hand_over("odometry received");
  const std::lock_guard<std::mutex> lock(mutex_);
  now_ = to_sim_time(odometry.stamp);
  if (controller_.update(now_, odometry.state) != ControlStatus::ok) {
    note("odometry refused", true,
         "odometry stamped " + number_text(now_.seconds()) + " s refused: " + kInvalidStateText);
    return;
  }
  const auto commands = controller_.commands();
  std::copy(commands.begin(), commands.end(), motors_.rotor_speeds().begin());
  motors_.publish(odometry.stamp);
  publish_single();
  // After a reset of the world, time is before the last publication.
  const bool is_reset = now_ < published_at_;
  if (is_reset || now_.ns - published_at_.ns >= kDiagnosticsEveryNs) publish_diagnostics();
}

void VesselControllerNode::publish_single() {
  const auto commands = controller_.commands();
  for (std::size_t i = 0; i < single_.size(); ++i) {
    // The simulator takes the commands of all actuators in one message; these are for others.
    if (single_[i].getNumSubscribers() == 0) continue;
    if (starts_with(controller_.topics()[i], "thrusters/")) {
      std_msgs::Float32 message;
      message.data = static_cast<float>(commands[i]);
      single_[i].publish(message);
    } else {
      std_msgs::Float64 message;
      message.data = commands[i];
      single_[i].publish(message);
    }
  }
  if (cross_track_.getNumSubscribers() == 0) return;
  std_msgs::Float64 message;
  message.data = controller_.cross_track_m();
  cross_track_.publish(message);
}

void VesselControllerNode::publish_diagnostics() {
  published_at_ = now_;
  if (diagnostics_.getNumSubscribers() == 0) return;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(now_.ns, 0)));
  diagnostic_msgs::DiagnosticStatus state;
  state.name = name_ + ": mode";
  state.message = name_of(controller_.mode());
  state.values.push_back(key_value("cross_track_m", number_text(controller_.cross_track_m())));
  array.status.push_back(state);
  for (const auto& [kind, problem] : problems_) {
    diagnostic_msgs::DiagnosticStatus status;
    status.level = problem.is_error ? diagnostic_msgs::DiagnosticStatus::ERROR
                                    : diagnostic_msgs::DiagnosticStatus::WARN;
    status.name = name_ + ": " + kind;
    status.message = problem.newest;
    status.values.push_back(key_value("count", std::to_string(problem.count)));
    array.status.push_back(status);
  }
  diagnostics_.publish(array);
}

}  // namespace trident::control
