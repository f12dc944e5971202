// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/setpoints.h"

#include <cmath>
#include <map>

#include "core/conversions.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::is_body_frame;
using bridges::mavlink::swap_attitude;
using bridges::mavlink::swap_body;
using bridges::mavlink::swap_world;
using bridges::mavlink::swap_yaw;
using bridges::mavlink::swap_yaw_rate;

// POSITION_TARGET_TYPEMASK and ATTITUDE_TARGET_TYPEMASK.
constexpr unsigned kPosition = 7, kVelocity = 7U << 3, kAcceleration = 7U << 6;
constexpr unsigned kForceBit = 512, kYaw = 1024, kYawRate = 2048;
constexpr unsigned kRates = 7, kThrust = 64, kAttitude = 128;
constexpr double kUnitsPerDegree = 1e7;

Eigen::Vector3d swap(const Eigen::Vector3d& v, std::uint8_t frame) {
  return is_body_frame(frame) ? swap_body(v) : swap_world(v);
}
double swap_yaw_of(double yaw, std::uint8_t frame) {
  return is_body_frame(frame) ? -yaw : swap_yaw(yaw);
}

template <class Payload>
void write_motion(const LocalTarget& target, std::uint8_t frame, Payload& payload) {
  const Eigen::Vector3d v = swap(target.v_m_s, frame), a = swap(target.a_m_s2, frame);
  payload.vx = static_cast<float>(v.x());
  payload.vy = static_cast<float>(v.y());
  payload.vz = static_cast<float>(v.z());
  payload.afx = static_cast<float>(a.x());
  payload.afy = static_cast<float>(a.y());
  payload.afz = static_cast<float>(a.z());
  payload.yaw = static_cast<float>(swap_yaw_of(target.yaw, frame));
  payload.yaw_rate = static_cast<float>(swap_yaw_rate(target.yaw_rate_rad_s));
}

template <class Payload>
void read_motion_of(const Payload& payload, LocalTarget& target) {
  target.frame = payload.coordinate_frame;
  target.mask = payload.type_mask;
  target.v_m_s = swap({payload.vx, payload.vy, payload.vz}, target.frame);
  target.a_m_s2 = swap({payload.afx, payload.afy, payload.afz}, target.frame);
  target.yaw = swap_yaw_of(payload.yaw, target.frame);
  target.yaw_rate_rad_s = swap_yaw_rate(payload.yaw_rate);
}

/// The first part that counts by the mask and is no number.
std::string motion_problem(const LocalTarget& target, unsigned mask) {
  struct Part {
    unsigned bits;
    bool is_finite;
    const char* name;
  };
  const Part parts[] = {{kVelocity, target.v_m_s.allFinite(), "velocity"},
                        {kAcceleration, target.a_m_s2.allFinite(), "acceleration"},
                        {kYaw, std::isfinite(target.yaw), "yaw"},
                        {kYawRate, std::isfinite(target.yaw_rate_rad_s), "yaw rate"}};
  for (const Part& part : parts) {
    const bool counts = (mask & part.bits) != part.bits;
    if (counts && !part.is_finite) return std::string(part.name) + " is not finite";
  }
  return "";
}

}  // namespace

LocalTarget position_target(std::uint8_t frame) {
  LocalTarget target;
  target.frame = frame;
  target.mask = kVelocity | kAcceleration | kYawRate;
  return target;
}
LocalTarget velocity_target(std::uint8_t frame) {
  LocalTarget target;
  target.frame = frame;
  target.mask = kPosition | kAcceleration | kYaw;
  return target;
}
LocalTarget acceleration_target(bool is_force) {
  LocalTarget target;
  target.mask = kPosition | kVelocity | kYaw | kYawRate | (is_force ? kForceBit : 0U);
  return target;
}

bool is_local_frame(std::uint8_t frame) {
  return frame == MAV_FRAME_LOCAL_NED || frame == MAV_FRAME_LOCAL_OFFSET_NED ||
         is_body_frame(frame);
}

std::uint8_t frame_of_name(const std::string& name) {
  const std::map<std::string, std::uint8_t> frames = {
      {"LOCAL_NED", MAV_FRAME_LOCAL_NED},
      {"LOCAL_OFFSET_NED", MAV_FRAME_LOCAL_OFFSET_NED},
      {"BODY_NED", MAV_FRAME_BODY_NED},
      {"BODY_OFFSET_NED", MAV_FRAME_BODY_OFFSET_NED},
      {"BODY_FRD", MAV_FRAME_BODY_FRD}};
  const auto found = frames.find(name);
  if (found != frames.end()) return found->second;
  throw Error("mav_frame is '" + name +
              "', legal: LOCAL_NED, LOCAL_OFFSET_NED, BODY_NED, BODY_OFFSET_NED, BODY_FRD");
}

