// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <mavros_msgs/Altitude.h>
#include <mavros_msgs/NavControllerOutput.h>
#include <mavros_msgs/RadioStatus.h>
#include <mavros_msgs/VFR_HUD.h>
#include <mavros_msgs/Vibration.h>

#include <cmath>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using bridges::NodePublisher;

/// A topic that one message of MAVLink becomes.
template <class RosMessage>
class OneTopic : public Plugin {
 public:
  OneTopic(Hub& hub, const std::string& topic)
      : hub_(hub), output_(hub.ros.advertise<RosMessage>(topic)) {}

 protected:
  void publish(const RosMessage& message) { output_->publish(message); }
  RosMessage stamped(const ros::Time& stamp) const {
    RosMessage message;
    message.header.stamp = stamp;
    return message;
  }
  Hub& hub_;

 private:
  std::unique_ptr<NodePublisher<RosMessage>> output_;
};

class VfrHud : public OneTopic<mavros_msgs::VFR_HUD> {
 public:
  explicit VfrHud(Hub& hub) : OneTopic(hub, "vfr_hud") {
    on<mavlink_vfr_hud_t>(hub.vehicle, [this](const mavlink_vfr_hud_t& p) {
      constexpr float kPercent = 100.0F;
      auto message = stamped(ros::Time::now());
      message.airspeed = p.airspeed;
      message.groundspeed = p.groundspeed;
      message.heading = p.heading;
      message.throttle = static_cast<float>(p.throttle) / kPercent;
      message.altitude = p.alt;
      message.climb = p.climb;
      publish(message);
    });
  }
};

class AltitudePlugin : public OneTopic<mavros_msgs::Altitude> {
 public:
  explicit AltitudePlugin(Hub& hub) : OneTopic(hub, "altitude") {
    on<mavlink_altitude_t>(hub.vehicle, [this](const mavlink_altitude_t& p) {
      auto message = stamped(hub_.vehicle.stamp_us(p.time_usec));
      message.header.frame_id = hub_.params.local_position.frame_id;
      message.monotonic = p.altitude_monotonic;
      message.amsl = p.altitude_amsl;
      message.local = p.altitude_local;
      message.relative = p.altitude_relative;
      message.terrain = p.altitude_terrain;
      message.bottom_clearance = p.bottom_clearance;
      publish(message);
    });
  }
};

/// WIND_COV of PX4 and WIND of ArduPilot: where the air moves to, ENU.
class WindEstimation : public OneTopic<geometry_msgs::TwistWithCovarianceStamped> {
 public:
  explicit WindEstimation(Hub& hub) : OneTopic(hub, "wind_estimation") {
    on<mavlink_wind_cov_t>(hub.vehicle, [this](const mavlink_wind_cov_t& p) {
      auto message = stamped(hub_.vehicle.stamp_us(p.time_usec));
      assign(message.twist.twist.linear,
             bridges::mavlink::swap_world({p.wind_x, p.wind_y, p.wind_z}));
      message.twist.covariance[0] = message.twist.covariance[7] = p.var_horiz;
      message.twist.covariance[14] = p.var_vert;
      publish(message);
    });
    on<mavlink_wind_t>(hub.vehicle, [this](const mavlink_wind_t& p) {
      constexpr double kDegree = kPi / 180.0;
      const double from = p.direction * kDegree;
      auto message = stamped(ros::Time::now());
      message.twist.twist.linear.x = -p.speed * std::sin(from);
      message.twist.twist.linear.y = -p.speed * std::cos(from);
      message.twist.twist.linear.z = -p.speed_z;
      message.twist.covariance[0] = -1.0;  // not known
      publish(message);
    });
  }
};

class NavController : public OneTopic<mavros_msgs::NavControllerOutput> {
 public:
  explicit NavController(Hub& hub) : OneTopic(hub, "nav_controller_output/output") {
    on<mavlink_nav_controller_output_t>(hub.vehicle, [this](const auto& p) {
      auto message = stamped(ros::Time::now());
      message.nav_roll = p.nav_roll;
      message.nav_pitch = p.nav_pitch;
      message.nav_bearing = p.nav_bearing;
      message.target_bearing = p.target_bearing;
      message.wp_dist = p.wp_dist;
      message.alt_error = p.alt_error;
      message.aspd_error = p.aspd_error;
      message.xtrack_error = p.xtrack_error;
      publish(message);
    });
  }
};

/// RADIO_STATUS comes from the radio, whose system id is not that of the vehicle.
class Radio : public OneTopic<mavros_msgs::RadioStatus> {
 public:
  explicit Radio(Hub& hub) : OneTopic(hub, "radio_status") {
    hub.vehicle.on_packet([this](const Packet& packet) {
      if (packet.id != MAVLINK_MSG_ID_RADIO_STATUS) return;
      const Message message = bridges::mavlink::to_message(packet);
      on_status(bridges::mavlink::unpack<mavlink_radio_status_t>(message));
    });
  }

 private:
  /// Of a 3DR radio, by its data sheet: half decibels above -127 dBm.
  static float to_dBm(std::uint8_t rssi) { return static_cast<float>(rssi) / 1.9F - 127.0F; }

  void on_status(const mavlink_radio_status_t& p) {
    auto message = stamped(ros::Time::now());
    message.rssi = p.rssi;
    message.remrssi = p.remrssi;
    message.txbuf = p.txbuf;
    message.noise = p.noise;
    message.remnoise = p.remnoise;
    message.rxerrors = p.rxerrors;
    message.fixed = p.fixed;
    message.rssi_dbm = to_dBm(p.rssi);
    message.remrssi_dbm = to_dBm(p.remrssi);
    publish(message);
    if (p.rssi < hub_.params.tdr_radio.low_rssi) {
      hub_.ros.refusals().count("3DR Radio", "rssi is " + std::to_string(p.rssi) + ", limit " +
                                                 std::to_string(hub_.params.tdr_radio.low_rssi));
    }
  }
};

class VibrationPlugin : public OneTopic<mavros_msgs::Vibration> {
 public:
  explicit VibrationPlugin(Hub& hub) : OneTopic(hub, "vibration/raw/vibration") {
    on<mavlink_vibration_t>(hub.vehicle, [this](const mavlink_vibration_t& p) {
      auto message = stamped(hub_.vehicle.stamp_us(p.time_usec));
      message.header.frame_id = hub_.params.imu.frame_id;
      assign(message.vibration, {p.vibration_x, p.vibration_y, p.vibration_z});
      message.clipping[0] = static_cast<float>(p.clipping_0);
      message.clipping[1] = static_cast<float>(p.clipping_1);
      message.clipping[2] = static_cast<float>(p.clipping_2);
      publish(message);
    });
  }
};

}  // namespace

std::unique_ptr<Plugin> make_vfr_hud(Hub& hub) { return std::make_unique<VfrHud>(hub); }
std::unique_ptr<Plugin> make_altitude(Hub& hub) { return std::make_unique<AltitudePlugin>(hub); }
std::unique_ptr<Plugin> make_wind_estimation(Hub& hub) {
  return std::make_unique<WindEstimation>(hub);
}
std::unique_ptr<Plugin> make_nav_controller_output(Hub& hub) {
  return std::make_unique<NavController>(hub);
}
std::unique_ptr<Plugin> make_3dr_radio(Hub& hub) { return std::make_unique<Radio>(hub); }
std::unique_ptr<Plugin> make_vibration(Hub& hub) { return std::make_unique<VibrationPlugin>(hub); }

}  // namespace trident::mavros
