// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <mav_msgs/Actuators.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <rotors_comm/WindSpeed.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>
#include <std_msgs/Float32.h>
#include <uuv_gazebo_ros_plugins_msgs/FloatStamped.h>

#include "trident_base/sim_time.h"
#include "trident_sim/commands.h"
#include "trident_sim/samples.h"
#include "trident_sim/samples/vector_sample.h"

namespace trident::sim {

/// A text that may quote what a user sent, for a log or a status: without line ends and other
/// control characters, and not longer than a screen is wide a few times.
std::string one_line(std::string text);

inline ros::Time to_ros(SimTime time) {
  ros::Time result;
  result.fromNSec(static_cast<std::uint64_t>(time.ns));
  return result;
}
inline SimTime from_ros(const ros::Time& time) {
  return {static_cast<std::int64_t>(time.toNSec())};
}
inline SimTime from_ros(const ros::Duration& duration) { return {duration.toNSec()}; }

geometry_msgs::Point to_point(const Eigen::Vector3d& p);
geometry_msgs::Vector3 to_vector(const Eigen::Vector3d& v);
geometry_msgs::Quaternion to_quaternion(const Eigen::Quaterniond& q);
geometry_msgs::Pose to_pose(const SE3& T);
Eigen::Vector3d from_point(const geometry_msgs::Point& p);
Eigen::Vector3d from_vector(const geometry_msgs::Vector3& v);
/// A zero quaternion, which many callers send, counts as identity.
SE3 from_pose(const geometry_msgs::Pose& pose);
TwistCommand from_twist(const geometry_msgs::Twist& twist);

// Sample -> message. The message is reused from call to call.
void convert(const OdometrySample& sample, nav_msgs::Odometry& message);
void convert(const PoseSample& sample, geometry_msgs::Pose& message);
void convert(const PoseWithCovarianceSample& sample,
             geometry_msgs::PoseWithCovarianceStamped& message);
void convert(const PointSample& sample, geometry_msgs::PointStamped& message);
void convert(const TransformSample& sample, geometry_msgs::TransformStamped& message);
void convert(const ImuSample& sample, sensor_msgs::Imu& message);
void convert(const LaserScanSample& sample, sensor_msgs::LaserScan& message);
void convert(const FluidPressureSample& sample, sensor_msgs::FluidPressure& message);
void convert(const MagneticFieldSample& sample, sensor_msgs::MagneticField& message);
void convert(const GnssFixSample& sample, sensor_msgs::NavSatFix& message);
void convert(const TwistSample& sample, geometry_msgs::TwistStamped& message);
void convert(const ActuatorState& sample, mav_msgs::Actuators& message);
void convert(const JointStateSample& sample, sensor_msgs::JointState& message);
void convert(const ScalarSample& sample, std_msgs::Float32& message);
void convert(const StampedNumber& sample, uuv_gazebo_ros_plugins_msgs::FloatStamped& message);
void convert(const WindSample& sample, rotors_comm::WindSpeed& message);
void convert(const WrenchSample& sample, geometry_msgs::WrenchStamped& message);
void convert(const VectorSample& sample, geometry_msgs::Vector3Stamped& message);

}  // namespace trident::sim
