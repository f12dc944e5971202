// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Parameters of plugins of mavros_extras, under upstream's names.
#pragma once

#include <optional>
#include <string>

#include "core/tf_params.h"
#include "trident_ros/node_params.h"

namespace trident::mavros {

/// Where the map's origin is on the earth.
struct GeoOriginParams {
  double lat = 47.3667;  ///< WGS84 [deg]
  double lon = 8.55;     ///< WGS84 [deg]
  double alt = 408.0;    ///< above the ellipsoid [m]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("lat", lat, Range{-90, 90}, "latitude [deg]");
    ar.field("lon", lon, Range{-180, 180}, "longitude [deg]");
    ar.field("alt", alt, Range{-1e4, 1e5}, "height above the ellipsoid of WGS84 [m]");
  }
};

/// Of the plugin fake_gps.
struct FakeGpsParams {
  bool use_mocap = true;              ///< poses come from fake_gps/mocap/...
  bool mocap_transform = true;        ///< from fake_gps/mocap/tf
  bool mocap_withcovariance = false;  ///< else from fake_gps/mocap/pose_cov, else mocap/pose
  bool use_vision = false;            ///< else from fake_gps/vision
  bool use_hil_gps = true;            ///< HIL_GPS is sent, else GPS_INPUT
  double gps_rate = 5.0;              ///< at most [Hz]
  int gps_id = 0;                     ///< of GPS_INPUT
  int fix_type = 0;                   ///< GPS_FIX_TYPE
  double eph = 2.0;                   ///< dilution of precision, horizontal
  double epv = 2.0;                   ///< dilution of precision, vertical
  double horiz_accuracy = 0.0;        ///< of GPS_INPUT [m]
  double vert_accuracy = 0.0;         ///< of GPS_INPUT [m]
  double speed_accuracy = 0.0;        ///< of GPS_INPUT [m/s]; 0: not known
  int satellites_visible = 5;         ///< that are said to be seen
  GeoOriginParams geo_origin;         ///< where the map's origin is
  TfParams tf = TfParams::followed("fix", 10.0);  ///< the transform that may be followed

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("use_mocap", use_mocap, "poses come from fake_gps/mocap/...");
    ar.field("mocap_transform", mocap_transform, "from mocap/tf");
    ar.field("mocap_withcovariance", mocap_withcovariance, "else mocap/pose_cov, else mocap/pose");
    ar.field("use_vision", use_vision, "without use_mocap: poses come from fake_gps/vision");
    ar.field("use_hil_gps", use_hil_gps, "HIL_GPS is sent, else GPS_INPUT");
    ar.field("gps_rate", gps_rate, Range::positive(), "at most so many fixes are sent [Hz]");
    ar.field("gps_id", gps_id, Range{0, 255}, "of GPS_INPUT");
    ar.field("fix_type", fix_type, Range{0, 8}, "GPS_FIX_TYPE; 0: no receiver, 3: 3D fix");
    ar.field("eph", eph, Range{0, 655}, "horizontal dilution of precision; 0: not known");
    ar.field("epv", epv, Range{0, 655}, "vertical dilution of precision; 0: not known");
    ar.field("horiz_accuracy", horiz_accuracy, Range{0, 1e6}, "of GPS_INPUT [m]");
    ar.field("vert_accuracy", vert_accuracy, Range{0, 1e6}, "of GPS_INPUT [m]");
    ar.field("speed_accuracy", speed_accuracy, Range{0, 1e6}, "of GPS_INPUT; 0: not known [m/s]");
    ar.field("satellites_visible", satellites_visible, Range{0, 255}, "said to be seen");
    ar.field("geo_origin", geo_origin, "where the map's origin is");
    ar.field("tf", tf, "without use_mocap and use_vision: the transform that is followed");
  }
};

/// Of one wheel.
struct WheelParams {
  double x = 0.0;        ///< forward of the vehicle's origin [m]
  double y = 0.0;        ///< to the right of it [m]
  double radius = 0.05;  ///< [m]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("x", x, Range{-100, 100}, "forward of the vehicle's origin [m]");
    ar.field("y", y, Range{-100, 100}, "to the right of it [m]");
    ar.field("radius", radius, Range{1e-5, 100}, "[m]");
  }
};

/// Of the plugin wheel_odometry.
struct WheelOdometryParams {
  int count = 2;                             ///< wheels that the odometry is computed from
  bool use_rpm = false;                      ///< from RPM, else from WHEEL_DISTANCE
  std::optional<WheelParams> wheel0;         ///< the first; without it there is no odometry
  std::optional<WheelParams> wheel1;         ///< the second
  bool send_raw = false;                     ///< wheel_odometry/rpm and distance are published
  bool send_twist = false;                   ///< velocity is published, else odom
  double vel_error = 0.1;                    ///< of a wheel, one standard deviation [m/s]
  std::string frame_id = "odom";             ///< of the odometry
  std::string child_frame_id = "base_link";  ///< of its twist
  TfParams tf = TfParams::followed("base_link", 50.0);  ///< the transform that may be sent

  WheelOdometryParams() { tf.frame_id = "odom"; }

  /// Throws Error naming the wheel that is missing, or those that are too near to one another.
  void validate() const;

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("count", count, Range{1, 16}, "wheels of the odometry; of more than two two count");
    ar.field("use_rpm", use_rpm, "the odometry is computed from RPM, else from WHEEL_DISTANCE");
    ar.field("wheel0", wheel0, "the first wheel; without it there is no odometry");
    ar.field("wheel1", wheel1, "the second wheel");
    ar.field("send_raw", send_raw, "wheel_odometry/rpm and wheel_odometry/distance are published");
    ar.field("send_twist", send_twist, "wheel_odometry/velocity is published, else odom");
    ar.field("vel_error", vel_error, Range{0, 100}, "of a wheel, one standard deviation [m/s]");
    ar.field("frame_id", frame_id, "of the odometry");
    ar.field("child_frame_id", child_frame_id, "of its twist");
    ar.field("tf", tf, "the transform that may be sent");
  }
};

/// Of the plugin vision_pose_estimate.
struct VisionPoseParams {
  TfParams tf =
      TfParams::followed("vision_estimate", 10.0);  ///< the transform that may be followed

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("tf", tf, "the transform that may be followed");
  }
};

}  // namespace trident::mavros
