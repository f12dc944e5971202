// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "conversions.h"

#include <algorithm>

#include "trident_base/shown_text.h"
#include "trident_sim_ros/output_topic.h"

namespace trident::sim {

std::string one_line(std::string text) {
  text = with_short_words(text);
  constexpr std::size_t kLongest = 400;
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  if (text.size() <= kLongest) return text;
  std::size_t cut = kLongest;
  while (cut > 0 && (text[cut] & 0xC0) == 0x80) --cut;  // not within a UTF-8 character
  return text.substr(0, cut) + " ...";
}

geometry_msgs::Point to_point(const Eigen::Vector3d& p) {
  geometry_msgs::Point result;
  result.x = p.x(), result.y = p.y(), result.z = p.z();
  return result;
}

geometry_msgs::Vector3 to_vector(const Eigen::Vector3d& v) {
  geometry_msgs::Vector3 result;
  result.x = v.x(), result.y = v.y(), result.z = v.z();
  return result;
}

geometry_msgs::Quaternion to_quaternion(const Eigen::Quaterniond& q) {
  geometry_msgs::Quaternion result;
  result.x = q.x(), result.y = q.y(), result.z = q.z(), result.w = q.w();
  return result;
}

geometry_msgs::Pose to_pose(const SE3& T) {
  geometry_msgs::Pose result;
  result.position = to_point(T.p);
  result.orientation = to_quaternion(T.R);
  return result;
}

Eigen::Vector3d from_point(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }
Eigen::Vector3d from_vector(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

SE3 from_pose(const geometry_msgs::Pose& pose) {
  Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                       pose.orientation.z);
  // A pose whose orientation was not filled in has zeros only, and means no rotation.
  if (q.coeffs().isZero(0.0)) q.setIdentity();
  return {q.coeffs().allFinite() ? q.normalized() : q, from_point(pose.position)};
}

TwistCommand from_twist(const geometry_msgs::Twist& twist) {
  return {SimTime{}, from_vector(twist.linear), from_vector(twist.angular)};
}

void convert(const OdometrySample& sample, nav_msgs::Odometry& message) {
  // The pose is that of child_frame in parent_frame, the twist is in child_frame.
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.parent_frame;
  message.child_frame_id = sample.child_frame;
  message.pose.pose = to_pose(sample.T_parent_child);
  message.twist.twist.linear = to_vector(sample.v_child);
  message.twist.twist.angular = to_vector(sample.w_child);
  std::copy(sample.pose_covariance.begin(), sample.pose_covariance.end(),
            message.pose.covariance.begin());
  std::copy(sample.twist_covariance.begin(), sample.twist_covariance.end(),
            message.twist.covariance.begin());
}

void convert(const PoseSample& sample, geometry_msgs::Pose& message) {
  message = to_pose(sample.T_frame_body);
}

void convert(const PoseWithCovarianceSample& sample,
             geometry_msgs::PoseWithCovarianceStamped& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.pose.pose = to_pose(sample.T_frame_body);
  std::copy(sample.covariance.begin(), sample.covariance.end(), message.pose.covariance.begin());
}

void convert(const PointSample& sample, geometry_msgs::PointStamped& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.point = to_point(sample.p_frame);
}

void convert(const TransformSample& sample, geometry_msgs::TransformStamped& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.parent_frame;
  message.child_frame_id = sample.child_frame;
  message.transform.translation = to_vector(sample.T_parent_child.p);
  message.transform.rotation = to_quaternion(sample.T_parent_child.R);
}

void convert(const ImuSample& sample, sensor_msgs::Imu& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.orientation = to_quaternion(sample.R_world_imu);
  message.angular_velocity = to_vector(sample.w_imu);
  // REP 145: the specific force, gravity included.
  message.linear_acceleration = to_vector(sample.a_imu);
  for (std::size_t i = 0; i < 9; ++i) {
    message.orientation_covariance[i] = sample.orientation_covariance[i];
    message.angular_velocity_covariance[i] = sample.gyro_covariance[i];
    message.linear_acceleration_covariance[i] = sample.accel_covariance[i];
  }
}

void convert(const LaserScanSample& sample, sensor_msgs::LaserScan& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.angle_min = static_cast<float>(sample.angle_min_rad);
  message.angle_max = static_cast<float>(sample.angle_max_rad);
  message.angle_increment = static_cast<float>(sample.angle_increment_rad);
  message.time_increment = static_cast<float>(sample.time_increment_s);
  message.scan_time = static_cast<float>(sample.scan_time_s);
  message.range_min = static_cast<float>(sample.range_min_m);
  message.range_max = static_cast<float>(sample.range_max_m);
  message.ranges = sample.ranges;
  message.intensities = sample.intensities;
}

void convert(const FluidPressureSample& sample, sensor_msgs::FluidPressure& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.fluid_pressure = sample.pressure_pa;
  message.variance = sample.variance;
}

void convert(const MagneticFieldSample& sample, sensor_msgs::MagneticField& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.magnetic_field = to_vector(sample.field_t);
  std::copy(sample.covariance.begin(), sample.covariance.end(),
            message.magnetic_field_covariance.begin());
}

void convert(const GnssFixSample& sample, sensor_msgs::NavSatFix& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.status.status = sensor_msgs::NavSatStatus::STATUS_FIX;
  message.status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
  message.latitude = sample.latitude_deg;
  message.longitude = sample.longitude_deg;
  // Above the ellipsoid of WGS 84, not above the sea; the covariance is in east, north, up [m^2].
  message.altitude = sample.altitude_m;
  std::copy(sample.covariance_enu.begin(), sample.covariance_enu.end(),
            message.position_covariance.begin());
  message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_KNOWN;
}

void convert(const TwistSample& sample, geometry_msgs::TwistStamped& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.twist.linear = to_vector(sample.v);
  message.twist.angular = to_vector(sample.w);
}

void convert(const ActuatorState& sample, mav_msgs::Actuators& message) {
  message.header.stamp = to_ros(sample.stamp);
  const SmallVector& speeds = sample.angular_velocities;
  message.angular_velocities.assign(speeds.data.begin(),
                                    speeds.data.begin() + static_cast<std::ptrdiff_t>(speeds.size));
}

void convert(const JointStateSample& sample, sensor_msgs::JointState& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.name = sample.names;
  message.position = sample.positions;
  message.velocity = sample.velocities;
}

void convert(const ScalarSample& sample, std_msgs::Float32& message) {
  message.data = static_cast<float>(sample.value);
}

void convert(const StampedNumber& sample, uuv_gazebo_ros_plugins_msgs::FloatStamped& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.data = sample.value;
}

void convert(const WindSample& sample, rotors_comm::WindSpeed& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.velocity = to_vector(sample.v_world);
}

void convert(const WrenchSample& sample, geometry_msgs::WrenchStamped& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.wrench.force = to_vector(sample.force);
  message.wrench.torque = to_vector(sample.torque);
}

void convert(const VectorSample& sample, geometry_msgs::Vector3Stamped& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.vector = to_vector(sample.value);
}

namespace {

const OutputTopicRegistrar<OdometrySample, nav_msgs::Odometry> kOdometryTopic;
const OutputTopicRegistrar<PoseSample, geometry_msgs::Pose> kPoseTopic;
const OutputTopicRegistrar<PoseWithCovarianceSample, geometry_msgs::PoseWithCovarianceStamped>
    kPoseWithCovarianceTopic;
const OutputTopicRegistrar<PointSample, geometry_msgs::PointStamped> kPointTopic;
const OutputTopicRegistrar<TransformSample, geometry_msgs::TransformStamped> kTransformTopic;
const OutputTopicRegistrar<ImuSample, sensor_msgs::Imu> kImuTopic;
const OutputTopicRegistrar<LaserScanSample, sensor_msgs::LaserScan> kLaserScanTopic;
const OutputTopicRegistrar<FluidPressureSample, sensor_msgs::FluidPressure> kFluidPressureTopic;
const OutputTopicRegistrar<MagneticFieldSample, sensor_msgs::MagneticField> kMagneticFieldTopic;
const OutputTopicRegistrar<GnssFixSample, sensor_msgs::NavSatFix> kGnssFixTopic;
const OutputTopicRegistrar<TwistSample, geometry_msgs::TwistStamped> kTwistTopic;
const OutputTopicRegistrar<ActuatorState, mav_msgs::Actuators> kActuatorStateTopic;
const OutputTopicRegistrar<JointStateSample, sensor_msgs::JointState> kJointStateTopic(
    display_topic());
const OutputTopicRegistrar<ScalarSample, std_msgs::Float32> kScalarTopic;
const OutputTopicRegistrar<StampedNumber, uuv_gazebo_ros_plugins_msgs::FloatStamped>
    kStampedNumberTopic;
const OutputTopicRegistrar<WindSample, rotors_comm::WindSpeed> kWindTopic;
const OutputTopicRegistrar<WrenchSample, geometry_msgs::WrenchStamped> kWrenchTopic;
const OutputTopicRegistrar<VectorSample, geometry_msgs::Vector3Stamped> kVectorTopic;

}  // namespace
}  // namespace trident::sim
