// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/local_frame.h"

#include <Eigen/Geometry>
#include <GeographicLib/LocalCartesian.hpp>

namespace trident::bridges {

struct LocalFrame::Impl {
  GeographicLib::LocalCartesian earth;
  double elevation_m = 0.0;
};

LocalFrame::LocalFrame(const OriginParams& params)
    : impl_(std::make_unique<Impl>()),
      is_known_(params.is_given),
      heading_rad_(params.heading_rad) {
  impl_->earth.Reset(params.latitude_deg, params.longitude_deg, params.elevation_m);
  impl_->elevation_m = params.elevation_m;
}

LocalFrame::~LocalFrame() = default;

void LocalFrame::set_place(const nmea::RoutePlace& place, double altitude_m,
                           const Eigen::Vector2d& p_frame) {
  if (is_known_) return;
  impl_->earth.Reset(place.latitude_deg, place.longitude_deg, altitude_m);
  impl_->elevation_m = altitude_m;
  p_frame_origin_ = p_frame;
  is_known_ = true;
}

Eigen::Vector2d LocalFrame::to_frame(const nmea::RoutePlace& place) const {
  double east = 0.0, north = 0.0, up = 0.0;
  impl_->earth.Forward(place.latitude_deg, place.longitude_deg, impl_->elevation_m, east, north,
                       up);
  return p_frame_origin_ + Eigen::Rotation2Dd(-heading_rad_) * Eigen::Vector2d(east, north);
}

nmea::RoutePlace LocalFrame::to_earth(const Eigen::Vector2d& p_frame) const {
  const Eigen::Vector2d p_enu = Eigen::Rotation2Dd(heading_rad_) * (p_frame - p_frame_origin_);
  nmea::RoutePlace place;
  double height = 0.0;
  impl_->earth.Reverse(p_enu.x(), p_enu.y(), 0.0, place.latitude_deg, place.longitude_deg, height);
  return place;
}

}  // namespace trident::bridges
