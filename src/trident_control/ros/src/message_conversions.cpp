// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/message_conversions.h"

#include <cstdio>
#include <cstring>

namespace trident::control {
namespace {

/// A row-major 6 x 6 matrix of float64, which no controller reads.
constexpr std::size_t kCovarianceBytes = 36 * sizeof(double);

/// Walks over little-endian bytes; once they run out, everything read is zero and ok() is false.
class ByteReader {
 public:
  explicit ByteReader(Span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }

  template <typename T>
  T read() {
    T value{};
    if (take(sizeof(T))) std::memcpy(&value, bytes_.data() + position_ - sizeof(T), sizeof(T));
    return value;
  }
  void skip(std::size_t count) { take(count); }
  // ROS serializes a string as its length in 32 bits and its bytes.
  void skip_string() { skip(read<std::uint32_t>()); }
  Eigen::Vector3d read_vector() {
    const double x = read<double>();
    const double y = read<double>();
    return {x, y, read<double>()};
  }

 private:
  bool take(std::size_t count) {
    ok_ = ok_ && count <= bytes_.size() - position_;
    if (ok_) position_ += count;
    return ok_;
  }

  Span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

Eigen::Vector3d to_vector(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

double yaw_of(const geometry_msgs::Quaternion& q) {
  return yaw_from_quaternion(Eigen::Quaterniond(q.w, q.x, q.y, q.z));
}

}  // namespace

std::string refusal_text(const std::string& what, const ros::Time& stamp, const std::string& why) {
  char seconds[32];  // NOLINT: of snprintf
  std::snprintf(seconds, sizeof(seconds), "%.9f", stamp.toSec());
  return what + " stamped " + seconds + " s refused: " + why;
}

SimTime to_sim_time(const ros::Time& time) {
  return {static_cast<std::int64_t>(time.sec) * 1'000'000'000 + time.nsec};
}

SimTime to_sim_time(const ros::Duration& duration) { return {duration.toNSec()}; }

/// The fields of nav_msgs/Odometry as they are serialized, without the message object: its strings
/// would be allocated for each state.
std::optional<StampedOdometry> parse_odometry(Span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  StampedOdometry odometry;
  reader.skip(sizeof(std::uint32_t));  // seq
  odometry.stamp.sec = reader.read<std::uint32_t>();
  odometry.stamp.nsec = reader.read<std::uint32_t>();
  reader.skip_string();  // frame_id
  reader.skip_string();  // child_frame_id
  // The pose is in header.frame_id, the twist in
  // child_frame_id; quaternions are in order x, y, z, w.
  OdometryState& state = odometry.state;
  state.p_world_body = reader.read_vector();
  state.R_world_body.vec() = reader.read_vector();
  state.R_world_body.w() = reader.read<double>();
  reader.skip(kCovarianceBytes);
  state.v_body = reader.read_vector();
  state.w_body = reader.read_vector();
  reader.skip(kCovarianceBytes);
  if (!reader.ok()) return std::nullopt;
  return odometry;
}

StampedOdometry to_stamped_odometry(const nav_msgs::Odometry& message) {
  const geometry_msgs::Pose& pose = message.pose.pose;
  StampedOdometry odometry;
  odometry.stamp = message.header.stamp;
  OdometryState& state = odometry.state;
  state.p_world_body = {pose.position.x, pose.position.y, pose.position.z};
  state.R_world_body.coeffs() << pose.orientation.x, pose.orientation.y, pose.orientation.z,
      pose.orientation.w;
  state.v_body = to_vector(message.twist.twist.linear);
  state.w_body = to_vector(message.twist.twist.angular);
  return odometry;
}

TrajectoryPoint to_trajectory_point(const geometry_msgs::Pose& pose) {
  TrajectoryPoint point;
  point.p_world = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  point.yaw = yaw_of(pose.orientation);
  return point;
}

TrajectoryPoint to_trajectory_point(const mav_msgs::AttitudeThrust& message) {
  TrajectoryPoint point;
  point.level = ControlLevel::attitude;
  const auto& q = message.attitude;
  point.R_world_body = Eigen::Quaternion<double, Eigen::DontAlign>(q.w, q.x, q.y, q.z);
  point.thrust = message.thrust.z;
  return point;
}

TrajectoryPoint to_trajectory_point(const mav_msgs::RateThrust& message) {
  TrajectoryPoint point;
  point.level = ControlLevel::rates;
  point.w_body = to_vector(message.angular_rates);
  point.thrust = message.thrust.z;
  return point;
}

/// A multirotor is one body, so that the first transform is all of it; velocities and accelerations
/// are optional in this message, and zero where they are absent.
std::optional<TrajectoryPoint> to_trajectory_point(
    const trajectory_msgs::MultiDOFJointTrajectoryPoint& message) {
  if (message.transforms.empty()) return std::nullopt;
  TrajectoryPoint point;
  point.p_world = to_vector(message.transforms.front().translation);
  point.yaw = yaw_of(message.transforms.front().rotation);
  if (!message.velocities.empty()) {
    point.v_world = to_vector(message.velocities.front().linear);
    point.yaw_rate = message.velocities.front().angular.z;
  }
  if (!message.accelerations.empty()) {
    point.a_world = to_vector(message.accelerations.front().linear);
  }
  return point;
}

std::optional<std::size_t> to_setpoints(const trajectory_msgs::MultiDOFJointTrajectory& message,
                                        std::vector<TimedSetpoint>& out) {
  out.clear();
  for (std::size_t i = 0; i < message.points.size(); ++i) {
    const auto point = to_trajectory_point(message.points[i]);
    if (!point) return i;
    out.push_back({to_sim_time(message.points[i].time_from_start), *point});
  }
  return std::nullopt;
}

AttitudeCommand to_attitude_command(const mav_msgs::RollPitchYawrateThrust& message) {
  return {message.roll, message.pitch, message.yaw_rate, message.thrust.z};
}

}  // namespace trident::control
