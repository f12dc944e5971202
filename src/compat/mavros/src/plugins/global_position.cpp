// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <geographic_msgs/GeoPointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <mavros_msgs/HomePosition.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/NavSatFix.h>
#include <std_msgs/Float64.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/Trigger.h>

#include <cmath>
#include <optional>

#include "core/conversions.h"
#include "core/transforms.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "trident_base/string_util.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::GeoFrame;
using bridges::mavlink::GeoPlace;
using bridges::mavlink::swap_attitude;
using bridges::mavlink::swap_world;
using sensor_msgs::NavSatFix;
using sensor_msgs::NavSatStatus;

constexpr double kLatLonUnit = 1e-7, kMillimeter = 1e-3, kCentimeter = 1e-2;
constexpr double kDegree = kPi / 180.0;
constexpr std::uint16_t kUnknown16 = UINT16_MAX;

std::int8_t fix_status(std::uint8_t fix_type) {
  if (fix_type < GPS_FIX_TYPE_2D_FIX) return NavSatStatus::STATUS_NO_FIX;
  if (fix_type == GPS_FIX_TYPE_DGPS) return NavSatStatus::STATUS_SBAS_FIX;
  return fix_type >= GPS_FIX_TYPE_RTK_FLOAT ? NavSatStatus::STATUS_GBAS_FIX
                                            : NavSatStatus::STATUS_FIX;
}

/// Whether a place is on earth; one that is not is refused by the topic's name.
bool is_place(Hub& hub, const std::string& topic, const geographic_msgs::GeoPoint& place) {
  constexpr double kMaxLatitude = 90.0, kMaxLongitude = 180.0;
  if (std::abs(place.latitude) <= kMaxLatitude && std::abs(place.longitude) <= kMaxLongitude &&
      std::isfinite(place.altitude)) {
    return true;
  }
  hub.ros.refusals().note("places refused", topic + ": latitude " + number_text(place.latitude) +
                                                ", longitude " + number_text(place.longitude) +
                                                ", altitude " + number_text(place.altitude) +
                                                ", legal: up to 90 deg and 180 deg, finite");
  return false;
}

/// Heights are above the ellipsoid in ROS, above the geoid in MAVLink.
template <class Payload>
void write_place(const Hub& hub, const geographic_msgs::GeoPoint& place, Payload& to) {
  to.latitude = to_whole<std::int32_t>(place.latitude / kLatLonUnit);
  to.longitude = to_whole<std::int32_t>(place.longitude / kLatLonUnit);
  to.altitude =
      to_whole<std::int32_t>((place.altitude - hub.known.geoid_separation_m) / kMillimeter);
}

/// Where the vehicle is on the earth.
class GlobalPosition : public Plugin {
 public:
  explicit GlobalPosition(Hub& hub)
      : hub_(hub),
        vehicle_(hub.vehicle),
        params_(hub.params.global_position),
        transform_(hub.ros, params_.tf) {
    advertise();
    on<mavlink_gps_raw_int_t>(vehicle_, [this](const auto& p) { on_gps(p); });
    on<mavlink_global_position_int_t>(vehicle_, [this](const auto& p) { on_global(p); });
    on<mavlink_gps_global_origin_t>(vehicle_, [this](const auto& p) { on_origin(p); });
    on<mavlink_local_position_ned_system_global_offset_t>(vehicle_,
                                                          [this](const auto& p) { on_offset(p); });
    hub.ros.subscribe<geographic_msgs::GeoPointStamped>(
        "global_position/set_gp_origin", [this](const auto& message) {
          if (!is_place(hub_, "global_position/set_gp_origin", message.position)) return;
          mavlink_set_gps_global_origin_t payload{};
          payload.target_system = vehicle_.target().system;
          write_place(hub_, message.position, payload);
          send(vehicle_, payload);
        });
  }

 private:
  void advertise() {
    RosSide& ros = hub_.ros;
    raw_fix_ = ros.advertise<NavSatFix>("global_position/raw/fix");
    raw_velocity_ = ros.advertise<geometry_msgs::TwistStamped>("global_position/raw/gps_vel");
    satellites_ = ros.advertise<std_msgs::UInt32>("global_position/raw/satellites");
    global_ = ros.advertise<NavSatFix>("global_position/global");
    local_ = ros.advertise<nav_msgs::Odometry>("global_position/local");
    height_ = ros.advertise<std_msgs::Float64>("global_position/rel_alt");
    heading_ = ros.advertise<std_msgs::Float64>("global_position/compass_hdg");
    origin_ = ros.advertise_latched<geographic_msgs::GeoPointStamped>("global_position/gp_origin");
    offset_ = ros.advertise<geometry_msgs::PoseStamped>("global_position/gp_lp_offset");
  }
  std_msgs::Header header(const ros::Time& stamp) const {
    std_msgs::Header result;
    result.stamp = stamp;
    result.frame_id = params_.child_frame_id;
    return result;
  }

