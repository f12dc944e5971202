// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/geo_frame.h"

#include <Eigen/Geometry>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/frames.h"

namespace trident::bridges::mavlink {

GeoFrame::GeoFrame(const GeoPlace& origin)
    : origin_(origin), earth_(origin.latitude_deg, origin.longitude_deg, origin.altitude_m) {}

Eigen::Vector3d GeoFrame::to_world(const GeoPlace& place) const {
  Eigen::Vector3d p;
  earth_.Forward(place.latitude_deg, place.longitude_deg, place.altitude_m, p.x(), p.y(), p.z());
  return p;
}

GeoPlace GeoFrame::to_geo(const Eigen::Vector3d& p_world_m) const {
  GeoPlace place;
  earth_.Reverse(p_world_m.x(), p_world_m.y(), p_world_m.z(), place.latitude_deg,
                 place.longitude_deg, place.altitude_m);
  return place;
}

bool is_body_frame(std::uint8_t frame) {
  return frame == MAV_FRAME_BODY_NED || frame == MAV_FRAME_BODY_OFFSET_NED ||
         frame == MAV_FRAME_BODY_FRD;
}

Eigen::Vector3d direction_in_world(std::uint8_t frame, const Eigen::Vector3d& numbers, double yaw) {
  if (!is_body_frame(frame)) return swap_world(numbers);
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * swap_body(numbers);
}

std::optional<Eigen::Vector3d> place_in_world(std::uint8_t frame, const Eigen::Vector3d& numbers,
                                              const PlaceContext& context) {
  switch (frame) {
    case MAV_FRAME_GLOBAL:
    case MAV_FRAME_GLOBAL_INT:
      return context.geo.to_world({numbers.x(), numbers.y(), numbers.z()});
    case MAV_FRAME_GLOBAL_RELATIVE_ALT:
    case MAV_FRAME_GLOBAL_RELATIVE_ALT_INT:
    case MAV_FRAME_GLOBAL_TERRAIN_ALT:
    case MAV_FRAME_GLOBAL_TERRAIN_ALT_INT: {
      const double home_m = context.geo.to_geo(context.home_m).altitude_m;
      return context.geo.to_world({numbers.x(), numbers.y(), home_m + numbers.z()});
    }
    case MAV_FRAME_LOCAL_NED:
      return swap_world(numbers);
    case MAV_FRAME_LOCAL_ENU:
      return numbers;
    case MAV_FRAME_LOCAL_OFFSET_NED:
    case MAV_FRAME_BODY_NED:
    case MAV_FRAME_BODY_OFFSET_NED:
    case MAV_FRAME_BODY_FRD:
      return context.p_m + direction_in_world(frame, numbers, context.yaw);
    default:
      return std::nullopt;
  }
}

}  // namespace trident::bridges::mavlink
