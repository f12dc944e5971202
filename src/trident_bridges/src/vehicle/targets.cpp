// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/targets.h"

#include <cmath>

#include "trident_base/string_util.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/mission.h"

namespace trident::bridges::mavlink {
namespace {

// Bits of type_mask of SET_POSITION_TARGET_*: POSITION_TARGET_TYPEMASK.
constexpr unsigned kNoPosition = 7, kNoVelocity = 7U << 3, kNoAcceleration = 7U << 6;
constexpr unsigned kForce = 512, kNoYaw = 1024, kNoYawRate = 2048;
// Of SET_ATTITUDE_TARGET: ATTITUDE_TARGET_TYPEMASK.
constexpr unsigned kNoRollPitchRate = 3, kNoRates = 7, kNoThrust = 64, kNoAttitude = 128;
constexpr double kUnits_per_degree = 1e7;

/// Whether a part counts; a problem where only some of its axes do.
bool is_given(unsigned mask, unsigned bits, const char* part, std::string& problem) {
  const unsigned ignored = mask & bits;
  if (ignored != 0 && ignored != bits) {
    problem = std::string("set-point: type_mask ") + std::to_string(mask) +
              " ignores some axes of " + part + ", legal: all or none";
  }
  return ignored == 0;
}

bool is_local_frame(std::uint8_t frame) {
  return frame == MAV_FRAME_LOCAL_NED || frame == MAV_FRAME_LOCAL_OFFSET_NED ||
         is_body_frame(frame);
}

std::optional<SimTime> stamp_of(std::uint32_t time_boot_ms) {
  if (time_boot_ms == 0) return std::nullopt;
  return SimTime{std::int64_t{time_boot_ms} * 1'000'000};
}

template <class Payload>
void read_derivatives(const Payload& payload, double yaw, ReceivedTarget& received) {
  const unsigned mask = payload.type_mask;
  const std::uint8_t frame = payload.coordinate_frame;
  Target& target = received.target;
  if (is_given(mask, kNoVelocity, "velocity", received.problem)) {
    target.v_m_s = direction_in_world(frame, {payload.vx, payload.vy, payload.vz}, yaw);
  }
  if (is_given(mask, kNoAcceleration, "acceleration", received.problem)) {
    target.a_m_s2 = direction_in_world(frame, {payload.afx, payload.afy, payload.afz}, yaw);
  }
  if (target.a_m_s2 && (mask & kForce) != 0) {
    received.problem = "set-point: forces (type_mask bit 9) are not supported";
  }
}

template <class Payload>
void read_heading(const Payload& payload, double yaw, Target& target) {
  if ((payload.type_mask & kNoYaw) == 0) {
    target.yaw = is_body_frame(payload.coordinate_frame) ? wrap_to_pi(yaw - payload.yaw)
                                                         : swap_yaw(payload.yaw);
  }
  if ((payload.type_mask & kNoYawRate) == 0) target.yaw_rate = swap_yaw_rate(payload.yaw_rate);
}

bool is_empty(const Target& target) {
  const bool moves = target.p_m || target.v_m_s || target.a_m_s2;
  return !moves && !target.yaw && !target.yaw_rate;
}

/// All but the place, which its caller has read.
template <class Payload>
void read_motion(const Payload& payload, const PlaceContext& context, ReceivedTarget& received) {
  read_derivatives(payload, context.yaw, received);
  read_heading(payload, context.yaw, received.target);
  if (is_empty(received.target) && received.problem.empty()) {
    received.problem =
        "set-point: type_mask " + std::to_string(payload.type_mask) + " ignores everything";
  }
}

/// `has_places`: whether this message may have the frame.
template <class Payload>
ReceivedTarget read_place_target(const Payload& payload, const Eigen::Vector3d& numbers,
                                 bool has_places, const PlaceContext& context) {
  ReceivedTarget received;
  received.stamp = stamp_of(payload.time_boot_ms);
  if (!has_places) {
    received.problem = "set-point: frame " + std::to_string(payload.coordinate_frame) +
                       " is not one of this message";
    return received;
  }
  if (is_given(payload.type_mask, kNoPosition, "position", received.problem)) {
    received.target.p_m = place_in_world(payload.coordinate_frame, numbers, context);
  }
  read_motion(payload, context, received);
  return received;
}

/// False: the quaternion is no rotation.
bool read_rotation(const mavlink_set_attitude_target_t& payload, ReceivedTarget& received) {
  if ((payload.type_mask & kNoAttitude) != 0) return true;
  Eigen::Quaterniond q(payload.q[0], payload.q[1], payload.q[2], payload.q[3]);
  if (!(q.norm() > 0.5 && q.norm() < 2.0)) {
    received.problem = "set-point: norm of q is " + number_text(q.norm()) + ", legal: 1";
    return false;
  }
  q.normalize();
  received.target.R_world_body = swap_attitude(q);
  return true;
}

void read_rates(const mavlink_set_attitude_target_t& payload, ReceivedTarget& received) {
  const unsigned mask = payload.type_mask;
  const Eigen::Vector3d rates(payload.body_roll_rate, payload.body_pitch_rate,
                              payload.body_yaw_rate);
  if ((mask & kNoRates) == kNoRollPitchRate) {
    received.target.yaw_rate = swap_yaw_rate(payload.body_yaw_rate);
  } else if (is_given(mask, kNoRates, "body rates", received.problem)) {
    received.target.w_body_rad_s = swap_body(rates);
  }
}

/// False: it is missing, and without it nothing can be followed.
bool read_thrust(const mavlink_set_attitude_target_t& payload, ReceivedTarget& received) {
  if ((payload.type_mask & kNoThrust) != 0) {
    received.problem = "set-point: attitude and rates need a thrust (type_mask bit 6 is set)";
    return false;
  }
  received.target.thrust = payload.thrust;
  if (!(payload.thrust >= 0.0F && payload.thrust <= 1.0F)) {
    received.problem = "set-point: thrust " + number_text(payload.thrust) + ", legal: 0 to 1";
  }
  return true;
}

void read_attitude(const mavlink_set_attitude_target_t& payload, ReceivedTarget& received) {
  if (!read_rotation(payload, received)) return;
  read_rates(payload, received);
  if (!read_thrust(payload, received)) return;
  const Target& target = received.target;
  if (!target.R_world_body && !target.w_body_rad_s && received.problem.empty()) {
    received.problem = "set-point: type_mask " + std::to_string(payload.type_mask) +
                       " ignores both attitude and rates";
  }
}

}  // namespace

std::optional<ReceivedTarget> read_target(const Message& message, Address self,
                                          const PlaceContext& context) {
  if (const auto payload = unpack_if_for<mavlink_set_position_target_local_ned_t>(message, self)) {
    return read_place_target(*payload, {payload->x, payload->y, payload->z},
                             is_local_frame(payload->coordinate_frame), context);
  }
  if (const auto payload = unpack_if_for<mavlink_set_position_target_global_int_t>(message, self)) {
    const Eigen::Vector3d place(payload->lat_int / kUnits_per_degree,
                                payload->lon_int / kUnits_per_degree, payload->alt);
    return read_place_target(*payload, place, is_global_frame(payload->coordinate_frame), context);
  }
  const auto payload = unpack_if_for<mavlink_set_attitude_target_t>(message, self);
  if (!payload) return std::nullopt;
  ReceivedTarget received;
  received.stamp = stamp_of(payload->time_boot_ms);
  read_attitude(*payload, received);
  return received;
}

}  // namespace trident::bridges::mavlink
