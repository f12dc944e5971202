// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/setpoint_telemetry.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/whole_number.h"

namespace trident::bridges::mavlink {
namespace {

using Kind = Setpoint::Kind;

std::optional<Message> position_target(const TelemetrySource& source) {
  const Setpoint& setpoint = source.autopilot.setpoint();
  const bool is_trajectory = setpoint.kind == Kind::kTrajectory;
  if (!is_trajectory && setpoint.kind != Kind::kLeg && setpoint.kind != Kind::kStation) return {};
  const Eigen::Vector3f p = swap_world(setpoint.p_m).cast<float>();
  const Eigen::Vector3f v = swap_world(setpoint.v_m_s).cast<float>();
  const Eigen::Vector3f a = swap_world(setpoint.a_m_s2).cast<float>();
  constexpr unsigned kPlaceAlone =
      POSITION_TARGET_TYPEMASK_VX_IGNORE | POSITION_TARGET_TYPEMASK_VY_IGNORE |
      POSITION_TARGET_TYPEMASK_VZ_IGNORE | POSITION_TARGET_TYPEMASK_AX_IGNORE |
      POSITION_TARGET_TYPEMASK_AY_IGNORE | POSITION_TARGET_TYPEMASK_AZ_IGNORE |
      POSITION_TARGET_TYPEMASK_YAW_IGNORE | POSITION_TARGET_TYPEMASK_YAW_RATE_IGNORE;
  mavlink_position_target_local_ned_t payload{};
  payload.time_boot_ms = source.boot_ms();
  payload.coordinate_frame = MAV_FRAME_LOCAL_NED;
  payload.type_mask = is_trajectory ? 0 : static_cast<std::uint16_t>(kPlaceAlone);
  payload.x = p.x();
  payload.y = p.y();
  payload.z = p.z();
  payload.vx = v.x();
  payload.vy = v.y();
  payload.vz = v.z();
  payload.afx = a.x();
  payload.afy = a.y();
  payload.afz = a.z();
  payload.yaw = static_cast<float>(swap_yaw(setpoint.yaw));
  payload.yaw_rate = static_cast<float>(swap_yaw_rate(setpoint.yaw_rate));
  return pack(payload, source.self);
}

std::optional<Message> attitude_target(const TelemetrySource& source) {
  const Setpoint& setpoint = source.autopilot.setpoint();
  const bool is_attitude = setpoint.kind == Kind::kAttitude;
  if (!is_attitude && setpoint.kind != Kind::kRates) return std::nullopt;
  const Eigen::Quaternionf q = swap_attitude(setpoint.R_world_body).normalized().cast<float>();
  const Eigen::Vector3f w = swap_body(setpoint.w_body_rad_s).cast<float>();
  constexpr unsigned kNoRates = ATTITUDE_TARGET_TYPEMASK_BODY_ROLL_RATE_IGNORE |
                                ATTITUDE_TARGET_TYPEMASK_BODY_PITCH_RATE_IGNORE;
  mavlink_attitude_target_t payload{};
  payload.time_boot_ms = source.boot_ms();
  payload.type_mask = static_cast<std::uint8_t>(
      is_attitude ? kNoRates : unsigned{ATTITUDE_TARGET_TYPEMASK_ATTITUDE_IGNORE});
  payload.q[0] = q.w();
  payload.q[1] = q.x();
  payload.q[2] = q.y();
  payload.q[3] = q.z();
  payload.body_roll_rate = w.x();
  payload.body_pitch_rate = w.y();
  payload.body_yaw_rate =
      is_attitude ? static_cast<float>(swap_yaw_rate(setpoint.yaw_rate)) : w.z();
  payload.thrust = static_cast<float>(setpoint.thrust);
  return pack(payload, source.self);
}

/// Where the current item of a mission leads, if it does.
std::optional<Eigen::Vector3d> place_of_current(const MissionExecutor& mission) {
  if (mission.current() >= mission.size()) return std::nullopt;
  const auto& item = mission.items()[static_cast<std::size_t>(mission.current())];
  if (!item.has_place || !is_navigation(item.command)) return std::nullopt;
  return item.p_world_m;
}

/// Where the mode leads, if it does.
std::optional<Eigen::Vector3d> destination_of_mode(const Autopilot& autopilot) {
  if (autopilot.mode() == Mode::kMission) return place_of_current(autopilot.mission());
  if (autopilot.mode() == Mode::kReturn) return autopilot.home();
  return std::nullopt;
}

/// Where a vehicle goes, if it does.
std::optional<Eigen::Vector3d> destination(const TelemetrySource& source) {
  if (!source.autopilot.is_armed()) return std::nullopt;
  if (auto place = destination_of_mode(source.autopilot)) return place;
  const Setpoint& setpoint = source.autopilot.setpoint();
  if (setpoint.kind == Kind::kLeg || setpoint.kind == Kind::kTrajectory) return setpoint.p_m;
  return std::nullopt;
}

std::int16_t degrees_of(double yaw_from_east) {
  return to_whole<std::int16_t>(rad_to_deg(swap_yaw(yaw_from_east)));
}

std::optional<Message> nav_controller_output(const TelemetrySource& source) {
  const auto goal = destination(source);
  if (!goal) return std::nullopt;
  const Eigen::Vector3d to_go = *goal - source.state.p_world_m;
  mavlink_nav_controller_output_t payload{};
  payload.target_bearing = degrees_of(std::atan2(to_go.y(), to_go.x()));
  payload.nav_bearing = payload.target_bearing;
  payload.wp_dist = to_whole<std::uint16_t>(to_go.head<2>().norm());
  payload.alt_error = static_cast<float>(to_go.z());
  return pack(payload, source.self);
}

}  // namespace

std::optional<Message> setpoint_message(std::uint32_t id, const TelemetrySource& source) {
  switch (id) {
    case MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED:
      return position_target(source);
    case MAVLINK_MSG_ID_ATTITUDE_TARGET:
      return attitude_target(source);
    case MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT:
      return nav_controller_output(source);
    default:
      return std::nullopt;
  }
}

}  // namespace trident::bridges::mavlink
