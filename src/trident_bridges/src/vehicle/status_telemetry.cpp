// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/status_telemetry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/whole_number.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kCritical = 0.07;  // of the battery's charge
// Clients call a vehicle ready that has a compass. The estimator's heading is as good.
constexpr unsigned kEstimator =
    MAV_SYS_STATUS_SENSOR_GPS | MAV_SYS_STATUS_SENSOR_3D_MAG | MAV_SYS_STATUS_AHRS;
constexpr std::uint16_t kNoVoltage = std::numeric_limits<std::uint16_t>::max();

std::uint8_t type_of(VehicleKind kind) {
  switch (kind) {
    case VehicleKind::kQuadrotor:
      return MAV_TYPE_QUADROTOR;
    case VehicleKind::kHexarotor:
      return MAV_TYPE_HEXAROTOR;
    case VehicleKind::kRover:
      return MAV_TYPE_GROUND_ROVER;
    case VehicleKind::kBoat:
      break;
  }
  return MAV_TYPE_SURFACE_BOAT;
}

std::uint8_t base_mode_of(const Autopilot& autopilot) {
  unsigned flags = MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
  if (autopilot.is_armed()) flags |= MAV_MODE_FLAG_SAFETY_ARMED;
  switch (autopilot.mode()) {
    case Mode::kManual:
    case Mode::kAcro:
      flags |= MAV_MODE_FLAG_MANUAL_INPUT_ENABLED;
      break;
    case Mode::kStabilize:
    case Mode::kAltitude:
    case Mode::kPosition:
      flags |= MAV_MODE_FLAG_MANUAL_INPUT_ENABLED | MAV_MODE_FLAG_STABILIZE_ENABLED;
      break;
    case Mode::kOffboard:
    case Mode::kGuided:
      flags |= MAV_MODE_FLAG_STABILIZE_ENABLED | MAV_MODE_FLAG_GUIDED_ENABLED;
      break;
    default:
      flags |= MAV_MODE_FLAG_STABILIZE_ENABLED | MAV_MODE_FLAG_GUIDED_ENABLED |
               MAV_MODE_FLAG_AUTO_ENABLED;
      break;
  }
  return static_cast<std::uint8_t>(flags);
}

std::uint8_t system_status_of(const TelemetrySource& source) {
  if (!source.state.position_stamp) return MAV_STATE_CALIBRATING;
  if (!source.autopilot.is_armed()) return MAV_STATE_STANDBY;
  return source.state.battery < kCritical ? MAV_STATE_CRITICAL : MAV_STATE_ACTIVE;
}

Message heartbeat(const TelemetrySource& source) {
  mavlink_heartbeat_t payload{};
  payload.type = type_of(source.kind);
  payload.autopilot =
      source.flavour == AutopilotFlavour::kPx4 ? MAV_AUTOPILOT_PX4 : MAV_AUTOPILOT_ARDUPILOTMEGA;
  payload.base_mode = base_mode_of(source.autopilot);
  payload.custom_mode = source.autopilot.custom_mode();
  payload.system_status = system_status_of(source);
  payload.mavlink_version = 3;
  return pack(payload, source.self);
}

std::int8_t percent_left(const VehicleState& state) {
  if (std::isnan(state.battery)) return -1;
  return to_whole<std::int8_t>(100.0 * std::clamp(state.battery, 0.0, 1.0));
}

std::uint16_t millivolts(double voltage_v) {
  if (!std::isfinite(voltage_v)) return kNoVoltage;
  return std::min<std::uint16_t>(to_whole<std::uint16_t>(1e3 * voltage_v), kNoVoltage - 1);
}

std::int16_t centiamperes(double current_a) {
  if (!std::isfinite(current_a)) return -1;
  return std::max<std::int16_t>(to_whole<std::int16_t>(1e2 * current_a), 0);
}

/// As bits of MAV_SYS_STATUS_SENSOR.
unsigned failing_sensors(const TelemetrySource& source) {
  const Autopilot& autopilot = source.autopilot;
  unsigned failing = 0;
  const bool can_arm = autopilot.is_armed() || autopilot.arming_problems(source.now).empty();
  if (!can_arm) failing |= MAV_SYS_STATUS_PREARM_CHECK;
  if (!source.state.position_stamp) return failing | kEstimator;
  if (autopilot.fence().breach(source.state.p_world_m)) failing |= MAV_SYS_STATUS_GEOFENCE;
  return failing;
}

Message sys_status(const TelemetrySource& source) {
  mavlink_sys_status_t payload{};
  unsigned present = MAV_SYS_STATUS_SENSOR_3D_GYRO | MAV_SYS_STATUS_SENSOR_3D_ACCEL | kEstimator |
                     MAV_SYS_STATUS_PREARM_CHECK;
  if (!std::isnan(source.state.battery)) present |= MAV_SYS_STATUS_SENSOR_BATTERY;
  present |= MAV_SYS_STATUS_GEOFENCE;
  payload.onboard_control_sensors_present = present;
  payload.onboard_control_sensors_enabled = present;
  payload.onboard_control_sensors_health = present & ~failing_sensors(source);
  payload.voltage_battery = millivolts(source.readings.voltage_V);
  payload.current_battery = centiamperes(source.readings.current_A);
  payload.battery_remaining = percent_left(source.state);
  return pack(payload, source.self);
}

