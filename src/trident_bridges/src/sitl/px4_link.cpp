// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/sitl/px4_link.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/packet.h"
#include "trident_bridges/mavlink/whole_number.h"

namespace trident::bridges::sitl {
namespace {

using mavlink::pack;
using mavlink::to_whole;

constexpr mavlink::Address kSimulator{1, 200};  ///< as PX4's own plugin for Gazebo has it
constexpr double kStandardGravity = 9.80665;    ///< [m/s^2]

void set_xyz(const Eigen::Vector3d& v, float& x, float& y, float& z) {
  x = static_cast<float>(v.x());
  y = static_cast<float>(v.y());
  z = static_cast<float>(v.z());
}

}  // namespace

void Px4Link::connected() {
  is_connected_ = was_connected_ = true;
  is_given_up_ = has_answered_ = asked_.is_open = false;
  asked_.count = 0;
  parser_ = mavlink::PacketParser{};
  writer_ = mavlink::PacketWriter{};
}

void Px4Link::disconnected() { is_connected_ = has_answered_ = asked_.is_open = false; }

void Px4Link::give_up() {
  is_given_up_ = true;
  asked_.is_open = false;
}

void Px4Link::received(mavlink::Bytes bytes) {
  parser_.feed(bytes);
  while (const auto packet = parser_.next()) {
    if (!packet->is_known) continue;
    const mavlink::Message message = to_message(*packet);
    if (mavlink::is<mavlink_hil_actuator_controls_t>(message)) take_answer(message);
  }
}

/// PX4 answers with the time that HIL_SENSOR gave it. An answer to an earlier one came too late for
/// its step; a time that is not ours says nothing, and the answer counts.
void Px4Link::take_answer(const mavlink::Message& message) {
  const auto answer = mavlink::unpack<mavlink_hil_actuator_controls_t>(message);
  if (asked_.count == 0) return;  // to a connection before this one
  if (answer.time_usec >= asked_.first_us && answer.time_usec < asked_.newest_us) {
    ++stale_answers_;
    return;
  }
  std::copy(std::begin(answer.controls), std::end(answer.controls), controls_.values.begin());
  controls_.is_armed = (answer.mode & MAV_MODE_FLAG_SAFETY_ARMED) != 0;
  ++controls_.count;
  has_answered_ = true;
  asked_.is_open = is_given_up_ = false;
}

std::uint64_t Px4Link::growing_us(SimTime now, bool* has_jumped) {
  const std::int64_t us = now.ns / 1000;
  *has_jumped = newest_us_ > 0 && us + shift_us_ <= static_cast<std::int64_t>(newest_us_);
  if (*has_jumped) shift_us_ = static_cast<std::int64_t>(newest_us_) + 1000 - us;
  newest_us_ = static_cast<std::uint64_t>(us + shift_us_);
  return newest_us_;
}

void Px4Link::send_sensor(SimTime now, const HilSensor& sensor, double wall_s) {
  if (!is_connected_) return;
  bool has_jumped = false;
  mavlink_hil_sensor_t out{};
  out.time_usec = growing_us(now, &has_jumped);
  set_xyz(sensor.a_frd, out.xacc, out.yacc, out.zacc);
  set_xyz(sensor.w_frd, out.xgyro, out.ygyro, out.zgyro);
  set_xyz(sensor.magnetic_frd_gauss, out.xmag, out.ymag, out.zmag);
  out.abs_pressure = static_cast<float>(sensor.pressure_hpa);
  out.diff_pressure = static_cast<float>(sensor.differential_pressure_hpa);
  out.pressure_alt = static_cast<float>(sensor.pressure_altitude_m);
  out.temperature = static_cast<float>(sensor.temperature_c);
  out.fields_updated = sensor.fields | (has_jumped ? HilSensor::kReset : 0U);
  if (asked_.count++ == 0) asked_.first_us = out.time_usec;
  asked_.at = now;
  asked_.newest_us = out.time_usec;
  asked_.wall_s = wall_s;
  asked_.is_open = true;
  write(pack(out, kSimulator));
}

void Px4Link::send_gps(SimTime stamp, const HilGps& gps) {
  if (!is_connected_) return;
  mavlink_hil_gps_t out{};
  out.time_usec =
      static_cast<std::uint64_t>(std::max<std::int64_t>(0, stamp.ns / 1000 + shift_us_));
  out.fix_type = GPS_FIX_TYPE_3D_FIX;
  out.lat = mavlink::degrees_e7(gps.latitude_deg);
  out.lon = mavlink::degrees_e7(gps.longitude_deg);
  out.alt = mavlink::millimeters(gps.altitude_m);
  out.eph = to_whole<std::uint16_t>(gps.horizontal_error_m * 100.0);
  out.epv = to_whole<std::uint16_t>(gps.vertical_error_m * 100.0);
  out.vel = to_whole<std::uint16_t>(gps.v_ned.head<2>().norm() * 100.0);
  out.vn = mavlink::centimeters(gps.v_ned.x());
  out.ve = mavlink::centimeters(gps.v_ned.y());
  out.vd = mavlink::centimeters(gps.v_ned.z());
  out.cog = mavlink::centidegrees(std::atan2(gps.v_ned.y(), gps.v_ned.x()));
  out.satellites_visible = to_whole<std::uint8_t>(gps.satellites);
  write(pack(out, kSimulator));
}

void Px4Link::send_state(SimTime now, const HilState& state) {
  if (!is_connected_) return;
  mavlink_hil_state_quaternion_t out{};
  out.time_usec = static_cast<std::uint64_t>(std::max<std::int64_t>(0, now.ns / 1000 + shift_us_));
  const double q[] = {state.R_ned_frd.w(), state.R_ned_frd.x(), state.R_ned_frd.y(),
                      state.R_ned_frd.z()};
  std::transform(std::begin(q), std::end(q), std::begin(out.attitude_quaternion),
                 [](double x) { return static_cast<float>(x); });
  set_xyz(state.w_frd, out.rollspeed, out.pitchspeed, out.yawspeed);
  out.lat = mavlink::degrees_e7(state.latitude_deg);
  out.lon = mavlink::degrees_e7(state.longitude_deg);
  out.alt = mavlink::millimeters(state.altitude_m);
  out.vx = mavlink::centimeters(state.v_ned.x());
  out.vy = mavlink::centimeters(state.v_ned.y());
  out.vz = mavlink::centimeters(state.v_ned.z());
  out.ind_airspeed = out.true_airspeed = to_whole<std::uint16_t>(state.airspeed_m_s * 100.0);
  const Eigen::Vector3d milli_g = state.a_frd * (1000.0 / kStandardGravity);
  out.xacc = to_whole<std::int16_t>(milli_g.x());
  out.yacc = to_whole<std::int16_t>(milli_g.y());
  out.zacc = to_whole<std::int16_t>(milli_g.z());
  write(pack(out, kSimulator));
}

bool Px4Link::runs_free() const {
  return is_connected_ && asked_.count > 1 && (!lockstep_ || !has_answered_);
}

bool Px4Link::is_awaited(double wall_s) const {
  if (!lockstep_ || is_given_up_) return false;
  if (!is_connected_) return true;
  if (!asked_.is_open) return false;
  if (has_answered_) return true;
  return wall_s - asked_.wall_s < (asked_.count == 1 ? kFirstPatience_s : free_period_s_);
}

}  // namespace trident::bridges::sitl
