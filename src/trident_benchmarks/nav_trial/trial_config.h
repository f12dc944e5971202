// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_base/error.h"

namespace trident::benchmarks {

/// What a robot's odometry is made of and gets wrong: encoders of wheels and a gyro, or, with a
/// topic, what its drive computes. All spreads are of one sigma.
struct OdometryParams {
  std::string topic;
  double distance_error = 0.02, turn_error = 0.02;
  double yaw_walk = 0.0087;
  std::vector<std::string> left_joints, right_joints;
  double wheel_radius = 0.1;
  double ticks_per_turn = 4096.0;
  double radius_error = 0.003;
  double gyro_bias = 0.001;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("topic", topic, "of the drive's own odometry; empty: wheels and gyro");
    ar.field("distance_error", distance_error, Range{0.0, 1.0},
             "of the drive's odometry, a part of each distance; the sign is the seed's");
    ar.field("turn_error", turn_error, Range{0.0, 1.0},
             "of the drive's odometry, a part of each turn; the sign is the seed's");
    ar.field("yaw_walk", yaw_walk, Range::non_negative(),
             "random walk of the drive's heading [rad per root of a meter]");
    ar.field("left_joints", left_joints, "wheels whose mean is the left side's travel");
    ar.field("right_joints", right_joints, "wheels whose mean is the right side's travel");
    ar.field("wheel_radius", wheel_radius, Range::positive(), "as odometry believes it [m]");
    ar.field("ticks_per_turn", ticks_per_turn, Range::positive(), "of an encoder");
    ar.field("radius_error", radius_error, Range::non_negative(),
             "spread of a side's true radius, a part of it");
    ar.field("gyro_bias", gyro_bias, Range::non_negative(),
             "spread of the rate that it measures at rest [rad/s]");
  }
  /// Throws Error unless there is a topic or both sides have wheels.
  void validate() const {
    if (!topic.empty() || (!left_joints.empty() && !right_joints.empty())) return;
    throw Error("odometry: legal: a topic, or left_joints and right_joints");
  }
};

/// How a robot knows where it is in the map.
enum class Localization {
  kOdometry,  ///< By odometry alone; there is no map.
  kTruth,     ///< Exactly.
  kAmcl,      ///< By particles that explain the scans.
};
constexpr auto enum_names(Localization) {
  return std::array{EnumName{Localization::kOdometry, "odometry"},
                    EnumName{Localization::kTruth, "truth"}, EnumName{Localization::kAmcl, "amcl"}};
}

/// What a robot knows of the world before it drives.
struct MapParams {
  std::string file;
  std::array<double, 3> pose{};
  Localization localization = Localization::kOdometry;
  std::string amcl;
  std::array<double, 3> start_sigma{0.1, 0.1, 0.05};

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("file", file, "YAML file of a map; empty: none");
    ar.field("pose", pose, Range{-1e6, 1e6},
             "of the map's frame in the world: x, y [m], yaw [rad]");
    ar.field("localization", localization, "how the robot knows where it is in the map");
    ar.field("amcl", amcl, "file with amcl's parameters");
    ar.field("start_sigma", start_sigma, Range::non_negative(),
             "spread of the start that amcl is given: x, y [m], yaw [rad]");
  }
  /// Throws Error where what localizes lacks a file.
  void validate() const {
    if (localization != Localization::kAmcl) return;
    if (file.empty()) throw Error("map: localization amcl needs a file of a map");
    if (amcl.empty()) throw Error("map: localization amcl needs amcl, a file of parameters");
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
  std::vector<std::array<double, 3>> goals;
  bool ends_at_contact = true;
  std::array<double, 2> range_noise{};
  MapParams map;
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
    ar.field("goal", goal, Range{-1e6, 1e6}, "x, y [m], yaw [rad] from the start");
    ar.field("goals", goals, Range{-1e6, 1e6},
             "one after the other, x, y [m], yaw [rad] in the world; none: `goal`");
    ar.field("ends_at_contact", ends_at_contact, "else contacts are counted");
    ar.field("range_noise", range_noise, Range::non_negative(),
             "spread on top of the lidar's own: the larger one of [m] and of the range's part");
    ar.field("map", map, "what is known of the world");
    ar.field("seeds", seeds, "of all noise, one run each");
    ar.field("time_limit_s", time_limit_s, Range::positive(), "of a goal [s]");
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
