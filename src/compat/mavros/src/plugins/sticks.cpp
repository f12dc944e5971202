// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/ActuatorControl.h>
#include <mavros_msgs/ManualControl.h>
#include <mavros_msgs/OverrideRCIn.h>
#include <mavros_msgs/RCIn.h>
#include <mavros_msgs/RCOut.h>

#include <algorithm>
#include <cmath>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using mavros_msgs::ManualControl;
using mavros_msgs::OverrideRCIn;

/// A stick in the range of a field; a value that is not finite is no stick.
std::int16_t to_stick(double value, double least) {
  constexpr double kFull = 1000.0;
  if (!std::isfinite(value)) return INT16_MAX;
  return to_whole<std::int16_t>(std::max(least, std::min(kFull, value)));
}

class ManualControlPlugin : public Plugin {
 public:
  explicit ManualControlPlugin(Hub& hub) : vehicle_(hub.vehicle) {
    output_ = hub.ros.advertise<ManualControl>("manual_control/control");
    on<mavlink_manual_control_t>(vehicle_, [this](const auto& p) {
      ManualControl message;
      message.header.stamp = ros::Time::now();
      message.x = p.x;
      message.y = p.y;
      message.z = p.z;
      message.r = p.r;
      message.buttons = p.buttons;
      message.buttons2 = p.buttons2;
      message.enabled_extensions = p.enabled_extensions;
      message.s = p.s;
      message.t = p.t;
      output_->publish(message);
    });
    hub.ros.subscribe<ManualControl>("manual_control/send",
                                     [this](const auto& message) { send_sticks(message); });
  }

 private:
  void send_sticks(const ManualControl& message) {
    constexpr double kFullBack = -1000.0;
    mavlink_manual_control_t payload{};
    payload.target = vehicle_.target().system;
    payload.x = to_stick(message.x, kFullBack);
    payload.y = to_stick(message.y, kFullBack);
    payload.z = to_stick(message.z, kFullBack);
    payload.r = to_stick(message.r, kFullBack);
    payload.buttons = message.buttons;
    payload.buttons2 = message.buttons2;
    payload.enabled_extensions = message.enabled_extensions;
    payload.s = to_stick(message.s, kFullBack);
    payload.t = to_stick(message.t, kFullBack);
    send(vehicle_, payload);
  }

  VehicleSide& vehicle_;
  std::unique_ptr<bridges::NodePublisher<ManualControl>> output_;
};

/// Channels of the remote control, of the servos, and those that replace the former.
class RcIo : public Plugin {
 public:
  explicit RcIo(Hub& hub) : vehicle_(hub.vehicle) {
    in_ = hub.ros.advertise<mavros_msgs::RCIn>("rc/in");
    out_ = hub.ros.advertise<mavros_msgs::RCOut>("rc/out");
    on<mavlink_rc_channels_t>(vehicle_, [this](const mavlink_rc_channels_t& p) {
      mavros_msgs::RCIn message;
      message.header.stamp = vehicle_.stamp_ms(p.time_boot_ms);
      message.rssi = p.rssi;
      const std::uint16_t raw[] = {
          p.chan1_raw,  p.chan2_raw,  p.chan3_raw,  p.chan4_raw,  p.chan5_raw,  p.chan6_raw,
          p.chan7_raw,  p.chan8_raw,  p.chan9_raw,  p.chan10_raw, p.chan11_raw, p.chan12_raw,
          p.chan13_raw, p.chan14_raw, p.chan15_raw, p.chan16_raw, p.chan17_raw, p.chan18_raw};
      const std::size_t count = std::min<std::size_t>(p.chancount, std::size(raw));
      message.channels.assign(raw, raw + count);
      in_->publish(message);
    });
    on<mavlink_servo_output_raw_t>(vehicle_, [this](const mavlink_servo_output_raw_t& p) {
      mavros_msgs::RCOut message;
      message.header.stamp = vehicle_.stamp_us(p.time_usec);
      message.channels = {p.servo1_raw,  p.servo2_raw,  p.servo3_raw,  p.servo4_raw,
                          p.servo5_raw,  p.servo6_raw,  p.servo7_raw,  p.servo8_raw,
                          p.servo9_raw,  p.servo10_raw, p.servo11_raw, p.servo12_raw,
                          p.servo13_raw, p.servo14_raw, p.servo15_raw, p.servo16_raw};
      out_->publish(message);
    });
    hub.ros.subscribe<OverrideRCIn>("rc/override",
                                    [this](const auto& message) { send_override(message); });
  }

 private:
  void send_override(const OverrideRCIn& message) {
    const auto& c = message.channels;
    // Of channels 9 to 18, 0 means no change and 65534 means release.
    const auto later = [](std::uint16_t value) -> std::uint16_t {
      constexpr std::uint16_t kRelease = UINT16_MAX - 1;
      if (value == OverrideRCIn::CHAN_RELEASE) return kRelease;
      return value == OverrideRCIn::CHAN_NOCHANGE ? 0 : value;
    };
    mavlink_rc_channels_override_t payload{};
    payload.chan1_raw = c[0];
    payload.chan2_raw = c[1];
    payload.chan3_raw = c[2];
    payload.chan4_raw = c[3];
    payload.chan5_raw = c[4];
    payload.chan6_raw = c[5];
    payload.chan7_raw = c[6];
    payload.chan8_raw = c[7];
    payload.chan9_raw = later(c[8]);
    payload.chan10_raw = later(c[9]);
    payload.chan11_raw = later(c[10]);
    payload.chan12_raw = later(c[11]);
    payload.chan13_raw = later(c[12]);
    payload.chan14_raw = later(c[13]);
    payload.chan15_raw = later(c[14]);
    payload.chan16_raw = later(c[15]);
    payload.chan17_raw = later(c[16]);
    payload.chan18_raw = later(c[17]);
    send_to_target(vehicle_, payload);
  }

  VehicleSide& vehicle_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::RCIn>> in_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::RCOut>> out_;
};

class ActuatorControlPlugin : public Plugin {
 public:
  explicit ActuatorControlPlugin(Hub& hub) : vehicle_(hub.vehicle) {
    using mavros_msgs::ActuatorControl;
    output_ = hub.ros.advertise<ActuatorControl>("target_actuator_control");
    on<mavlink_actuator_control_target_t>(vehicle_, [this](const auto& p) {
      ActuatorControl message;
      message.header.stamp = vehicle_.stamp_us(p.time_usec);
      message.group_mix = p.group_mlx;
      std::copy(std::begin(p.controls), std::end(p.controls), message.controls.begin());
      output_->publish(message);
    });
    hub.ros.subscribe<ActuatorControl>("actuator_control", [this](const auto& message) {
      mavlink_set_actuator_control_target_t payload{};
      payload.group_mlx = message.group_mix;
      std::copy(message.controls.begin(), message.controls.end(), std::begin(payload.controls));
      send_to_target(vehicle_, payload);
    });
  }

 private:
  VehicleSide& vehicle_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::ActuatorControl>> output_;
};

}  // namespace

std::unique_ptr<Plugin> make_manual_control(Hub& hub) {
  return std::make_unique<ManualControlPlugin>(hub);
}
std::unique_ptr<Plugin> make_rc_io(Hub& hub) { return std::make_unique<RcIo>(hub); }
std::unique_ptr<Plugin> make_actuator_control(Hub& hub) {
  return std::make_unique<ActuatorControlPlugin>(hub);
}

}  // namespace trident::mavros
