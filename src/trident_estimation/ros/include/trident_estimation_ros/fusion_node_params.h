// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_estimation/fusion/team_fusion.h"

namespace trident::estimation {

/// One robot of a team: where its map is, how it may move, and what it is heard on.
struct FusionRobotParams {
  std::string kind;        ///< uav, ugv, usv
  std::string pose_topic;  ///< its pose in its own map
  bool planar = false;     ///< only x, y and yaw of these poses were measured
  double pose_sigma = 0.1, pose_turn_sigma = 0.02;  ///< for poses without a covariance
  std::string gnss_topic;                           ///< sensor_msgs/NavSatFix
  Eigen::Vector3d gnss_antenna = Eigen::Vector3d::Zero();
  double gnss_sigma = 2.0;    ///< for fixes without a covariance [m]
  std::string compass_topic;  ///< sensor_msgs/Imu
  double compass_sigma = 0.05;
  std::string pressure_topic;  ///< sensor_msgs/FluidPressure
  double pressure_sigma = 0.5;
  bool waterline = false;  ///< whether it floats
  double water_level = 0.0, waterline_sigma = 0.2;
  std::string shared_pose_topic;                        ///< a team mate's estimate of it
  Eigen::Vector4d map_start = Eigen::Vector4d::Zero();  ///< x, y, z [m], yaw [rad]
  double map_sigma = 1.0, map_yaw_sigma = 0.1;
  Eigen::Vector3d speed = {2.0, 2.0, 1.0}, turn = {0.2, 0.2, 0.5};
  double speed_time = 4.0, turn_time = 0.5, leveling = 2.0;
  double map_drift = 0.05, map_turn = 0.002;

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("kind", kind, "uav, ugv, usv");
    ar.field("pose_topic", pose_topic,
             "its pose in its own map: nav_msgs/Odometry, geometry_msgs/PoseStamped or "
             "PoseWithCovarianceStamped");
    ar.field("planar", planar, "only x, y and yaw of these poses were measured");
    ar.field("pose_sigma", pose_sigma, Range::positive(),
             "of positions whose covariance is missing or zero [m]");
    ar.field("pose_turn_sigma", pose_turn_sigma, Range::positive(), "of their rotations [rad]");
    ar.field("gnss_topic", gnss_topic, "sensor_msgs/NavSatFix");
    ar.field("gnss_antenna", gnss_antenna, Range::any(), "where the antenna is on the robot [m]");
    ar.field("gnss_sigma", gnss_sigma, Range::positive(),
             "of fixes whose covariance is not known [m]");
    ar.field("compass_topic", compass_topic, "sensor_msgs/Imu, whose yaw counts from east");
    ar.field("compass_sigma", compass_sigma, Range::positive(), "[rad]");
    ar.field("pressure_topic", pressure_topic, "sensor_msgs/FluidPressure, for the height");
    ar.field("pressure_sigma", pressure_sigma, Range::positive(), "of that height [m]");
    ar.field("waterline", waterline, "whether it floats: each pose says that it is at water_level");
    ar.field("water_level", water_level, Range::any(), "of its base in the world [m]");
    ar.field("waterline_sigma", waterline_sigma, Range::positive(), "by waves [m]");
    ar.field("shared_pose_topic", shared_pose_topic,
             "where a team mate believes it to be in the common frame: "
             "geometry_msgs/PoseWithCovarianceStamped");
    ar.field("map_start", map_start, Range::any(),
             "where its map is believed to be at the start: x, y, z, yaw [m, rad]");
    ar.field("map_sigma", map_sigma, Range::positive(), "of that position [m]");
    ar.field("map_yaw_sigma", map_yaw_sigma, Range::positive(), "of that heading [rad]");
    ar.field("speed", speed, Range::positive(),
             "standard deviation of its velocity along x, y, z of its base [m/s]");
    ar.field("turn", turn, Range::positive(), "the same of its angular velocity [rad/s]");
    ar.field("speed_time", speed_time, Range::positive(), "in which a velocity is forgotten [s]");
    ar.field("turn_time", turn_time, Range::positive(), "the same of an angular velocity [s]");
    ar.field("leveling", leveling, Range::non_negative(),
             "natural frequency of roll and pitch; 0: nothing levels it [rad/s]");
    ar.field("map_drift", map_drift, Range::non_negative(),
             "of its map's position in a second, growing with the square root of time [m]");
    ar.field("map_turn", map_turn, Range::non_negative(), "the same of its map's heading [rad]");
  }
};

