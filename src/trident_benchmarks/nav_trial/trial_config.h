// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/config_types.h"

namespace trident::benchmarks {

/// What the wheels' encoders and the gyro of a robot get wrong. All spreads are of one sigma.
struct OdometryParams {
  std::vector<std::string> left_joints, right_joints;
  double wheel_radius = 0.1;
  double ticks_per_turn = 4096.0;
  double radius_error = 0.003;
  double gyro_bias = 0.001;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("left_joints", left_joints, "wheels whose mean is the left side's travel");
    ar.required("right_joints", right_joints, "wheels whose mean is the right side's travel");
    ar.required("wheel_radius", wheel_radius, Range::positive(), "as odometry believes it [m]");
    ar.field("ticks_per_turn", ticks_per_turn, Range::positive(), "of an encoder");
    ar.field("radius_error", radius_error, Range::non_negative(),
             "spread of a side's true radius, a part of it");
    ar.field("gyro_bias", gyro_bias, Range::non_negative(),
             "spread of the rate that it measures at rest [rad/s]");
  }
};

/// One task, driven once for each seed.
struct TrialConfig {
  std::string world, robot;
  std::string robot_name = "robot";
  std::string floor = "ground_plane";
  std::string lidar;
  std::string scan_topic = "scan", imu_topic = "imu/data", command_topic = "cmd_vel";
  std::vector<std::string> parameters;
  std::array<double, 3> start{}, goal{};
  std::vector<std::uint64_t> seeds{1};
  double time_limit_s = 100.0;
  double success_radius_m = 1.0;
  double moved_m = 0.1;
  double settle_s = 0.5;
  double odometry_rate_hz = 50.0;
  double command_delay_s = 0.02;
  double track_step_m = 0.05;
  OdometryParams odometry;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("world", world, "file of the world");
    ar.required("robot", robot, "file of the robot's URDF");
    ar.field("robot_name", robot_name, "of its model");
    ar.field("floor", floor, "model that may be touched");
    ar.required("lidar", lidar, "the sensor that scans");
    ar.field("scan_topic", scan_topic, "of the lidar");
    ar.field("imu_topic", imu_topic, "of the gyro");
    ar.field("command_topic", command_topic, "of velocities");
    ar.required("parameters", parameters, "files with move_base's; later ones win");
    ar.required("start", start, Range{-1e6, 1e6}, "x, y [m], yaw [rad] in the world");
    ar.required("goal", goal, Range{-1e6, 1e6}, "x, y [m], yaw [rad] from the start");
    ar.field("seeds", seeds, "of all noise, one run each");
    ar.field("time_limit_s", time_limit_s, Range::positive(), "of a run [s]");
    ar.field("success_radius_m", success_radius_m, Range::non_negative(),
             "so near to the goal by the truth; 0: move_base says so [m]");
    ar.field("moved_m", moved_m, Range::non_negative(), "from which the time counts [m]");
    ar.field("settle_s", settle_s, Range::non_negative(), "before the goal is given [s]");
    ar.field("odometry_rate_hz", odometry_rate_hz, Range::positive(), "[Hz]");
    ar.field("command_delay_s", command_delay_s, Range{0.0, 1.0},
             "from what a command is computed of to when the base has it [s]");
    ar.field("track_step_m", track_step_m, Range::positive(), "between points of the track [m]");
    ar.required("odometry", odometry, "of the robot");
  }
};

}  // namespace trident::benchmarks
