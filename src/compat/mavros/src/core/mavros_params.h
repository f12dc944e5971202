// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/distance_sensor_params.h"
#include "core/extras_params.h"
#include "core/tf_params.h"
#include "trident_ros/node_params.h"

namespace trident::mavros {

/// Of the connection to the vehicle.
struct ConnectionParams {
  double timeout = 10.0;          ///< without HEARTBEATs it is lost [s]
  double heartbeat_rate = 1.0;    ///< of this node [Hz]; 0: sends none
  double timesync_rate = 10.0;    ///< [Hz]; 0: clocks are not compared
  double system_time_rate = 1.0;  ///< [Hz]; 0: the vehicle gets no SYSTEM_TIME
  std::string heartbeat_mav_type = "ONBOARD_CONTROLLER";  ///< MAV_TYPE of this node

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("timeout", timeout, Range::positive(), "without HEARTBEATs the vehicle is lost [s]");
    ar.field("heartbeat_rate", heartbeat_rate, Range{0, 100}, "of this node [Hz]; 0: sends none");
    ar.field("timesync_rate", timesync_rate, Range{0, 1000}, "[Hz]; 0: clocks are not compared");
    ar.field("system_time_rate", system_time_rate, Range{0, 100},
             "[Hz]; 0: the vehicle gets no SYSTEM_TIME");
    ar.field("heartbeat_mav_type", heartbeat_mav_type,
             "ONBOARD_CONTROLLER, GCS, ... : MAV_TYPE of this node");
  }
};

/// Of the plugins sys_status and sys_time.
struct StatusParams {
  std::vector<double> min_voltage{10.0};  ///< of each battery [V]
  bool disable_diag = false;              ///< no diagnostics but those of the HEARTBEAT

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("min_voltage", min_voltage, "of each battery, below it diagnostics warn [V]");
    ar.field("disable_diag", disable_diag, "no diagnostics but those of the HEARTBEAT");
  }
};

/// Of the plugin sys_time, and of all stamps.
struct TimeParams {
  std::string source = "auto";            ///< sim, fcu or wall: whose time stamps are
  std::string time_ref_source = "fcu";    ///< of time_reference
  std::string timesync_mode = "MAVLINK";  ///< kept for files; NONE: clocks are not compared
  double timesync_avg_alpha = 0.6;        ///< kept for files; has no effect

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("source", source, "of stamps: sim, fcu, wall; auto: sim with /use_sim_time, else fcu");
    ar.field("time_ref_source", time_ref_source, "of time_reference");
    ar.field("timesync_mode", timesync_mode, "MAVLINK; NONE: clocks are not compared");
    ar.field("timesync_avg_alpha", timesync_avg_alpha, "kept for files; has no effect");
  }
};

/// Of the plugins that publish where the vehicle is.
struct PositionParams {
  std::string frame_id = "map";              ///< of the poses
  std::string child_frame_id = "base_link";  ///< of the twists
  double rot_covariance = 99999.0;           ///< of the attitude [rad^2]
  double gps_uere = 1.0;                     ///< user equivalent range error [m]
  bool use_relative_alt = true;              ///< heights of global_position/local are above home
  TfParams tf;                               ///< of the transform

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("frame_id", frame_id, "of the poses");
    ar.field("child_frame_id", child_frame_id, "of the twists");
    ar.field("rot_covariance", rot_covariance, Range{0, 1e9}, "of the attitude [rad^2]");
    ar.field("gps_uere", gps_uere, Range::positive(), "user equivalent range error [m]");
    ar.field("use_relative_alt", use_relative_alt, "local heights are those above home");
    ar.field("tf", tf, "the transform");
  }
};

/// Of the plugin imu.
struct ImuParams {
  std::string frame_id = "base_link";            ///< of all its messages
  double linear_acceleration_stdev = 0.0003;     ///< [m/s^2]
  double angular_velocity_stdev = 0.0003490659;  ///< [rad/s]
  double orientation_stdev = 1.0;                ///< [rad]
  double magnetic_stdev = 0.0;                   ///< [T]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("frame_id", frame_id, "of all messages");
    ar.field("linear_acceleration_stdev", linear_acceleration_stdev, Range{0, 1e3}, "[m/s^2]");
    ar.field("angular_velocity_stdev", angular_velocity_stdev, Range{0, 1e3}, "[rad/s]");
    ar.field("orientation_stdev", orientation_stdev, Range{0, 1e3}, "[rad]");
    ar.field("magnetic_stdev", magnetic_stdev, Range{0, 1e3}, "[T]");
  }
};

