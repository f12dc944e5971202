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
  /// As many rotors or joints as one message can have.
  static constexpr std::size_t kCapacity = 32;
  std::array<double, kCapacity> data{};  ///< valid are the first `size`
  std::size_t size = 0;                  ///< at most kCapacity

  /// The valid values; the view ends with the SmallVector.
  Span<const double> view() const { return {data.data(), size}; }
  /// Takes the first kCapacity values; what is beyond them is cut off without a report.
  void assign(Span<const double> values) {
    size = std::min(values.size(), kCapacity);
    std::copy_n(values.begin(), size, data.begin());
  }
};

/// Commanded rotor speeds [rad/s]. `stamp` is that of the odometry it answers; 0: unstamped.
struct ActuatorCommand {
  SimTime stamp;                   ///< of the odometry that it answers; 0: unstamped
  SmallVector angular_velocities;  ///< by motor number
};

/// Wanted velocity of a vehicle in its own frame (ROS' cmd_vel). It acts from the next step on;
/// `stamp` is not looked at.
struct TwistCommand {
  SimTime stamp;                                     ///< not looked at
  Eigen::Vector3d v_base = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d w_base = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// Measured rotor speeds [rad/s], signed, joint rate times slow-down.
struct ActuatorState {
  SimTime stamp;                   ///< when it was measured
  SmallVector angular_velocities;  ///< by motor number
};

/// Row by row, position before rotation about fixed axes, as in geometry_msgs.
using Covariance6 = std::array<double, 36>;

/// Pose of `child` in `parent` and the twist of the child expressed in the child's frame.
struct OdometrySample {
  SimTime stamp;                          ///< of the state that was measured
  std::string parent_frame, child_frame;  ///< names for the frame tree, tf_prefix included
  SE3 T_parent_child;                     ///< p_parent = T_parent_child * p_child
  Eigen::Vector3d v_child = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d w_child = Eigen::Vector3d::Zero();  ///< [rad/s]
  Covariance6 pose_covariance{}, twist_covariance{};  ///< [m^2, rad^2] and their rates; zero: exact
};
/// Pose of a body in frame (geometry_msgs/PoseStamped).
struct PoseSample {
  SimTime stamp;      ///< of the state that was measured
  std::string frame;  ///< that the pose is given in
  SE3 T_frame_body;   ///< measured, noise included
};
/// The same with its uncertainty (geometry_msgs/PoseWithCovarianceStamped).
struct PoseWithCovarianceSample {
  SimTime stamp;             ///< of the state that was measured
  std::string frame;         ///< that the pose is given in
  SE3 T_frame_body;          ///< with the sensor's noise
  Covariance6 covariance{};  ///< of that noise [m^2, rad^2]
};
/// Position of a body in frame, without its rotation (geometry_msgs/PointStamped).
struct PointSample {
  SimTime stamp;                                      ///< of the state that was measured
  std::string frame;                                  ///< that the point is given in
  Eigen::Vector3d p_frame = Eigen::Vector3d::Zero();  ///< [m]
};
/// A pose as a transform between two named frames (geometry_msgs/TransformStamped).
struct TransformSample {
  SimTime stamp;                          ///< of the state that was measured
  std::string parent_frame, child_frame;  ///< tf_prefix included
  SE3 T_parent_child;                     ///< p_parent = T_parent_child * p_child
};
/// A transform for the frame tree (/tf) rather than for a topic of its own.
struct FrameSample : TransformSample {};
/// What an IMU measures, in its own frame (sensor_msgs/Imu).
struct ImuSample {
  SimTime stamp;      ///< of the state that was measured
  std::string frame;  ///< of the IMU
  /// With the noise of its heading sensor, if it has one.
  Eigen::Quaterniond R_world_imu = Eigen::Quaterniond::Identity();
  Eigen::Vector3d w_imu = Eigen::Vector3d::Zero();  ///< [rad/s]
  Eigen::Vector3d a_imu = Eigen::Vector3d::Zero();  ///< specific force [m/s^2]
  /// Row by row; first entry -1: not measured.
  std::array<double, 9> gyro_covariance{}, accel_covariance{}, orientation_covariance{};
};
/// Ranges of one sweep of a planar lidar, about the z axis of its frame.
struct LaserScanSample {
  SimTime stamp;      ///< of the first beam
  std::string frame;  ///< of the laser: beams lie in its x-y plane, 0 rad along x
  /// Beam i: min + i * increment.
  double angle_min_rad = 0.0, angle_max_rad = 0.0, angle_increment_rad = 0.0;
  double time_increment_s = 0.0;                ///< between beams; 0: all at once
  double scan_time_s = 0.0;                     ///< between scans; 0: not known
  double range_min_m = 0.0, range_max_m = 0.0;  ///< outside of these no return is reported
  std::vector<float> ranges;       ///< [m]; +inf: nothing in range, -inf: too near (REP 117)
  std::vector<float> intensities;  ///< of `ranges`, as RayScene::intensity() has them; empty: none
};
/// A picture, row by row from the top, as sensor_msgs/Image has it.
struct ImageSample {
  SimTime stamp;         ///< when the shutter was open
  std::string frame;     ///< optical: x right, y down, z ahead
  std::string encoding;  ///< "rgb8", "bgr8", "mono8", "mono16", "16UC1" [mm] or "32FC1" [m]
  std::uint32_t width = 0, height = 0;  ///< [pixels]
  std::uint32_t bytes_per_row = 0;      ///< rows follow each other without gaps
  std::vector<std::uint8_t> data;       ///< little-endian
};
/// What a camera is like, as sensor_msgs/CameraInfo has it: a pinhole with "plumb_bob" distortion.
struct CameraInfoSample {
  SimTime stamp;                        ///< that of the picture that it belongs to
  std::string frame;                    ///< optical frame of that picture
  std::uint32_t width = 0, height = 0;  ///< [pixels]
  std::array<double, 5> D{};            ///< k1 k2 t1 t2 k3
  std::array<double, 9> K{};            ///< row by row
  /// Rectification; the identity but for a stereo pair.
  std::array<double, 9> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 12> P{};  ///< row by row
};
/// Points of a picture, pixel by pixel, in the optical frame.
struct ImageCloudSample {
  /// One pixel of the cloud; as float32 fields x, y, z and rgb of a PointCloud2.
  struct Point {
    float x, y, z;      ///< [m]; not a number: nothing is seen there
    std::uint32_t rgb;  ///< 0x00rrggbb
  };
  SimTime stamp;                        ///< that of the picture
  std::string frame;                    ///< optical: x right, y down, z ahead
  std::uint32_t width = 0, height = 0;  ///< [pixels]
  bool is_dense = false;                ///< every point is a number
  std::vector<Point> points;            ///< row by row from the top, width * height
};
/// What a camera sees of models or links.
struct BoundingBoxesSample {
  /// The smallest axis-parallel rectangle about the visible pixels of one object.
  struct Box {
    std::uint32_t label = 0;  ///< in the segmentation image; 0 is nothing
    std::string name;         ///< "model" or "model::link"
    std::uint32_t x_min = 0, y_min = 0, x_max = 0, y_max = 0;  ///< [pixels], outermost ones
    std::uint32_t pixels = 0;                                  ///< that show it
  };
  SimTime stamp;           ///< that of the picture
  std::string frame;       ///< optical frame of the camera
  std::vector<Box> boxes;  ///< by label
};
/// One return of a lidar with many rings, as the 22 bytes that ROS carries of it.
struct __attribute__((packed)) LidarPoint {
  float x = 0.0F, y = 0.0F, z = 0.0F;  ///< in the sensor's frame when the beam was cast [m]
  float intensity = 0.0F;              ///< see RayScene::intensity()
  std::uint16_t ring = 0;              ///< 0: the lowest
  float time = 0.0F;                   ///< of the beam, since the stamp [s]
};
static_assert(sizeof(LidarPoint) == 22, "PointCloud2's field table has these offsets");
/// Returns of one scan in the order in which their beams were cast; beams that hit nothing in range
/// are left out.
struct LidarCloudSample {
  SimTime stamp;                   ///< of the first beam, whether it came back or not
  std::string frame;               ///< of the sensor at the time of each beam
  std::vector<LidarPoint> points;  ///< only those that came back
};
/// Points with an intensity each, one per beam (sensor_msgs/PointCloud).
struct PointListSample {
  SimTime stamp;                        ///< of the scan
  std::string frame;                    ///< that the points are given in
  std::vector<Eigen::Vector3f> points;  ///< in frame [m]
  std::vector<float> intensities;       ///< one for each point
};
/// The distance to the nearest thing in a cone about x.
struct RangeSample {
  SimTime stamp;                                ///< of the state that was measured
  std::string frame;                            ///< whose x axis is the axis of the cone
  bool is_infrared = false;                     ///< else ultrasound
  double field_of_view_rad = 0.0;               ///< full opening angle of the cone
  double range_min_m = 0.0, range_max_m = 0.0;  ///< legal values of range_m
  double range_m = 0.0;                         ///< the largest range: nothing hit
};
/// Where two collisions touch: a point, normal, wrench and depth for each contact, all in frame.
struct TouchSample {
  std::string collision1, collision2;               ///< "model::link::collision"
  std::vector<Eigen::Vector3d> positions, normals;  ///< normals point into collision 1
  std::vector<Eigen::Vector3d> forces, torques;     ///< on collision 1 [N], [N m]
  std::vector<double> depths;                       ///< [m]
};
/// All contacts of the collisions that a bumper watches, of one step (gazebo_msgs/ContactsState).
struct ContactsSample {
  SimTime stamp;                     ///< of the end of that step
  std::string frame;                 ///< in which positions, normals and wrenches are given
  std::vector<TouchSample> touches;  ///< one per pair of collisions; empty: nothing touched
};
/// Static pressure of air or water at the sensor (sensor_msgs/FluidPressure).
struct FluidPressureSample {
  SimTime stamp;                             ///< of the state that was measured
  std::string frame;                         ///< of the sensor
  double pressure_pa = 0.0, variance = 0.0;  ///< [Pa], [Pa^2]
};
/// The Earth's magnetic field as a magnetometer measures it (sensor_msgs/MagneticField).
struct MagneticFieldSample {
  SimTime stamp;                                      ///< of the state that was measured
  std::string frame;                                  ///< of the magnetometer
  Eigen::Vector3d field_t = Eigen::Vector3d::Zero();  ///< in frame [T]
  std::array<double, 9> covariance{};                 ///< [T^2]
};
/// A position fix of a satellite receiver, WGS84.
struct GnssFixSample {
  SimTime stamp;      ///< of the state that was measured
  std::string frame;  ///< of the antenna
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;  ///< above the ellipsoid
  std::array<double, 9> covariance_enu{};                            ///< [m^2]
};
/// How good a fix is.
struct GnssStatusSample {
  /// No position, code measurements alone, and carrier phases with ambiguities that are estimated
  /// as real numbers (float) or resolved to whole ones (fixed).
  enum class FixType { kNone = 0, kSingle = 1, kFloat = 2, kFixed = 3 };

