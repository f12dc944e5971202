// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "trident_base/config_types.h"
#include "trident_bridges/nmea/receive/events.h"

namespace trident::bridges {

/// Where on earth a map's origin lies. The defaults stand for "not given".
struct OriginParams {
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double elevation_m = 0.0;  ///< above the ellipsoid
  double heading_rad = 0.0;  ///< of the map's x, counter-clockwise from east
  bool is_given = false;     ///< else it follows from a fix and the odometry of that moment

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("given", is_given, "whether it is; else it follows from a fix and odometry");
    ar.field("latitude", latitude_deg, Range{-90.0, 90.0}, "[deg]");
    ar.field("longitude", longitude_deg, Range{-180.0, 180.0}, "[deg]");
    ar.field("elevation", elevation_m, Range{-1e4, 1e5}, "above the ellipsoid [m]");
    ar.field("heading", heading_rad, Range{-7.0, 7.0}, "of x, counter-clockwise from east [rad]");
  }
};

/// The odometry's frame on the earth (WGS 84, a plane through the origin).
class LocalFrame {
 public:
  /// Without an origin that is given, set_place() has to come first.
  explicit LocalFrame(const OriginParams& params);
  ~LocalFrame();
  LocalFrame(const LocalFrame&) = delete;
  LocalFrame& operator=(const LocalFrame&) = delete;

  bool is_known() const { return is_known_; }  ///< the functions below need it
  /// A fix and where the odometry has it: sets the origin, unless it is known.
  void set_place(const nmea::RoutePlace& place, double altitude_m, const Eigen::Vector2d& p_frame);
  /// A place in the frame [m].
  Eigen::Vector2d to_frame(const nmea::RoutePlace& place) const;
  /// The place of a point of the frame.
  nmea::RoutePlace to_earth(const Eigen::Vector2d& p_frame) const;
  double heading_rad() const { return heading_rad_; }  ///< of x, counter-clockwise from east
  /// From the frame's axes to east and north.
  Eigen::Rotation2Dd R_enu_frame() const { return Eigen::Rotation2Dd(heading_rad_); }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool is_known_ = false;
  double heading_rad_;
  Eigen::Vector2d p_frame_origin_ = Eigen::Vector2d::Zero();  ///< of the place that was set
};

}  // namespace trident::bridges