/// Of the plugins that send set-points; each uses some of them.
struct SetpointParams {
  std::string mav_frame = "LOCAL_NED";  ///< or BODY_NED, BODY_OFFSET_NED, LOCAL_OFFSET_NED
  bool send_force = false;              ///< accelerations are forces [N]
  bool reverse_thrust = false;          ///< thrust may be negative
  bool use_quaternion = false;          ///< attitude from setpoint_attitude/attitude
  double thrust_scaling = 1.0;          ///< of setpoint_raw/attitude
  TfParams tf;                          ///< that may be followed, in place of topics

  /// Of a plugin that may follow a transform `map` -> `child`.
  static SetpointParams following(const std::string& child) {
    constexpr double kRate_hz = 50.0;
    SetpointParams params;
    params.tf = TfParams::followed(child, kRate_hz);
    return params;
  }

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("mav_frame", mav_frame, "LOCAL_NED, LOCAL_OFFSET_NED, BODY_NED or BODY_OFFSET_NED");
    ar.field("send_force", send_force, "accelerations are forces [N]");
    ar.field("reverse_thrust", reverse_thrust, "thrust may be negative");
    ar.field("use_quaternion", use_quaternion, "attitudes come from setpoint_attitude/attitude");
    ar.field("thrust_scaling", thrust_scaling, Range::positive(), "of setpoint_raw/attitude");
    ar.field("tf", tf, "what setpoint_position and setpoint_attitude may follow");
  }
};

/// Of the plugin command.
struct CommandParams {
  bool use_comp_id_system_control = false;  ///< has no effect

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("use_comp_id_system_control", use_comp_id_system_control, "kept for files");
  }
};

/// Of the plugin waypoint.
struct MissionParams {
  bool pull_after_gcs = true;        ///< pull again where a ground station has changed the mission
  bool use_mission_item_int = true;  ///< kept for files: items are always MISSION_ITEM_INT
  bool enable_partial_push = true;   ///< kept for files: a list is always sent whole

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("pull_after_gcs", pull_after_gcs,
             "pull again where a ground station has changed the mission");
    ar.field("use_mission_item_int", use_mission_item_int,
             "kept for files: items are always MISSION_ITEM_INT");
    ar.field("enable_partial_push", enable_partial_push,
             "kept for files: a list is always sent whole");
  }
};

/// Of the plugin 3dr_radio.
struct RadioParams {
  int low_rssi = 40;  ///< below it diagnostics warn

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("low_rssi", low_rssi, Range{0, 255}, "below it diagnostics warn");
  }
};

