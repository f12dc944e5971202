// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/AttitudeTarget.h>
#include <mavros_msgs/GlobalPositionTarget.h>
#include <mavros_msgs/PositionTarget.h>

#include "core/conversions.h"
#include "core/setpoints.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using mavros_msgs::AttitudeTarget;
using mavros_msgs::GlobalPositionTarget;
using mavros_msgs::PositionTarget;

/// Velocity, acceleration and yaw of a message of ROS.
template <class Message>
void read_motion_fields(const Message& message, LocalTarget& target) {
  target.v_m_s = to_eigen(message.velocity);
  target.a_m_s2 = to_eigen(message.acceleration_or_force);
  target.yaw = message.yaw;
  target.yaw_rate_rad_s = message.yaw_rate;
}
template <class Message>
void write_motion_fields(const LocalTarget& target, Message& message) {
  message.coordinate_frame = target.frame;
  message.type_mask = target.mask;
  assign(message.velocity, target.v_m_s);
  assign(message.acceleration_or_force, target.a_m_s2);
  message.yaw = static_cast<float>(target.yaw);
  message.yaw_rate = static_cast<float>(target.yaw_rate_rad_s);
}

/// Set-points field by field, and what the vehicle says that it follows.
class SetpointRaw : public Plugin {
 public:
  explicit SetpointRaw(Hub& hub) : hub_(hub), vehicle_(hub.vehicle) {
    hub.ros.subscribe<PositionTarget>("setpoint_raw/local",
                                      [this](const auto& message) { send_local(message); });
    hub.ros.subscribe<GlobalPositionTarget>("setpoint_raw/global",
                                            [this](const auto& message) { send_global(message); });
    hub.ros.subscribe<AttitudeTarget>("setpoint_raw/attitude",
                                      [this](const auto& message) { send_attitude(message); });
    local_ = hub.ros.advertise<PositionTarget>("setpoint_raw/target_local");
    global_ = hub.ros.advertise<GlobalPositionTarget>("setpoint_raw/target_global");
    attitude_ = hub.ros.advertise<AttitudeTarget>("setpoint_raw/target_attitude");
    on<mavlink_position_target_local_ned_t>(vehicle_, [this](const auto& p) { publish(p); });
    on<mavlink_position_target_global_int_t>(vehicle_, [this](const auto& p) { publish(p); });
    on<mavlink_attitude_target_t>(vehicle_, [this](const auto& p) { publish(p); });
  }

 private:
  void send_local(const PositionTarget& message) {
    LocalTarget target;
    target.frame = message.coordinate_frame;
    target.mask = message.type_mask;
    target.p_m = to_eigen(message.position);
    read_motion_fields(message, target);
    const std::string problem = problem_of(target);
    if (!problem.empty()) return refuse(problem);
    send_to_target(vehicle_, local_payload(target, vehicle_.boot_ms(message.header.stamp)));
  }
  void send_global(const GlobalPositionTarget& message) {
    GlobalTarget target;
    target.frame = message.coordinate_frame;
    target.mask = message.type_mask;
    target.latitude_deg = message.latitude;
    target.longitude_deg = message.longitude;
    target.altitude_m = message.altitude;
    read_motion_fields(message, target.motion);
    const std::string problem = problem_of(target);
    if (!problem.empty()) return refuse(problem);
    send_to_target(vehicle_, global_payload(target, vehicle_.boot_ms(message.header.stamp)));
  }
  void send_attitude(const AttitudeTarget& message) {
    AttitudeSetpoint target;
    target.mask = message.type_mask;
    target.R_world_body = to_rotation(message.orientation);
    target.w_body_rad_s = to_eigen(message.body_rate);
    target.thrust = message.thrust * hub_.params.setpoint_raw.thrust_scaling;
    const std::string problem = problem_of(target);
    if (!problem.empty()) return refuse(problem);
    send_to_target(vehicle_, attitude_payload(target, vehicle_.boot_ms(message.header.stamp)));
  }

  void publish(const mavlink_position_target_local_ned_t& payload) {
    const LocalTarget target = local_target(payload);
    PositionTarget message;
    message.header.stamp = vehicle_.stamp_ms(payload.time_boot_ms);
    assign(message.position, target.p_m);
    write_motion_fields(target, message);
    local_->publish(message);
  }
  void publish(const mavlink_position_target_global_int_t& payload) {
    const GlobalTarget target = global_target(payload);
    GlobalPositionTarget message;
    message.header.stamp = vehicle_.stamp_ms(payload.time_boot_ms);
    write_motion_fields(target.motion, message);
    message.latitude = target.latitude_deg;
    message.longitude = target.longitude_deg;
    message.altitude = static_cast<float>(target.altitude_m);
    global_->publish(message);
  }
  void publish(const mavlink_attitude_target_t& payload) {
    const AttitudeSetpoint target = attitude_target(payload);
    AttitudeTarget message;
    message.header.stamp = vehicle_.stamp_ms(payload.time_boot_ms);
    message.type_mask = target.mask;
    assign_rotation(message.orientation, target.R_world_body);
    assign(message.body_rate, target.w_body_rad_s);
    message.thrust = static_cast<float>(target.thrust);
    attitude_->publish(message);
  }
  void refuse(const std::string& problem) {
    hub_.ros.refusals().note("set-points refused", "setpoint_raw: " + problem);
  }

  Hub& hub_;
  VehicleSide& vehicle_;
  std::unique_ptr<bridges::NodePublisher<PositionTarget>> local_;
  std::unique_ptr<bridges::NodePublisher<GlobalPositionTarget>> global_;
  std::unique_ptr<bridges::NodePublisher<AttitudeTarget>> attitude_;
};

}  // namespace

std::unique_ptr<Plugin> make_setpoint_raw(Hub& hub) { return std::make_unique<SetpointRaw>(hub); }

}  // namespace trident::mavros
