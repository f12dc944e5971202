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

std::optional<SimTime> stamp_of(std::uint32_t time_boot_ms) {
  if (time_boot_ms == 0) return std::nullopt;
  return SimTime{std::int64_t{time_boot_ms} * 1'000'000};
}

/// All but the place, which its caller has read.
template <class Payload>
void read_motion(const Payload& payload, const PlaceContext& context, ReceivedTarget& received) {
  const unsigned mask = payload.type_mask;
  const std::uint8_t frame = payload.coordinate_frame;
  Target& target = received.target;
  std::string& problem = received.problem;
  if (is_given(mask, kNoVelocity, "velocity", problem)) {
    target.v_m_s = direction_in_world(frame, {payload.vx, payload.vy, payload.vz}, context.yaw);
  }
  if (is_given(mask, kNoAcceleration, "acceleration", problem)) {
    target.a_m_s2 = direction_in_world(frame, {payload.afx, payload.afy, payload.afz}, context.yaw);
  }
  if (target.a_m_s2 && (mask & kForce) != 0) {
    problem = "set-point: forces (type_mask bit 9) are not supported";
  }
  if ((mask & kNoYaw) == 0) {
    target.yaw =
        is_body_frame(frame) ? wrap_to_pi(context.yaw - payload.yaw) : swap_yaw(payload.yaw);
  }
  if ((mask & kNoYawRate) == 0) target.yaw_rate = swap_yaw_rate(payload.yaw_rate);
  const bool is_empty = !target.p_m && !target.v_m_s && !target.a_m_s2;
  if (is_empty && !target.yaw && !target.yaw_rate && problem.empty()) {
    problem = "set-point: type_mask " + std::to_string(mask) + " ignores everything";
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

void read_attitude(const mavlink_set_attitude_target_t& payload, ReceivedTarget& received) {
  const unsigned mask = payload.type_mask;
  Target& target = received.target;
  if ((mask & kNoAttitude) == 0) {
    Eigen::Quaterniond q(payload.q[0], payload.q[1], payload.q[2], payload.q[3]);
    if (!(q.norm() > 0.5 && q.norm() < 2.0)) {
      received.problem = "set-point: norm of q is " + number_text(q.norm()) + ", legal: 1";
      return;
    }
    q.normalize();
    target.R_world_body = swap_attitude(q);
  }
  const Eigen::Vector3d rates(payload.body_roll_rate, payload.body_pitch_rate,
                              payload.body_yaw_rate);
  if ((mask & kNoRates) == kNoRollPitchRate) {
    target.yaw_rate = swap_yaw_rate(payload.body_yaw_rate);
  } else if (is_given(mask, kNoRates, "body rates", received.problem)) {
    target.w_body_rad_s = swap_body(rates);
  }
  if ((mask & kNoThrust) != 0) {
    received.problem = "set-point: attitude and rates need a thrust (type_mask bit 6 is set)";
    return;
  }
  target.thrust = payload.thrust;
  if (!target.R_world_body && !target.w_body_rad_s && received.problem.empty()) {
    received.problem =
        "set-point: type_mask " + std::to_string(mask) + " ignores both attitude and rates";
  }
  if (!(payload.thrust >= 0.0F && payload.thrust <= 1.0F)) {
    received.problem = "set-point: thrust " + number_text(payload.thrust) + ", legal: 0 to 1";
  }
}

}  // namespace

std::optional<ReceivedTarget> read_target(const Message& message, Address self,
                                          const PlaceContext& context) {
  const auto is_mine = [&](const auto& payload) {
    return is_for({payload.target_system, payload.target_component}, self);
  };
  if (is<mavlink_set_position_target_local_ned_t>(message)) {
    const auto payload = unpack<mavlink_set_position_target_local_ned_t>(message);
    if (!is_mine(payload)) return std::nullopt;
    const std::uint8_t frame = payload.coordinate_frame;
    const bool is_local =
        frame == MAV_FRAME_LOCAL_NED || frame == MAV_FRAME_LOCAL_OFFSET_NED || is_body_frame(frame);
    return read_place_target(payload, {payload.x, payload.y, payload.z}, is_local, context);
  }
  if (is<mavlink_set_position_target_global_int_t>(message)) {
    const auto payload = unpack<mavlink_set_position_target_global_int_t>(message);
    if (!is_mine(payload)) return std::nullopt;
    return read_place_target(
        payload,
        {payload.lat_int / kUnits_per_degree, payload.lon_int / kUnits_per_degree, payload.alt},
        is_global_frame(payload.coordinate_frame), context);
  }
  if (!is<mavlink_set_attitude_target_t>(message)) return std::nullopt;
  const auto payload = unpack<mavlink_set_attitude_target_t>(message);
  if (!is_mine(payload)) return std::nullopt;
  ReceivedTarget received;
  received.stamp = stamp_of(payload.time_boot_ms);
  read_attitude(payload, received);
  return received;
}

}  // namespace trident::bridges::mavlink