  SimTime stamp;                      ///< that of the fix
  std::string frame;                  ///< of the antenna
  FixType fix_type = FixType::kNone;  ///< follows how long satellites have been in view
  double stddev_horizontal_m = 0.0, stddev_vertical_m = 0.0;  ///< per axis, one sigma
  int satellites = 0;                                         ///< in view of the antenna
  double geoid_separation_m = 0.0;  ///< height of the geoid above the ellipsoid; NaN: not known
};
/// Linear and angular velocity in frame (geometry_msgs/TwistStamped).
struct TwistSample {
  SimTime stamp;                                ///< of the state that was measured
  std::string frame;                            ///< whose axes both vectors are expressed in
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d w = Eigen::Vector3d::Zero();  ///< [rad/s]
};
/// Positions and rates of joints, all of one moment (sensor_msgs/JointState).
struct JointStateSample {
  SimTime stamp;                   ///< of the state that was measured
  std::string frame;               ///< of the header; "": joints have none of their own
  std::vector<std::string> names;  ///< as in the model; parallel to positions
  std::vector<double> positions;   ///< [rad] or [m]
  std::vector<double> velocities;  ///< [rad/s] or [m/s]; empty: not known
};
/// One number whose meaning and unit the port's plugin documents (std_msgs/Float32); in or out.
struct ScalarSample {
  SimTime stamp;       ///< of a measurement; a command's is not looked at
  double value = 0.0;  ///< narrowed to single precision on a topic
};
/// Wind at a body, as RotorS' wind plugin publishes it.
struct WindSample {
  SimTime stamp;      ///< of the step that it acts in
  std::string frame;  ///< name of the frame that v_world is expressed in
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();  ///< [m/s]
};
/// A force and a torque on a body (geometry_msgs/WrenchStamped).
struct WrenchSample {
  SimTime stamp;      ///< of the step that it acted in
  std::string frame;  ///< whose axes both vectors are expressed in
  /// [N], [N m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
};

}  // namespace trident::sim
