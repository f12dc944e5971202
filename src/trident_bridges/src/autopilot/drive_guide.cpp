// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/drive_guide.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::bridges {
namespace {

using Kind = Setpoint::Kind;

constexpr double kTurnGain_per_s = 1.5;  // from an error in heading to a rate of turn
constexpr double kStickTurn_rad_s = 1.0;
constexpr double kDriveLasts_s = 3.0;  // of ArduPilot's Rover in GUIDED

}  // namespace

void DriveGuide::begin(Kind kind) {
  setpoint_ = {};
  setpoint_.kind = kind;
  is_followed_velocity_ = false;
}

void DriveGuide::go_to(const Eigen::Vector3d& p_m, const VehicleState& state) {
  const bool follows_leg = setpoint_.kind == Kind::kLeg;
  const Eigen::Vector3d from = follows_leg ? setpoint_.p_m : state.p_world_m;
  begin(Kind::kLeg);
  setpoint_.p_from_m = from;
  setpoint_.p_m = p_m;
  setpoint_.speed_m_s = limits_.speed_m_s;
}

void DriveGuide::stop(const VehicleState& state) {
  begin(Kind::kStation);
  setpoint_.p_m = state.p_world_m;
  setpoint_.yaw = state.yaw();
}

void DriveGuide::expire(const VehicleState& state, SimTime now) {
  if (is_followed_velocity_ && (now - followed_).seconds() > kDriveLasts_s) stop(state);
}

void DriveGuide::follow_place(const Eigen::Vector3d& p_m, const VehicleState& state) {
  const bool is_same = setpoint_.kind == Kind::kLeg && (setpoint_.p_m - p_m).norm() < 0.1;
  if (!is_same) go_to(p_m, state);
}

void DriveGuide::follow(const Target& target, const VehicleState& state, SimTime now) {
  if (target.p_m) return follow_place(*target.p_m, state);
  begin(Kind::kDrive);
  is_followed_velocity_ = true;
  followed_ = now;
  if (target.v_m_s) {
    const Eigen::Vector2d v = target.v_m_s->head<2>();
    const double error = angle_difference(std::atan2(v.y(), v.x()), state.yaw());
    setpoint_.speed_m_s = std::min(v.norm(), limits_.speed_m_s) * std::max(0.0, std::cos(error));
    if (v.norm() > 1e-3) setpoint_.yaw_rate = kTurnGain_per_s * error;
  }
  if (target.yaw_rate) setpoint_.yaw_rate = *target.yaw_rate;
  if (target.yaw) setpoint_.yaw_rate = kTurnGain_per_s * angle_difference(*target.yaw, state.yaw());
}

void DriveGuide::take_sticks(const Sticks& sticks) {
  begin(Kind::kDrive);
  // A ground station moves either of the two for "ahead": pitch of a joystick, throttle of a
  // transmitter, whose middle stands.
  const double throttle = 2.0 * (sticks.throttle - 0.5);
  const double ahead = std::abs(throttle) > std::abs(sticks.pitch) ? throttle : sticks.pitch;
  const double turn = std::abs(sticks.roll) > std::abs(sticks.yaw) ? sticks.roll : sticks.yaw;
  setpoint_.speed_m_s = ahead * limits_.speed_m_s;
  setpoint_.yaw_rate = -turn * kStickTurn_rad_s;
}

bool DriveGuide::has_arrived(const VehicleState& state, double radius_m) const {
  if (setpoint_.kind != Kind::kLeg) return true;
  const Eigen::Vector2d to_go = (setpoint_.p_m - state.p_world_m).head<2>();
  if (to_go.norm() <= radius_m) return true;
  const Eigen::Vector2d leg = (setpoint_.p_m - setpoint_.p_from_m).head<2>();
  // Next to its end, within twice the radius: a vessel in a current need not turn back.
  return leg.dot(to_go) <= 0.0 && to_go.norm() <= 2.0 * radius_m;
}

}  // namespace trident::bridges