/// Private parameters of mavros_node, under upstream's names.
struct MavrosParams {
  std::string fcu_url = "/dev/ttyACM0:57600";  ///< of the vehicle
  std::string gcs_url;                         ///< of the ground station; empty: has none
  std::string fcu_protocol = "v2.0";           ///< kept for files: MAVLink 2 is sent
  int system_id = 1;                           ///< of this node
  int component_id = 240;                      ///< of this node: MAV_COMP_ID_UDP_BRIDGE
  int target_system_id = 1;                    ///< of the vehicle
  int target_component_id = 1;                 ///< of the vehicle
  bool startup_px4_usb_quirk = false;          ///< kept for files; has no effect
  bool allow_remote = false;                   ///< other computers may be reached
  double max_peer_rate = 20'000.0;             ///< packets of a peer [1/s]; more are dropped
  std::string signing_key_file;                ///< signs, and asks for signatures; empty: none
  std::string frame_prefix;                    ///< before all frame ids; not set: by the name
  std::vector<std::string> plugin_blacklist;   ///< globs of names that are not loaded
  std::vector<std::string> plugin_whitelist;   ///< globs of names that are loaded all the same
  std::vector<std::string> plugin_denylist;    ///< as plugin_blacklist
  std::vector<std::string> plugin_allowlist;   ///< as plugin_whitelist
  ConnectionParams conn;                       ///< connection
  StatusParams sys;                            ///< sys_status
  TimeParams time;                             ///< sys_time
  PositionParams global_position;              ///< global_position
  PositionParams local_position;               ///< local_position
  ImuParams imu;                               ///< imu
  /// setpoint_position
  SetpointParams setpoint_position = SetpointParams::following("target_position");
  SetpointParams setpoint_velocity;  ///< setpoint_velocity
  SetpointParams setpoint_accel;     ///< setpoint_accel
  /// setpoint_attitude
  SetpointParams setpoint_attitude = SetpointParams::following("target_attitude");
  SetpointParams setpoint_raw;         ///< setpoint_raw
  SetpointParams setpoint_trajectory;  ///< setpoint_trajectory
  CommandParams cmd;                   ///< command
  MissionParams mission;               ///< waypoint
  RadioParams tdr_radio;               ///< 3dr_radio
  FakeGpsParams fake_gps;              ///< fake_gps
  WheelOdometryParams wheel_odometry;  ///< wheel_odometry
  VisionPoseParams vision_pose;        ///< vision_pose_estimate
  /// By their names: the sections of ~distance_sensor, which is read apart.
  std::map<std::string, DistanceSensorParams> distance_sensor;
  std::vector<std::string> problems;  ///< sentences about what is left out, for the log

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    visit_node(ar);
    ar.field("conn", conn, "connection");
    ar.field("sys", sys, "sys_status");
    ar.field("time", time, "sys_time");
    ar.field("global_position", global_position, "global_position");
    ar.field("local_position", local_position, "local_position");
    ar.field("imu", imu, "imu");
    ar.field("setpoint_position", setpoint_position, "setpoint_position");
    ar.field("setpoint_velocity", setpoint_velocity, "setpoint_velocity");
    ar.field("setpoint_accel", setpoint_accel, "setpoint_accel");
    ar.field("setpoint_attitude", setpoint_attitude, "setpoint_attitude");
    ar.field("setpoint_raw", setpoint_raw, "setpoint_raw");
    ar.field("setpoint_trajectory", setpoint_trajectory, "setpoint_trajectory");
    ar.field("cmd", cmd, "command");
    ar.field("mission", mission, "waypoint");
    ar.field("tdr_radio", tdr_radio, "3dr_radio");
    ar.field("fake_gps", fake_gps, "fake_gps");
    ar.field("wheel_odometry", wheel_odometry, "wheel_odometry");
    ar.field("vision_pose", vision_pose, "vision_pose_estimate");
  }

 private:
  template <class Archive>
  void visit_node(Archive& ar) {
    ar.field("fcu_url", fcu_url, "of the vehicle: /dev/tty[:baud], serial://, udp://, tcp:// ...");
    ar.field("gcs_url", gcs_url, "of the ground station; empty: has none");
    ar.field("fcu_protocol", fcu_protocol, "kept for files: MAVLink 2 is sent, both are read");
    ar.field("system_id", system_id, Range{1, 255}, "of this node");
    ar.field("component_id", component_id, Range{1, 255}, "of this node");
    ar.field("target_system_id", target_system_id, Range{1, 255}, "of the vehicle");
    ar.field("target_component_id", target_component_id, Range{1, 255}, "of the vehicle");
    ar.field("startup_px4_usb_quirk", startup_px4_usb_quirk, "kept for files; has no effect");
    ar.field("allow_remote", allow_remote, "may bind or connect to what is not loopback");
    ar.field("max_peer_rate", max_peer_rate, Range{1, 1e6},
             "packets of a peer, and of this node, that are passed on [1/s]");
    ar.field("signing_key_file", signing_key_file,
             "64 hexadecimal digits in a file of mode 600: sign, and refuse what is not signed");
    ar.field("frame_prefix", frame_prefix,
             "before all frame ids; not set: the namespace, uav1/ for /uav1/mavros");
    ar.field("plugin_blacklist", plugin_blacklist, "globs of plugins that are not loaded");
    ar.field("plugin_whitelist", plugin_whitelist, "globs of plugins that are loaded all the same");
    ar.field("plugin_denylist", plugin_denylist, "as plugin_blacklist");
    ar.field("plugin_allowlist", plugin_allowlist, "as plugin_whitelist");
  }
};

/// Reads a node's parameters. Files of upstream are read as they are: a number with a C comment
/// behind it, one voltage in place of a list, sections of plugins that do not exist here.
/// `node_name` is absolute: its namespace is the prefix of frames where none is set. Throws
/// ConfigError with the parameter, its value and the legal range; a section of ~distance_sensor
/// that cannot be used is left out and named in `problems`.
MavrosParams read_mavros_params(ros_utils::NodeParams& params, const std::string& node_name);

}  // namespace trident::mavros
