// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/telemetry.h"

#include <cmath>
#include <limits>

#include "trident_base/se3.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/whole_number.h"
#include "vehicle/sensor_telemetry.h"
#include "vehicle/setpoint_telemetry.h"
#include "vehicle/status_telemetry.h"

namespace trident::bridges::mavlink {
namespace {

constexpr std::uint8_t kSatellites = 12;  // a good sky
constexpr std::uint16_t kDilution = 80;   // 100 * HDOP, 100 * VDOP

/// Of body (FRD) in the world (NED).
Eigen::Quaterniond attitude_of(const TelemetrySource& source) {
  return swap_attitude(source.state.R_world_body).normalized();
}

Message attitude(const TelemetrySource& source) {
  const Eigen::Vector3f angles = SE3{attitude_of(source), {}}.rpy().cast<float>();
  const Eigen::Vector3f w = swap_body(source.readings.w_body_rad_s).cast<float>();
  mavlink_attitude_t payload{};
  payload.time_boot_ms = source.boot_ms();
  payload.roll = angles.x();
  payload.pitch = angles.y();
  payload.yaw = angles.z();
  payload.rollspeed = w.x();
  payload.pitchspeed = w.y();
  payload.yawspeed = w.z();
  return pack(payload, source.self);
}

Message attitude_quaternion(const TelemetrySource& source) {
  const Eigen::Quaternionf q = attitude_of(source).cast<float>();
  const Eigen::Vector3f w = swap_body(source.readings.w_body_rad_s).cast<float>();
  mavlink_attitude_quaternion_t payload{};
  payload.time_boot_ms = source.boot_ms();
  payload.q1 = q.w();
  payload.q2 = q.x();
  payload.q3 = q.y();
  payload.q4 = q.z();
  payload.rollspeed = w.x();
  payload.pitchspeed = w.y();
  payload.yawspeed = w.z();
  return pack(payload, source.self);
}

Message local_position_ned(const TelemetrySource& source) {
  const Eigen::Vector3f p = swap_world(source.state.p_world_m).cast<float>();
  const Eigen::Vector3f v = swap_world(source.state.v_world_m_s).cast<float>();
  mavlink_local_position_ned_t payload{};
  payload.time_boot_ms = source.boot_ms();
  payload.x = p.x();
  payload.y = p.y();
  payload.z = p.z();
  payload.vx = v.x();
  payload.vy = v.y();
  payload.vz = v.z();
  return pack(payload, source.self);
}

template <class Payload>
void fill_geo_place(const GeoPlace& place, Payload& payload) {
  payload.lat = degrees_e7(place.latitude_deg);
  payload.lon = degrees_e7(place.longitude_deg);
  payload.alt = millimeters(place.altitude_m);
}

double height_above_home(const TelemetrySource& source) {
  return source.state.p_world_m.z() - source.autopilot.home().value_or(Eigen::Vector3d::Zero()).z();
}

Message global_position_int(const TelemetrySource& source) {
  const Eigen::Vector3d v = swap_world(source.state.v_world_m_s);
  mavlink_global_position_int_t payload{};
  payload.time_boot_ms = source.boot_ms();
  fill_geo_place(source.geo.to_geo(source.state.p_world_m), payload);
  payload.relative_alt = millimeters(height_above_home(source));
  payload.vx = centimeters(v.x());
  payload.vy = centimeters(v.y());
  payload.vz = centimeters(v.z());
  payload.hdg = centidegrees(swap_yaw(source.state.yaw()));
  return pack(payload, source.self);
}

void fill_believed(const TelemetrySource& source, mavlink_gps_raw_int_t& payload) {
  fill_geo_place(source.geo.to_geo(source.state.p_world_m), payload);
  payload.eph = payload.epv = kDilution;
  payload.fix_type = GPS_FIX_TYPE_3D_FIX;
  payload.satellites_visible = kSatellites;
}

/// False: there is no receiver.
bool fill_gnss(const std::optional<GnssReading>& gnss, mavlink_gps_raw_int_t& payload) {
  if (!gnss) return false;
  payload.time_usec = static_cast<std::uint64_t>(gnss->stamp.ns / 1000);
  payload.satellites_visible = to_whole<std::uint8_t>(gnss->satellites);
  payload.eph = payload.epv = std::numeric_limits<std::uint16_t>::max();
  payload.fix_type = GPS_FIX_TYPE_NO_FIX;
  if (!gnss->has_fix) return true;
  payload.fix_type = GPS_FIX_TYPE_3D_FIX;
  if (gnss->is_rtk_float) payload.fix_type = GPS_FIX_TYPE_RTK_FLOAT;
  if (gnss->is_rtk_fixed) payload.fix_type = GPS_FIX_TYPE_RTK_FIXED;
  fill_geo_place(gnss->place, payload);
  payload.eph = payload.epv = kDilution;
  payload.h_acc = to_whole<std::uint32_t>(1e3 * gnss->horizontal_stddev_m);
  payload.v_acc = to_whole<std::uint32_t>(1e3 * gnss->vertical_stddev_m);
  return true;
}

/// From the receiver; a vehicle without one says what it believes itself.
Message gps_raw_int(const TelemetrySource& source) {
  const Eigen::Vector3d v = source.state.v_world_m_s;
  mavlink_gps_raw_int_t payload{};
  payload.time_usec = source.boot_us();
  if (!fill_gnss(source.readings.gnss, payload)) fill_believed(source, payload);
  const double speed_m_s = v.head<2>().norm();
  payload.vel = to_whole<std::uint16_t>(100.0 * speed_m_s);
  payload.cog = centidegrees(swap_yaw(std::atan2(v.y(), v.x())));
  return pack(payload, source.self);
}

Message vfr_hud(const TelemetrySource& source) {
  mavlink_vfr_hud_t payload{};
  const Eigen::Vector3d& v = source.state.v_world_m_s;
  payload.airspeed = static_cast<float>(v.norm());
  payload.groundspeed = static_cast<float>(v.head<2>().norm());
  payload.alt = static_cast<float>(source.geo.to_geo(source.state.p_world_m).altitude_m);
  payload.climb = static_cast<float>(v.z());
  payload.heading = static_cast<std::int16_t>(centidegrees(swap_yaw(source.state.yaw())) / 100);
  return pack(payload, source.self);
}

Message altitude(const TelemetrySource& source) {
  mavlink_altitude_t payload{};
  payload.time_usec = source.boot_us();
  const auto amsl = static_cast<float>(source.geo.to_geo(source.state.p_world_m).altitude_m);
  payload.altitude_monotonic = payload.altitude_amsl = amsl;
  payload.altitude_local = static_cast<float>(source.state.p_world_m.z());
  payload.altitude_relative = static_cast<float>(height_above_home(source));
  payload.altitude_terrain = payload.bottom_clearance = std::numeric_limits<float>::quiet_NaN();
  return pack(payload, source.self);
}

Message odometry(const TelemetrySource& source) {
  const Eigen::Vector3f p = swap_world(source.state.p_world_m).cast<float>();
  const Eigen::Quaternionf q = attitude_of(source).cast<float>();
  const Eigen::Vector3d v_body = source.state.R_world_body.conjugate() * source.state.v_world_m_s;
  const Eigen::Vector3f v = swap_body(v_body).cast<float>();
  const Eigen::Vector3f w = swap_body(source.readings.w_body_rad_s).cast<float>();
  mavlink_odometry_t payload{};
  payload.time_usec = source.boot_us();
  payload.x = p.x();
  payload.y = p.y();
  payload.z = p.z();
  payload.q[0] = q.w();
  payload.q[1] = q.x();
  payload.q[2] = q.y();
  payload.q[3] = q.z();
  payload.vx = v.x();
  payload.vy = v.y();
  payload.vz = v.z();
  payload.rollspeed = w.x();
  payload.pitchspeed = w.y();
  payload.yawspeed = w.z();
  payload.pose_covariance[0] = payload.velocity_covariance[0] =
      std::numeric_limits<float>::quiet_NaN();  // not known
  payload.frame_id = MAV_FRAME_LOCAL_NED;
  payload.child_frame_id = MAV_FRAME_BODY_FRD;
  payload.estimator_type = MAV_ESTIMATOR_TYPE_AUTOPILOT;
  return pack(payload, source.self);
}

Message estimator_status(const TelemetrySource& source) {
  mavlink_estimator_status_t payload{};
  payload.time_usec = source.boot_us();
  payload.flags = ESTIMATOR_ATTITUDE | ESTIMATOR_VELOCITY_HORIZ | ESTIMATOR_VELOCITY_VERT |
                  ESTIMATOR_POS_HORIZ_REL | ESTIMATOR_POS_HORIZ_ABS | ESTIMATOR_POS_VERT_ABS |
                  ESTIMATOR_PRED_POS_HORIZ_REL | ESTIMATOR_PRED_POS_HORIZ_ABS;
  payload.pos_horiz_accuracy = static_cast<float>(source.state.position_stddev_m);
  return pack(payload, source.self);
}

/// Those that need a place.
std::optional<Message> motion_message(std::uint32_t id, const TelemetrySource& source) {
  switch (id) {
    case MAVLINK_MSG_ID_ATTITUDE:
      return attitude(source);
    case MAVLINK_MSG_ID_ATTITUDE_QUATERNION:
      return attitude_quaternion(source);
    case MAVLINK_MSG_ID_LOCAL_POSITION_NED:
      return local_position_ned(source);
    case MAVLINK_MSG_ID_GLOBAL_POSITION_INT:
      return global_position_int(source);
    case MAVLINK_MSG_ID_GPS_RAW_INT:
      return gps_raw_int(source);
    case MAVLINK_MSG_ID_VFR_HUD:
      return vfr_hud(source);
    case MAVLINK_MSG_ID_ALTITUDE:
      return altitude(source);
    case MAVLINK_MSG_ID_ODOMETRY:
      return odometry(source);
    case MAVLINK_MSG_ID_ESTIMATOR_STATUS:
      return estimator_status(source);
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<Message> telemetry_message(std::uint32_t id, const TelemetrySource& source) {
  if (const auto message = status_message(id, source)) return message;
  if (const auto message = sensor_message(id, source)) return message;
  if (!source.state.position_stamp) return std::nullopt;
  if (const auto message = setpoint_message(id, source)) return message;
  return motion_message(id, source);
}

}  // namespace trident::bridges::mavlink
