// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/HilActuatorControls.h>
#include <mavros_msgs/HilControls.h>
#include <mavros_msgs/HilGPS.h>
#include <mavros_msgs/HilSensor.h>
#include <mavros_msgs/HilStateQuaternion.h>
#include <mavros_msgs/OpticalFlowRad.h>
#include <mavros_msgs/RCIn.h>

#include <algorithm>
#include <cmath>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/optical_flow.h"
#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::swap_attitude;
using bridges::mavlink::swap_body;
using bridges::mavlink::swap_world;

constexpr double kHilUnitsPerDegree = 1e7, kHilPerMeter = 1e3, kCentiPerUnit = 100.0;
constexpr double kMilliGravities = 1e3 / 9.80665, kGaussPerTesla = 1e4;

std::uint64_t hil_time(const std_msgs::Header& header) { return header.stamp.toNSec() / 1000; }

/// What a simulator says to an autopilot in the loop, and the controls that come back.
class Hil : public Plugin {
 public:
  explicit Hil(Hub& hub) : vehicle_(hub.vehicle) {
    RosSide& ros = hub.ros;
    controls_ = ros.advertise<mavros_msgs::HilControls>("hil/controls");
    actuators_ = ros.advertise<mavros_msgs::HilActuatorControls>("hil/actuator_controls");
    on<mavlink_hil_controls_t>(vehicle_, [this](const auto& p) { publish(p); });
    on<mavlink_hil_actuator_controls_t>(vehicle_, [this](const auto& p) { publish(p); });
    ros.subscribe<mavros_msgs::HilStateQuaternion>("hil/state",
                                                   [this](const auto& m) { send_state(m); });
    ros.subscribe<mavros_msgs::HilGPS>("hil/gps", [this](const auto& m) { send_gps(m); });
    ros.subscribe<mavros_msgs::HilSensor>("hil/imu_ned", [this](const auto& m) { send_imu(m); });
    ros.subscribe<mavros_msgs::OpticalFlowRad>("hil/optical_flow",
                                               [this](const auto& m) { send_flow(m); });
    ros.subscribe<mavros_msgs::RCIn>("hil/rc_inputs", [this](const auto& m) { send_sticks(m); });
  }

 private:
  void publish(const mavlink_hil_controls_t& p) {
    mavros_msgs::HilControls m;
    m.header.stamp = vehicle_.stamp_us(p.time_usec);
    m.roll_ailerons = p.roll_ailerons;
    m.pitch_elevator = p.pitch_elevator;
    m.yaw_rudder = p.yaw_rudder;
    m.throttle = p.throttle;
    m.aux1 = p.aux1;
    m.aux2 = p.aux2;
    m.aux3 = p.aux3;
    m.aux4 = p.aux4;
    m.mode = p.mode;
    m.nav_mode = p.nav_mode;
    controls_->publish(m);
  }
  void publish(const mavlink_hil_actuator_controls_t& p) {
    mavros_msgs::HilActuatorControls m;
    m.header.stamp = vehicle_.stamp_us(p.time_usec);
    std::copy(std::begin(p.controls), std::end(p.controls), m.controls.begin());
    m.mode = p.mode;
    m.flags = p.flags;
    actuators_->publish(m);
  }

  void send_state(const mavros_msgs::HilStateQuaternion& m) {
    const Eigen::Quaterniond q = swap_attitude(to_rotation(m.orientation));
    const Eigen::Vector3d w = swap_body(to_eigen(m.angular_velocity));
    const Eigen::Vector3d v = swap_world(to_eigen(m.linear_velocity)) * kCentiPerUnit;
    const Eigen::Vector3d a = swap_body(to_eigen(m.linear_acceleration)) * kMilliGravities;
    mavlink_hil_state_quaternion_t payload{};
    payload.time_usec = hil_time(m.header);
    payload.attitude_quaternion[0] = static_cast<float>(q.w());
    payload.attitude_quaternion[1] = static_cast<float>(q.x());
    payload.attitude_quaternion[2] = static_cast<float>(q.y());
    payload.attitude_quaternion[3] = static_cast<float>(q.z());
    payload.rollspeed = static_cast<float>(w.x());
    payload.pitchspeed = static_cast<float>(w.y());
    payload.yawspeed = static_cast<float>(w.z());
    payload.lat = to_whole<std::int32_t>(m.geo.latitude * kHilUnitsPerDegree);
    payload.lon = to_whole<std::int32_t>(m.geo.longitude * kHilUnitsPerDegree);
    payload.alt = to_whole<std::int32_t>(m.geo.altitude * kHilPerMeter);
    payload.vx = to_whole<std::int16_t>(v.x());
    payload.vy = to_whole<std::int16_t>(v.y());
    payload.vz = to_whole<std::int16_t>(v.z());
    payload.ind_airspeed = to_whole<std::uint16_t>(m.ind_airspeed * kCentiPerUnit);
    payload.true_airspeed = to_whole<std::uint16_t>(m.true_airspeed * kCentiPerUnit);
    payload.xacc = to_whole<std::int16_t>(a.x());
    payload.yacc = to_whole<std::int16_t>(a.y());
    payload.zacc = to_whole<std::int16_t>(a.z());
    send(vehicle_, payload);
  }