Message battery_status(const TelemetrySource& source) {
  mavlink_battery_status_t payload{};
  for (int i = 0; i < 10; ++i) payload.voltages[i] = kNoVoltage;
  payload.voltages[0] = millivolts(source.readings.voltage_V);
  payload.battery_function = MAV_BATTERY_FUNCTION_ALL;
  payload.type = MAV_BATTERY_TYPE_LIPO;
  payload.temperature = std::numeric_limits<std::int16_t>::max();
  payload.current_battery = centiamperes(source.readings.current_A);
  payload.current_consumed = -1;
  payload.energy_consumed = -1;
  payload.battery_remaining = percent_left(source.state);
  return pack(payload, source.self);
}

Message extended_sys_state(const TelemetrySource& source) {
  mavlink_extended_sys_state_t payload{};
  const bool is_landed = source.autopilot.is_landed();
  const bool lands = source.autopilot.mode() == Mode::kLand;
  payload.landed_state = is_landed ? MAV_LANDED_STATE_ON_GROUND
                                   : (lands ? MAV_LANDED_STATE_LANDING : MAV_LANDED_STATE_IN_AIR);
  return pack(payload, source.self);
}

Message system_time(const TelemetrySource& source) {
  mavlink_system_time_t payload{};
  payload.time_unix_usec = static_cast<std::uint64_t>(source.clock.unix_ns_at(source.now) / 1000);
  payload.time_boot_ms = source.boot_ms();
  return pack(payload, source.self);
}

bool has_ended(const MissionExecutor& mission) {
  return mission.size() > 0 && mission.current() == mission.size();
}

std::uint8_t mission_state(const MissionExecutor& mission, bool is_active) {
  if (mission.size() == 0) return MISSION_STATE_NO_MISSION;
  if (has_ended(mission)) return MISSION_STATE_COMPLETE;
  if (is_active) return MISSION_STATE_ACTIVE;
  return mission.current() == 0 ? MISSION_STATE_NOT_STARTED : MISSION_STATE_PAUSED;
}

Message mission_current(const TelemetrySource& source) {
  const MissionExecutor& mission = source.autopilot.mission();
  mavlink_mission_current_t payload{};
  const bool is_complete = has_ended(mission);
  payload.seq = static_cast<std::uint16_t>(is_complete ? mission.size() - 1 : mission.current());
  payload.total = static_cast<std::uint16_t>(mission.size());
  const bool is_active = source.autopilot.is_armed() && source.autopilot.mode() == Mode::kMission;
  payload.mission_state = mission_state(mission, is_active);
  payload.mission_mode = is_active ? 1 : 2;
  return pack(payload, source.self);
}

template <class Payload>
void fill_place(const GeoPlace& place, const TelemetrySource& source, Payload& payload) {
  payload.latitude = degrees_e7(place.latitude_deg);
  payload.longitude = degrees_e7(place.longitude_deg);
  payload.altitude = millimeters(place.altitude_m);
  payload.time_usec = source.boot_us();
}

std::optional<Message> home_position(const TelemetrySource& source) {
  const auto& home = source.autopilot.home();
  if (!home) return std::nullopt;
  mavlink_home_position_t payload{};
  fill_place(source.geo.to_geo(*home), source, payload);
  const Eigen::Vector3f ned = swap_world(*home).cast<float>();
  payload.x = ned.x();
  payload.y = ned.y();
  payload.z = ned.z();
  for (int i = 0; i < 4; ++i) payload.q[i] = std::numeric_limits<float>::quiet_NaN();
  return pack(payload, source.self);
}

Message gps_global_origin(const TelemetrySource& source) {
  mavlink_gps_global_origin_t payload{};
  fill_place(source.geo.origin(), source, payload);
  return pack(payload, source.self);
}

}  // namespace

std::optional<Message> status_message(std::uint32_t id, const TelemetrySource& source) {
  switch (id) {
    case MAVLINK_MSG_ID_HEARTBEAT:
      return heartbeat(source);
    case MAVLINK_MSG_ID_SYS_STATUS:
      return sys_status(source);
    case MAVLINK_MSG_ID_BATTERY_STATUS:
      return battery_status(source);
    case MAVLINK_MSG_ID_EXTENDED_SYS_STATE:
      return extended_sys_state(source);
    case MAVLINK_MSG_ID_SYSTEM_TIME:
      return system_time(source);
    case MAVLINK_MSG_ID_MISSION_CURRENT:
      return mission_current(source);
    case MAVLINK_MSG_ID_HOME_POSITION:
      return home_position(source);
    case MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN:
      return gps_global_origin(source);
    default:
      return std::nullopt;
  }
}

}  // namespace trident::bridges::mavlink
