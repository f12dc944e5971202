// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <GeographicLib/LocalCartesian.hpp>
#include <cstdint>
#include <optional>

namespace trident::bridges::mavlink {

/// A place on the earth.
struct GeoPlace {
  double latitude_deg = 0.0;   ///< WGS84, positive north
  double longitude_deg = 0.0;  ///< WGS84, positive east
  double altitude_m = 0.0;     ///< above mean sea level
};

/// The world frame (east, north, up) on the earth. The geoid's height is taken as that of the
/// origin, everywhere.
class GeoFrame {
 public:
  /// `origin`: where the world frame's origin is.
  explicit GeoFrame(const GeoPlace& origin);
  /// A place in the world [m].
  Eigen::Vector3d to_world(const GeoPlace& place) const;
  /// The inverse of to_world().
  GeoPlace to_geo(const Eigen::Vector3d& p_world_m) const;
  /// Where the world frame's origin is.
  const GeoPlace& origin() const { return origin_; }

 private:
  GeoPlace origin_;
  GeographicLib::LocalCartesian earth_;
};

/// What a place in a message is relative to.
struct PlaceContext {
  const GeoFrame& geo;                               ///< the world on the earth
  Eigen::Vector3d home_m = Eigen::Vector3d::Zero();  ///< world
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();     ///< of the vehicle, world
  double yaw = 0.0;                                  ///< of the vehicle, from east [rad]
};

/// A place in the world. `frame`: MAV_FRAME; global ones: latitude, longitude [deg] and altitude by
/// the frame (heights above terrain count from home, because no terrain is known here); local ones:
/// north, east, down [m], or forward, right, down from the vehicle. nullopt: the frame has no
/// places.
std::optional<Eigen::Vector3d> place_in_world(std::uint8_t frame, const Eigen::Vector3d& numbers,
                                              const PlaceContext& context);
/// A direction such as a velocity: north, east, down, or in frames of a body forward, right, down.
Eigen::Vector3d direction_in_world(std::uint8_t frame, const Eigen::Vector3d& numbers, double yaw);
/// Whether the frame's axes turn with the vehicle's heading.
bool is_body_frame(std::uint8_t frame);

}  // namespace trident::bridges::mavlink