  void on_gps(const mavlink_gps_raw_int_t& p) {
    if (p.alt_ellipsoid != 0) {
      hub_.known.geoid_separation_m = (static_cast<double>(p.alt_ellipsoid) - p.alt) * kMillimeter;
    }
    NavSatFix fix;
    fix.header = header(vehicle_.stamp_us(p.time_usec));
    fix.status.status = fix_status(p.fix_type);
    fix.status.service = NavSatStatus::SERVICE_GPS;
    fix.latitude = p.lat * kLatLonUnit;
    fix.longitude = p.lon * kLatLonUnit;
    fix.altitude = p.alt * kMillimeter + hub_.known.geoid_separation_m;
    fill_covariance(p, fix);
    newest_fix_ = fix;
    raw_fix_->publish(fix);
    std_msgs::UInt32 satellites;
    satellites.data = p.satellites_visible;
    satellites_->publish(satellites);
    if (p.vel == kUnknown16 || p.cog == kUnknown16) return;
    geometry_msgs::TwistStamped velocity;
    velocity.header = fix.header;
    velocity.header.frame_id = params_.frame_id;  // its parts are east and north
    const double speed = p.vel * kCentimeter, course = p.cog * kCentimeter * kDegree;
    velocity.twist.linear.x = speed * std::sin(course);
    velocity.twist.linear.y = speed * std::cos(course);
    raw_velocity_->publish(velocity);
  }
  /// From the accuracies where the vehicle gives them, else from the dilutions of precision.
  void fill_covariance(const mavlink_gps_raw_int_t& p, NavSatFix& fix) const {
    const bool has_accuracy = p.h_acc > 0 && p.v_acc > 0;
    if (!has_accuracy && p.eph == kUnknown16) {
      fix.position_covariance_type = NavSatFix::COVARIANCE_TYPE_UNKNOWN;
      return;
    }
    double horizontal = p.h_acc * kMillimeter, vertical = p.v_acc * kMillimeter;
    fix.position_covariance_type = NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
    if (!has_accuracy) {
      horizontal = p.eph * kCentimeter * params_.gps_uere;
      vertical = p.epv * kCentimeter * params_.gps_uere;
      fix.position_covariance_type = NavSatFix::COVARIANCE_TYPE_APPROXIMATED;
    }
    fix.position_covariance[0] = fix.position_covariance[4] = horizontal * horizontal;
    fix.position_covariance[8] = vertical * vertical;
  }

  void on_global(const mavlink_global_position_int_t& p) {
    NavSatFix fix = newest_fix_.value_or(NavSatFix());  // its status and covariance
    fix.header = header(vehicle_.stamp_ms(p.time_boot_ms));
    fix.latitude = p.lat * kLatLonUnit;
    fix.longitude = p.lon * kLatLonUnit;
    fix.altitude = p.alt * kMillimeter + hub_.known.geoid_separation_m;
    global_->publish(fix);
    std_msgs::Float64 number;
    number.data = p.relative_alt * kMillimeter;
    height_->publish(number);
    if (p.hdg != kUnknown16) {
      number.data = p.hdg * kCentimeter;
      heading_->publish(number);
    }
    publish_local(fix, p);
  }

  bridges::mavlink::Matrix6 pose_covariance(const NavSatFix& fix) const {
    bridges::mavlink::Matrix6 covariance = bridges::mavlink::Matrix6::Zero();
    for (int i = 0; i < 3; ++i) {
      covariance(i, i) = fix.position_covariance[static_cast<std::size_t>(4 * i)];
      covariance(3 + i, 3 + i) = params_.rot_covariance;
    }
    return covariance;
  }

  void publish_local(const NavSatFix& fix, const mavlink_global_position_int_t& p) {
    const GeoPlace place{fix.latitude, fix.longitude, p.alt * kMillimeter};
    // Without a fix latitude and longitude are 0, which would be the origin from then on.
    const bool has_fix = newest_fix_ && newest_fix_->status.status != NavSatStatus::STATUS_NO_FIX;
    if (!frame_ && !has_fix) return;
    if (!frame_) frame_.emplace(place);
    Eigen::Vector3d at = frame_->to_world(place);
    if (params_.use_relative_alt) at.z() = p.relative_alt * kMillimeter;
    const Eigen::Vector3d v = swap_world(Eigen::Vector3d(p.vx, p.vy, p.vz) * kCentimeter);
    nav_msgs::Odometry odometry;
    odometry.header = fix.header;
    odometry.header.frame_id = params_.frame_id;
    odometry.child_frame_id = params_.child_frame_id;
    assign(odometry.pose.pose.position, at);
    assign_rotation(odometry.pose.pose.orientation, hub_.known.R_world_body);
    assign(odometry.twist.twist.linear, hub_.known.R_world_body.inverse() * v);
    assign(odometry.twist.twist.angular, hub_.known.w_body_rad_s);
    assign_matrix6(odometry.pose.covariance, pose_covariance(fix));
    local_->publish(odometry);
    transform_.send(odometry.header.stamp, at, hub_.known.R_world_body);
  }