std::string problem_of(const LocalTarget& target) {
  if (!is_local_frame(target.frame)) {
    return "coordinate_frame is " + std::to_string(target.frame) + ", legal: 1, 7, 8, 9, 12";
  }
  const bool counts_p = (target.mask & kPosition) != kPosition;
  if (counts_p && !target.p_m.allFinite()) return "position is not finite";
  return motion_problem(target, target.mask);
}

std::string problem_of(const GlobalTarget& target) {
  const bool has_place = (target.mask & kPosition) != kPosition;
  if (!has_place) return motion_problem(target.motion, target.mask);
  if (!(std::abs(target.latitude_deg) <= 90.0)) {
    return "latitude is " + number_text(target.latitude_deg) + ", legal: -90 to 90";
  }
  if (!(std::abs(target.longitude_deg) <= 180.0)) {
    return "longitude is " + number_text(target.longitude_deg) + ", legal: -180 to 180";
  }
  if (!std::isfinite(target.altitude_m)) return "altitude is not finite";
  return motion_problem(target.motion, target.mask);
}

std::string problem_of(const AttitudeSetpoint& target) {
  if ((target.mask & kAttitude) == 0 && !target.R_world_body.coeffs().allFinite()) {
    return "orientation is not finite";
  }
  if ((target.mask & kRates) != kRates && !target.w_body_rad_s.allFinite()) {
    return "body rates are not finite";
  }
  const bool is_legal = target.thrust >= -1.0 && target.thrust <= 1.0;
  if ((target.mask & kThrust) == 0 && !is_legal) {
    return "thrust is " + number_text(target.thrust) + ", legal: -1 to 1";
  }
  return "";
}

mavlink_set_position_target_local_ned_t local_payload(const LocalTarget& target,
                                                      std::uint32_t time_boot_ms) {
  mavlink_set_position_target_local_ned_t payload{};
  const Eigen::Vector3d p = swap(target.p_m, target.frame);
  payload.time_boot_ms = time_boot_ms;
  payload.coordinate_frame = target.frame;
  payload.type_mask = target.mask;
  payload.x = static_cast<float>(p.x());
  payload.y = static_cast<float>(p.y());
  payload.z = static_cast<float>(p.z());
  write_motion(target, target.frame, payload);
  return payload;
}

mavlink_set_position_target_global_int_t global_payload(const GlobalTarget& target,
                                                        std::uint32_t time_boot_ms) {
  mavlink_set_position_target_global_int_t payload{};
  payload.time_boot_ms = time_boot_ms;
  payload.coordinate_frame = target.frame;
  payload.type_mask = target.mask;
  payload.lat_int = to_whole<std::int32_t>(target.latitude_deg * kUnitsPerDegree);
  payload.lon_int = to_whole<std::int32_t>(target.longitude_deg * kUnitsPerDegree);
  payload.alt = static_cast<float>(target.altitude_m);
  write_motion(target.motion, target.frame, payload);
  return payload;
}

mavlink_set_attitude_target_t attitude_payload(const AttitudeSetpoint& target,
                                               std::uint32_t time_boot_ms) {
  mavlink_set_attitude_target_t payload{};
  const Eigen::Quaterniond q = swap_attitude(target.R_world_body);
  const Eigen::Vector3d w = swap_body(target.w_body_rad_s);
  payload.time_boot_ms = time_boot_ms;
  payload.type_mask = target.mask;
  assign_q(payload, q);
  payload.body_roll_rate = static_cast<float>(w.x());
  payload.body_pitch_rate = static_cast<float>(w.y());
  payload.body_yaw_rate = static_cast<float>(w.z());
  payload.thrust = static_cast<float>(target.thrust);
  return payload;
}

LocalTarget local_target(const mavlink_position_target_local_ned_t& payload) {
  LocalTarget target;
  read_motion_of(payload, target);
  target.p_m = swap({payload.x, payload.y, payload.z}, target.frame);
  return target;
}

GlobalTarget global_target(const mavlink_position_target_global_int_t& payload) {
  GlobalTarget target;
  read_motion_of(payload, target.motion);
  target.frame = payload.coordinate_frame;
  target.mask = payload.type_mask;
  target.latitude_deg = payload.lat_int / kUnitsPerDegree;
  target.longitude_deg = payload.lon_int / kUnitsPerDegree;
  target.altitude_m = payload.alt;
  return target;
}

AttitudeSetpoint attitude_target(const mavlink_attitude_target_t& payload) {
  AttitudeSetpoint target;
  target.mask = payload.type_mask;
  target.R_world_body = swap_attitude({payload.q[0], payload.q[1], payload.q[2], payload.q[3]});
  target.w_body_rad_s =
      swap_body({payload.body_roll_rate, payload.body_pitch_rate, payload.body_yaw_rate});
  target.thrust = payload.thrust;
  return target;
}

}  // namespace trident::mavros
