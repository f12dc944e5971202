// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/se3.h"
#include "trident_base/sim_time.h"
#include "trident_base/span.h"

namespace trident::sim {

// The plain structs that flow through ports. SI units; frames in the names.

/// A bounded list of doubles that never allocates.
struct SmallVector {
  static constexpr std::size_t kCapacity = 32;
  std::array<double, kCapacity> data{};
  std::size_t size = 0;

  Span<const double> view() const { return {data.data(), size}; }
  void assign(Span<const double> values) {
    size = std::min(values.size(), kCapacity);
    std::copy_n(values.begin(), size, data.begin());
  }
};

/// Commanded rotor speeds [rad/s]. `stamp` is that of the odometry it answers; 0: unstamped.
struct ActuatorCommand {
  SimTime stamp;
  SmallVector angular_velocities;
};

/// Wanted velocity of a vehicle in its own frame (ROS' cmd_vel). It acts from the next step on;
/// `stamp` is not looked at.
struct TwistCommand {
  SimTime stamp;
  Eigen::Vector3d v_base = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d w_base = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// Measured rotor speeds [rad/s], signed, joint rate times slow-down.
struct ActuatorState {
  SimTime stamp;
  SmallVector angular_velocities;
};

using Covariance6 = std::array<double, 36>;

/// Pose of `child` in `parent` and the twist of the child expressed in the child's frame.
struct OdometrySample {
  SimTime stamp;
  std::string parent_frame, child_frame;
  SE3 T_parent_child;
  Eigen::Vector3d v_child = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_child = Eigen::Vector3d::Zero();
  Covariance6 pose_covariance{}, twist_covariance{};
};
struct PoseSample {
  SimTime stamp;
  std::string frame;
  SE3 T_frame_body;
};
struct PoseWithCovarianceSample {
  SimTime stamp;
  std::string frame;
  SE3 T_frame_body;
  Covariance6 covariance{};
};
struct PointSample {
  SimTime stamp;
  std::string frame;
  Eigen::Vector3d p_frame = Eigen::Vector3d::Zero();
};
struct TransformSample {
  SimTime stamp;
  std::string parent_frame, child_frame;
  SE3 T_parent_child;
};
/// A transform for the frame tree (/tf) rather than for a topic of its own.
struct FrameSample : TransformSample {};
struct ImuSample {
  SimTime stamp;
  std::string frame;
  Eigen::Quaterniond R_world_imu = Eigen::Quaterniond::Identity();
  Eigen::Vector3d w_imu = Eigen::Vector3d::Zero();  ///< [rad/s]
  Eigen::Vector3d a_imu = Eigen::Vector3d::Zero();  ///< specific force [m/s^2]
  std::array<double, 9> gyro_covariance{}, accel_covariance{}, orientation_covariance{};
};
/// Ranges of one sweep of a planar lidar, about the z axis of its frame.
struct LaserScanSample {
  SimTime stamp;  ///< of the first beam
  std::string frame;
  double angle_min_rad = 0.0, angle_max_rad = 0.0, angle_increment_rad = 0.0;
  double time_increment_s = 0.0;  ///< between beams; 0: all at once
  double scan_time_s = 0.0;       ///< between scans; 0: not known
  double range_min_m = 0.0, range_max_m = 0.0;
  std::vector<float> ranges;  ///< [m]; +inf: nothing in range, -inf: too near (REP 117)
  std::vector<float> intensities;
};
/// A picture, row by row from the top, as sensor_msgs/Image has it.
struct ImageSample {
  SimTime stamp;
  std::string frame;     ///< optical: x right, y down, z ahead
  std::string encoding;  ///< "rgb8", "bgr8", "mono8", "mono16", "16UC1" [mm] or "32FC1" [m]
  std::uint32_t width = 0, height = 0;
  std::uint32_t bytes_per_row = 0;
  std::vector<std::uint8_t> data;  ///< little-endian
};
/// What a camera is like, as sensor_msgs/CameraInfo has it: a pinhole with "plumb_bob" distortion.
struct CameraInfoSample {
  SimTime stamp;
  std::string frame;
  std::uint32_t width = 0, height = 0;
  std::array<double, 5> D{};  ///< k1 k2 t1 t2 k3
  std::array<double, 9> K{};  ///< row by row
  std::array<double, 9> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 12> P{};  ///< row by row
};
/// Points of a picture, pixel by pixel, in the optical frame.
struct ImageCloudSample {
  struct Point {
    float x, y, z;      ///< [m]; not a number: nothing is seen there
    std::uint32_t rgb;  ///< 0x00rrggbb
  };
  SimTime stamp;
  std::string frame;
  std::uint32_t width = 0, height = 0;
  bool is_dense = false;  ///< every point is a number
  std::vector<Point> points;
};
/// What a camera sees of models or links.
struct BoundingBoxesSample {
  struct Box {
    std::uint32_t label = 0;  ///< in the segmentation image; 0 is nothing
    std::string name;         ///< "model" or "model::link"
    std::uint32_t x_min = 0, y_min = 0, x_max = 0, y_max = 0;  ///< [pixels], outermost ones
    std::uint32_t pixels = 0;                                  ///< that show it
  };
  SimTime stamp;
  std::string frame;
  std::vector<Box> boxes;  ///< by label
};
/// One return of a lidar with many rings, as the 22 bytes that ROS carries of it.
struct __attribute__((packed)) LidarPoint {
  float x = 0.0F, y = 0.0F, z = 0.0F;  ///< in the sensor's frame when the beam was cast [m]
  float intensity = 0.0F;
  std::uint16_t ring = 0;  ///< 0: the lowest
  float time = 0.0F;       ///< of the beam, since the stamp [s]
};
static_assert(sizeof(LidarPoint) == 22, "PointCloud2's field table has these offsets");
/// Returns of one scan in the order in which their beams were cast; beams that hit nothing in range
/// are left out.
struct LidarCloudSample {
  SimTime stamp;  ///< of the first beam, whether it came back or not
  std::string frame;
  std::vector<LidarPoint> points;
};
/// Points with an intensity each, one per beam (sensor_msgs/PointCloud).
struct PointListSample {
  SimTime stamp;
  std::string frame;
  std::vector<Eigen::Vector3f> points;  ///< in frame [m]
  std::vector<float> intensities;
};
/// The distance to the nearest thing in a cone about x.
struct RangeSample {
  SimTime stamp;
  std::string frame;
  bool is_infrared = false;  ///< else ultrasound
  double field_of_view_rad = 0.0;
  double range_min_m = 0.0, range_max_m = 0.0;
  double range_m = 0.0;  ///< the largest range: nothing hit
};
/// Where two collisions touch: a point, normal, wrench and depth for each contact, all in frame.
struct TouchSample {
  std::string collision1, collision2;               ///< "model::link::collision"
  std::vector<Eigen::Vector3d> positions, normals;  ///< normals point into collision 1
  std::vector<Eigen::Vector3d> forces, torques;     ///< on collision 1 [N], [N m]
  std::vector<double> depths;                       ///< [m]
};
struct ContactsSample {
  SimTime stamp;
  std::string frame;
  std::vector<TouchSample> touches;
};
struct FluidPressureSample {
  SimTime stamp;
  std::string frame;
  double pressure_pa = 0.0, variance = 0.0;  ///< [Pa], [Pa^2]
};
struct MagneticFieldSample {
  SimTime stamp;
  std::string frame;
  Eigen::Vector3d field_t = Eigen::Vector3d::Zero();  ///< in frame [T]
  std::array<double, 9> covariance{};                 ///< [T^2]
};
/// A position fix of a satellite receiver, WGS84.
struct GnssFixSample {
  SimTime stamp;
  std::string frame;
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;  ///< above the ellipsoid
  std::array<double, 9> covariance_enu{};                            ///< [m^2]
};
/// How good a fix is.
struct GnssStatusSample {
  enum class FixType { kNone = 0, kSingle = 1, kFloat = 2, kFixed = 3 };

  SimTime stamp;
  std::string frame;
  FixType fix_type = FixType::kNone;
  double stddev_horizontal_m = 0.0, stddev_vertical_m = 0.0;  ///< per axis, one sigma
  int satellites = 0;
  double geoid_separation_m = 0.0;  ///< height of the geoid above the ellipsoid; NaN: not known
};
struct TwistSample {
  SimTime stamp;
  std::string frame;
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d w = Eigen::Vector3d::Zero();  ///< [rad/s]
};
struct JointStateSample {
  SimTime stamp;
  std::string frame;
  std::vector<std::string> names;
  std::vector<double> positions;   ///< [rad] or [m]
  std::vector<double> velocities;  ///< [rad/s] or [m/s]; empty: not known
};
struct ScalarSample {
  SimTime stamp;
  double value = 0.0;
};
struct WindSample {
  SimTime stamp;
  std::string frame;
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();  ///< [m/s]
};
struct WrenchSample {
  SimTime stamp;
  std::string frame;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
};

}  // namespace trident::sim