  void on_origin(const mavlink_gps_global_origin_t& p) {
    const double altitude_m = p.altitude * kMillimeter;
    frame_.emplace(GeoPlace{p.latitude * kLatLonUnit, p.longitude * kLatLonUnit, altitude_m});
    geographic_msgs::GeoPointStamped message;
    message.header.stamp = ros::Time::now();
    message.header.frame_id = params_.frame_id;
    message.position.latitude = p.latitude * kLatLonUnit;
    message.position.longitude = p.longitude * kLatLonUnit;
    message.position.altitude = altitude_m + hub_.known.geoid_separation_m;
    origin_.publish(message);
  }
  void on_offset(const mavlink_local_position_ned_system_global_offset_t& p) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = vehicle_.stamp_ms(p.time_boot_ms);
    message.header.frame_id = params_.frame_id;
    assign(message.pose.position, swap_world({p.x, p.y, p.z}));
    assign_rotation(message.pose.orientation, swap_attitude(from_euler(p.roll, p.pitch, p.yaw)));
    offset_->publish(message);
  }

  Hub& hub_;
  VehicleSide& vehicle_;
  const PositionParams& params_;
  TransformOutput transform_;
  std::unique_ptr<bridges::NodePublisher<NavSatFix>> raw_fix_, global_;
  std::unique_ptr<bridges::NodePublisher<geometry_msgs::TwistStamped>> raw_velocity_;
  std::unique_ptr<bridges::NodePublisher<std_msgs::UInt32>> satellites_;
  std::unique_ptr<bridges::NodePublisher<nav_msgs::Odometry>> local_;
  std::unique_ptr<bridges::NodePublisher<std_msgs::Float64>> height_, heading_;
  ros::Publisher origin_;
  std::unique_ptr<bridges::NodePublisher<geometry_msgs::PoseStamped>> offset_;
  std::optional<GeoFrame> frame_;
  std::optional<NavSatFix> newest_fix_;  ///< of the receiver
};

/// Where the vehicle returns to.
class HomePosition : public Plugin {
 public:
  explicit HomePosition(Hub& hub) : hub_(hub), vehicle_(hub.vehicle) {
    home_ = hub.ros.advertise_latched<mavros_msgs::HomePosition>("home_position/home");
    on<mavlink_home_position_t>(vehicle_, [this](const auto& p) { on_home(p); });
    hub.ros.subscribe<mavros_msgs::HomePosition>(
        "home_position/set", [this](const auto& message) { set_home(message); });
    hub.ros.serve_waiting<std_srvs::Trigger>("home_position/req_update",
                                             [this](const auto&, auto reply) {
                                               ask([reply](const CommandOutcome& end) {
                                                 std_srvs::Trigger::Response response;
                                                 response.success = end.is_answered;
                                                 response.message = end.reply.reason;
                                                 reply(response);
                                               });
                                             });
    vehicle_.on_connection([this](bool is_there) {
      if (is_there) ask([](const CommandOutcome&) {});
    });
  }

 private:
  void ask(std::function<void(const CommandOutcome&)> done) {
    bridges::mavlink::Command command;
    command.command = MAV_CMD_GET_HOME_POSITION;
    vehicle_.command(command, false, std::move(done));
  }
  void on_home(const mavlink_home_position_t& p) {
    mavros_msgs::HomePosition message;
    message.header.stamp = ros::Time::now();
    message.geo.latitude = p.latitude * kLatLonUnit;
    message.geo.longitude = p.longitude * kLatLonUnit;
    message.geo.altitude = p.altitude * kMillimeter + hub_.known.geoid_separation_m;
    assign(message.position, swap_world({p.x, p.y, p.z}));
    const Eigen::Quaterniond q(p.q[0], p.q[1], p.q[2], p.q[3]);
    const bool has_attitude = std::isfinite(q.norm()) && q.norm() > 0.5;
    assign_rotation(message.orientation,
                    has_attitude ? swap_attitude(q) : Eigen::Quaterniond::Identity());
    assign(message.approach, swap_world({p.approach_x, p.approach_y, p.approach_z}));
    home_.publish(message);
  }
  void set_home(const mavros_msgs::HomePosition& message) {
    if (!is_place(hub_, "home_position/set", message.geo)) return;
    mavlink_set_home_position_t payload{};
    payload.target_system = vehicle_.target().system;
    write_place(hub_, message.geo, payload);
    const Eigen::Vector3d p = swap_world(to_eigen(message.position));
    const Eigen::Vector3d approach = swap_world(to_eigen(message.approach));
    const Eigen::Quaterniond q = swap_attitude(to_rotation(message.orientation));
    payload.x = static_cast<float>(p.x());
    payload.y = static_cast<float>(p.y());
    payload.z = static_cast<float>(p.z());
    assign_q(payload, q);
    payload.approach_x = static_cast<float>(approach.x());
    payload.approach_y = static_cast<float>(approach.y());
    payload.approach_z = static_cast<float>(approach.z());
    send(vehicle_, payload);
  }

  Hub& hub_;
  VehicleSide& vehicle_;
  ros::Publisher home_;
};

}  // namespace

std::unique_ptr<Plugin> make_global_position(Hub& hub) {
  return std::make_unique<GlobalPosition>(hub);
}
std::unique_ptr<Plugin> make_home_position(Hub& hub) { return std::make_unique<HomePosition>(hub); }

}  // namespace trident::mavros