/// Two robots that measure their distance by radio.
struct FusionRangeParams {
  std::string topic;         ///< sensor_msgs/Range
  std::string robot, other;  ///< names
  double sigma = 1.0;        ///< [m]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("topic", topic, "sensor_msgs/Range");
    ar.required("robot", robot, "name of one");
    ar.required("other", other, "name of the other");
    ar.field("sigma", sigma, Range::positive(), "[m]");
  }
};

/// The private parameters of team_fusion_node.
struct FusionNodeParams {
  int fusion_method = 1;                                       ///< 0: EKF, 1: UKF
  double update_rate = 20.0;                                   ///< [Hz]
  std::string uav_pose_topic, ugv_pose_topic, usv_pose_topic;  ///< robots uav, ugv, usv
  std::map<std::string, FusionRobotParams> robots;             ///< by name, which is the namespace
  std::string common_frame = "world";
  bool fused = false;
  double keep = 1.0, start_patience = 2.0, gate = 0.99;
  Eigen::Vector3d world_origin = {63.4389, 10.399, 0.0};
  double pressure_reference = 101325.0;
  std::vector<std::string> sighting_topics;  ///< trident_msgs/Detection
  double sighting_angle_sigma = 0.02;
  std::vector<FusionRangeParams> ranges;

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("fusion_method", fusion_method, Range{0.0, 1.0},
             "0: extended Kalman filter; 1: unscented");
    ar.field("update_rate", update_rate, Range{0.1, 1000.0},
             "of filtering and publishing, in the time of ROS [Hz]");
    ar.field("uav_pose_topic", uav_pose_topic, "pose_topic of the robot uav");
    ar.field("ugv_pose_topic", ugv_pose_topic, "pose_topic of the robot ugv");
    ar.field("usv_pose_topic", usv_pose_topic, "pose_topic of the robot usv");
    ar.field("robots", robots, "by name, which is the namespace of what is published about it");
    ar.field("common_frame", common_frame, "frame of all estimates: east, north, up");
    ar.field("fused", fused, "whether common_frame -> <name>/map is published");
    ar.field("keep", keep, Range{0.0, 60.0}, "how late a measurement may come [s]");
    ar.field("start_patience", start_patience, Range::non_negative(),
             "how long the first poses of all robots are waited for [s]");
    ar.field("gate", gate, Range{0.5, 1.0, true, true},
             "share of honest measurements that are used: of chi-squared");
    ar.field("world_origin", world_origin, Range::any(),
             "latitude, longitude [deg], height [m] of the common frame's origin");
    ar.field("pressure_reference", pressure_reference, Range::positive(), "at its height 0 [Pa]");
    ar.field("sighting_topics", sighting_topics,
             "trident_msgs/Detection: observer and label are names of robots, the pose is in the "
             "frame <observer>/base_link");
    ar.field("sighting_angle_sigma", sighting_angle_sigma, Range::positive(),
             "of sightings whose covariance is zero [rad]");
    ar.field("ranges", ranges, "robots that measure their distance by radio");
  }
  /// Throws Error when fields contradict one another.
  void validate() const;

  /// `robots`, with those that are given by their pose topics alone.
  std::map<std::string, FusionRobotParams> all_robots() const;
  /// What the core is made of.
  TeamFusionOptions options() const;
};

/// A robot as the core starts it.
RobotStart robot_start(const FusionRobotParams& params);

}  // namespace trident::estimation
