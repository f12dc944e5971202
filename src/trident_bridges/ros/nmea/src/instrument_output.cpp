// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/instrument_output.h"

#include <Eigen/Geometry>
#include <limits>

#include "trident_base/angle.h"
#include "trident_base/se3.h"
#include "trident_bridges/nmea/units.h"

namespace trident::bridges {
namespace {

constexpr double kUnknown = -1.0;             ///< first element of a covariance: nothing is known
constexpr float kEchoSounderBeam_rad = 0.2F;  ///< a usual width, as sentences have none
constexpr float kFarthestEcho_m = 1e4F;       ///< where the sounder does not say its range
constexpr std::uint32_t kNumberQueueSize = 10;

float or_nan(const std::optional<double>& value, double factor) {
  return value ? static_cast<float>(*value * factor) : std::numeric_limits<float>::quiet_NaN();
}

double or_nan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

InstrumentOutput::InstrumentOutput(const ros::NodeHandle& node, const NavsatOutputParams& params)
    : NavsatOutput(node, params),
      node_(node),
      imu_(node_, "imu"),
      water_(node_, "water_velocity"),
      depth_(node_, "depth"),
      wind_(node_, "wind_reading"),
      ais_(node_, "ais"),
      cross_track_(node_, "cross_track_error") {}

void InstrumentOutput::publish_imu() {
  if (imu_.subscribers() == 0) return;
  sensor_msgs::Imu message;
  message.header.stamp = stamp();
  message.header.frame_id = frame_id();
  message.orientation.w = 1.0;
  message.orientation_covariance[0] = kUnknown;
  message.angular_velocity_covariance[0] = kUnknown;
  message.linear_acceleration_covariance[0] = kUnknown;
  if (heading_rad_) {
    const Eigen::Quaterniond q =
        SE3::from_xyz_rpy(Eigen::Vector3d::Zero(), tilt_.roll_rad.value_or(0.0),
                          tilt_.pitch_rad.value_or(0.0), 0.5 * kPi - *heading_rad_)
            .R;
    message.orientation.x = q.x();
    message.orientation.y = q.y();
    message.orientation.z = q.z();
    message.orientation.w = q.w();
    message.orientation_covariance[0] = 0.0;
  }
  if (turn_rad_s_) {
    message.angular_velocity.z = *turn_rad_s_;
    message.angular_velocity_covariance[0] = 0.0;
  }
  imu_.publish(message);
}

void InstrumentOutput::on_heading(double heading_rad) {
  NavsatOutput::on_heading(heading_rad);
  heading_rad_ = heading_rad;
  publish_imu();
}

void InstrumentOutput::on_turn_rate(double rad_s) {
  turn_rad_s_ = rad_s;
  publish_imu();
}

void InstrumentOutput::on_tilt(const nmea::Tilt& tilt) {
  if (tilt.roll_rad) tilt_.roll_rad = tilt.roll_rad;
  if (tilt.pitch_rad) tilt_.pitch_rad = tilt.pitch_rad;
  publish_imu();
}

void InstrumentOutput::on_water_velocity(const nmea::WaterVelocity& velocity) {
  geometry_msgs::TwistStamped message;
  message.header.stamp = stamp();
  message.header.frame_id = frame_id();
  message.twist.linear.x = velocity.ahead_m_s;
  message.twist.linear.y = velocity.port_m_s;
  water_.publish(message);
}

void InstrumentOutput::on_depth(const nmea::DepthReading& depth) {
  sensor_msgs::Range message;
  message.header.stamp = stamp();
  message.header.frame_id = frame_id();
  message.radiation_type = sensor_msgs::Range::ULTRASOUND;
  message.field_of_view = kEchoSounderBeam_rad;
  message.max_range = depth.max_range_m ? static_cast<float>(*depth.max_range_m) : kFarthestEcho_m;
  message.range = static_cast<float>(depth.depth_m);
  depth_.publish(message);
}

void InstrumentOutput::on_wind(const nmea::WindEvent& wind) {
  trident_msgs::WindReading message;
  message.header.stamp = stamp();
  message.header.frame_id = frame_id();
  message.reference =
      wind.is_true ? trident_msgs::WindReading::TRUE : trident_msgs::WindReading::RELATIVE;
  message.speed = wind.speed_m_s;
  message.angle = wind.angle_rad;
  wind_.publish(message);
}

void InstrumentOutput::on_number(const nmea::NamedNumber& number) {
  auto publisher = numbers_.find(number.name);
  if (publisher == numbers_.end()) {
    if (numbers_.size() == kMaxNumbers) {
      ROS_WARN_ONCE("sentences have more than %zu numbers of different names: others are ignored",
                    kMaxNumbers);
      return;
    }
    const std::string name(number.name);
    // Latched: it is advertised by its first number.
    publisher =
        numbers_.emplace(name, node_.advertise<std_msgs::Float64>(name, kNumberQueueSize, true))
            .first;
  }
  std_msgs::Float64 message;
  message.data = number.value;
  publisher->second.publish(message);
}

void InstrumentOutput::on_steering(const nmea::SteeringEvent& steering) {
  if (steering.cross_track_m) {
    std_msgs::Float64 message;
    message.data = *steering.cross_track_m;
    cross_track_.publish(message);
  }
  if (autopilot_.steer) autopilot_.steer(steering);
}

void InstrumentOutput::on_route(const std::vector<nmea::RoutePlace>& places) {
  if (autopilot_.follow) autopilot_.follow(places);
}

void InstrumentOutput::on_ais(const nmea::AisVessel& vessel, bool is_own) {
  if (is_own) return;
  trident_msgs::AisTarget message;
  message.header.stamp = stamp();
  message.header.frame_id = frame_id();
  message.mmsi = vessel.mmsi;
  message.message_type = static_cast<std::uint8_t>(vessel.message_type);
  message.nav_status = static_cast<std::uint8_t>(vessel.status);
  message.latitude = or_nan(vessel.motion.latitude_deg);
  message.longitude = or_nan(vessel.motion.longitude_deg);
  message.speed = or_nan(vessel.motion.speed_knots, nmea::kMetersPerSecondPerKnot);
  message.course = or_nan(vessel.motion.course_deg, deg_to_rad(1.0));
  message.heading = or_nan(vessel.motion.heading_deg, deg_to_rad(1.0));
  message.turn_rate = or_nan(vessel.turn_rate_deg_min, deg_to_rad(1.0) / nmea::kSecondsPerMinute);
  message.name = std::string(vessel.name.view());
  message.call_sign = std::string(vessel.call_sign.view());
  message.ship_type = static_cast<std::uint8_t>(vessel.ship_type);
  message.to_bow = static_cast<float>(vessel.extent.to_bow_m);
  message.to_stern = static_cast<float>(vessel.extent.to_stern_m);
  message.to_port = static_cast<float>(vessel.extent.to_port_m);
  message.to_starboard = static_cast<float>(vessel.extent.to_starboard_m);
  ais_.publish(message);
}

}  // namespace trident::bridges
