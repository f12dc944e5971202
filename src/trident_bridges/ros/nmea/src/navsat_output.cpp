// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/navsat_output.h"

#include <cmath>

#include "trident_base/angle.h"

namespace trident::bridges {
namespace {

using sensor_msgs::NavSatFix;
using sensor_msgs::NavSatStatus;

ros::Time to_ros(std::int64_t unix_ns) {
  ros::Time time;
  if (unix_ns > 0) time.fromNSec(static_cast<std::uint64_t>(unix_ns));
  return time;
}

/// The status of a quality of GGA, as nmea_navsat_driver has it; encrypted signals (3) are a fix.
std::int8_t status_of(int quality) {
  switch (quality) {
    case 1:
    case 3:
      return NavSatStatus::STATUS_FIX;
    case 2:
      return NavSatStatus::STATUS_SBAS_FIX;
    case 4:
    case 5:
    case 9:
      return NavSatStatus::STATUS_GBAS_FIX;
    default:
      return NavSatStatus::STATUS_NO_FIX;
  }
}

std::uint8_t covariance_type(nmea::ErrorsKnown errors) {
  switch (errors) {
    case nmea::ErrorsKnown::kYes:
      return NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
    case nmea::ErrorsKnown::kApproximately:
      return NavSatFix::COVARIANCE_TYPE_APPROXIMATED;
    default:
      return NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  }
}

}  // namespace

NavsatOutput::NavsatOutput(ros::NodeHandle node, const NavsatOutputParams& params)
    : params_(params),
      frame_id_(params.frame_id),
      fix_(node, "fix"),
      velocity_(node, "vel"),
      heading_(node, "heading"),
      time_(node, "time_reference") {}

void NavsatOutput::set_origin(const ros::Time& stamp, const std::string& frame_id) {
  stamp_ = stamp;
  frame_id_ = frame_id;
}

void NavsatOutput::on_fix(const nmea::NavsatFix& fix) {
  if (std::isnan(fix.latitude_deg) && !params_.shows_no_fix) return;
  NavSatFix message;
  message.header.stamp = stamp_;
  if (params_.uses_gnss_time) {
    if (!fix.unix_ns) {
      ROS_WARN_THROTTLE(5.0, "a fix without a time is not published: use_GNSS_time is set");
      return;
    }
    message.header.stamp = to_ros(*fix.unix_ns);
  }
  message.header.frame_id = frame_id_;
  message.status.status = status_of(fix.quality);
  message.status.service = NavSatStatus::SERVICE_GPS;
  message.latitude = fix.latitude_deg;
  message.longitude = fix.longitude_deg;
  message.altitude = fix.altitude_m;
  for (std::size_t i = 0; i < fix.variance_m2.size(); ++i) {
    message.position_covariance[4 * i] = fix.variance_m2[i];
  }
  message.position_covariance_type = covariance_type(fix.errors);
  fix_.publish(message);
}

void NavsatOutput::on_velocity(const nmea::GroundVelocity& velocity) {
  geometry_msgs::TwistStamped message;
  message.header.stamp = stamp_;
  message.header.frame_id = frame_id_;
  message.twist.linear.x = velocity.east_m_s;
  message.twist.linear.y = velocity.north_m_s;
  velocity_.publish(message);
}

void NavsatOutput::on_time(std::int64_t unix_ns) {
  sensor_msgs::TimeReference message;
  message.header.stamp = stamp_;
  message.header.frame_id = frame_id_;
  message.time_ref = to_ros(unix_ns);
  message.source = params_.time_source.empty() ? frame_id_ : params_.time_source;
  time_.publish(message);
}

void NavsatOutput::on_heading(double heading_rad) {
  const double yaw = params_.has_compass_heading ? heading_rad : 0.5 * kPi - heading_rad;
  geometry_msgs::QuaternionStamped message;
  message.header.stamp = stamp_;
  message.header.frame_id = frame_id_;
  message.quaternion.z = std::sin(0.5 * yaw);
  message.quaternion.w = std::cos(0.5 * yaw);
  heading_.publish(message);
}

}  // namespace trident::bridges