  void send_gps(const mavros_msgs::HilGPS& m) {
    mavlink_hil_gps_t payload{};
    payload.time_usec = hil_time(m.header);
    payload.fix_type = m.fix_type;
    payload.lat = to_whole<std::int32_t>(m.geo.latitude * kHilUnitsPerDegree);
    payload.lon = to_whole<std::int32_t>(m.geo.longitude * kHilUnitsPerDegree);
    payload.alt = to_whole<std::int32_t>(m.geo.altitude * kHilPerMeter);
    payload.eph = m.eph;
    payload.epv = m.epv;
    payload.vel = m.vel;
    payload.vn = m.vn;
    payload.ve = m.ve;
    payload.vd = m.vd;
    payload.cog = m.cog;
    payload.satellites_visible = m.satellites_visible;
    send(vehicle_, payload);
  }

  void send_imu(const mavros_msgs::HilSensor& m) {
    const Eigen::Vector3d a = swap_body(to_eigen(m.acc)), w = swap_body(to_eigen(m.gyro));
    const Eigen::Vector3d field = swap_body(to_eigen(m.mag)) * kGaussPerTesla;
    mavlink_hil_sensor_t payload{};
    payload.time_usec = hil_time(m.header);
    payload.xacc = static_cast<float>(a.x());
    payload.yacc = static_cast<float>(a.y());
    payload.zacc = static_cast<float>(a.z());
    payload.xgyro = static_cast<float>(w.x());
    payload.ygyro = static_cast<float>(w.y());
    payload.zgyro = static_cast<float>(w.z());
    payload.xmag = static_cast<float>(field.x());
    payload.ymag = static_cast<float>(field.y());
    payload.zmag = static_cast<float>(field.z());
    payload.abs_pressure = m.abs_pressure;
    payload.diff_pressure = m.diff_pressure;
    payload.pressure_alt = m.pressure_alt;
    payload.temperature = m.temperature;
    payload.fields_updated = m.fields_updated;
    send(vehicle_, payload);
  }

  void send_flow(const mavros_msgs::OpticalFlowRad& m) {
    mavlink_hil_optical_flow_t payload{};
    payload.time_usec = hil_time(m.header);
    copy_flow(m, payload);
    send(vehicle_, payload);
  }

  void send_sticks(const mavros_msgs::RCIn& m) {
    std::array<std::uint16_t, 12> c{};
    std::copy_n(m.channels.begin(), std::min(m.channels.size(), c.size()), c.begin());
    mavlink_hil_rc_inputs_raw_t payload{};
    payload.time_usec = hil_time(m.header);
    payload.chan1_raw = c[0];
    payload.chan2_raw = c[1];
    payload.chan3_raw = c[2];
    payload.chan4_raw = c[3];
    payload.chan5_raw = c[4];
    payload.chan6_raw = c[5];
    payload.chan7_raw = c[6];
    payload.chan8_raw = c[7];
    payload.chan9_raw = c[8];
    payload.chan10_raw = c[9];
    payload.chan11_raw = c[10];
    payload.chan12_raw = c[11];
    payload.rssi = m.rssi;
    send(vehicle_, payload);
  }

  VehicleSide& vehicle_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::HilControls>> controls_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::HilActuatorControls>> actuators_;
};

}  // namespace

std::unique_ptr<Plugin> make_hil(Hub& hub) { return std::make_unique<Hil>(hub); }

}  // namespace trident::mavros
