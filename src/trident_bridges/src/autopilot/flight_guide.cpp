// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/flight_guide.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::bridges {
namespace {

constexpr double kSlowBelow_m = 3.0;      // of a landing: land_speed from there
constexpr double kReferenceLead_m = 0.6;  // a landing's reference is never further below
constexpr double kStill_m_s = 0.1;        // of one that stands
constexpr double kStill_s = 0.5;          // for that long
constexpr double kLifted_m = 0.1;         // above where it stood
constexpr double kPlaceLasts_s = 0.5;     // of a stream; then it brakes
constexpr double kVelocityLasts_s = 3.0;  // GUID_TIMEOUT
constexpr double kShortestTurn_m = 0.5;   // legs that are shorter do not turn it
constexpr double kMaxLean_rad = 0.6;      // of sticks
constexpr double kMaxRate_rad_s = 2.0;    // of sticks

double sign_of(double value) { return value < 0.0 ? -1.0 : 1.0; }

}  // namespace

MotionLimits FlightGuide::motion_limits() const {
  return {limits_.speed_m_s, limits_.climb_m_s, limits_.sink_m_s, limits_.acceleration_m_s2};
}

void FlightGuide::start(SimTime now, const VehicleState& state) {
  const AutopilotLimits limits = limits_;
  *this = FlightGuide();
  limits_ = limits;
  motion_.stop_at(state.p_world_m, now);
  landing_.ground_m = state.p_world_m.z();
  yaw_ = yaw_goal_ = state.yaw();
}

void FlightGuide::leave_others() {
  circle_.reset();
  direct_.reset();
  wanted_yaw_rate_.reset();
  stream_.clear();
  streamed_acceleration_.setZero();
  news_until_.reset();
  landing_.is_active = false;
}

void FlightGuide::go_to(const Eigen::Vector3d& p_m, SimTime now) {
  leave_others();
  motion_.go_to(p_m, motion_limits(), now);
}

void FlightGuide::brake(SimTime now) {
  leave_others();
  motion_.brake(motion_limits(), now);
  yaw_goal_ = yaw_;
}

void FlightGuide::circle(const Eigen::Vector3d& center_m, double radius_m, double turns,
                         SimTime now) {
  leave_others();
  const Eigen::Vector3d from = motion_.at(now).p_m;
  const Eigen::Vector2d out = (from - center_m).head<2>();
  Circle circle;
  circle.center_m = center_m;
  circle.radius_m = std::max(std::abs(radius_m), 0.1) * sign_of(radius_m);
  circle.turns_left = turns;
  circle.angle = out.norm() > 1e-6 ? std::atan2(out.y(), out.x()) : 0.0;
  const double r = std::abs(circle.radius_m);
  motion_.go_to(
      center_m + Eigen::Vector3d(r * std::cos(circle.angle), r * std::sin(circle.angle), 0.0),
      motion_limits(), now);
  circle_ = circle;
}

void FlightGuide::land(SimTime now) {
  leave_others();
  motion_.brake(motion_limits(), now);
  landing_.is_active = true;
  landing_.still_since.reset();
}

void FlightGuide::look_along(const Eigen::Vector3d& goal_m, SimTime now) {
  const Eigen::Vector2d offset = (goal_m - motion_.at(now).p_m).head<2>();
  if (offset.norm() > kShortestTurn_m) yaw_goal_ = std::atan2(offset.y(), offset.x());
}

/// An attitude or body rates are handed on as they came.
void FlightGuide::follow_directly(const Target& target) {
  leave_others();
  Setpoint setpoint;
  setpoint.kind = target.w_body_rad_s ? Setpoint::Kind::kRates : Setpoint::Kind::kAttitude;
  setpoint.R_world_body = target.R_world_body.value_or(Eigen::Quaterniond::Identity());
  setpoint.w_body_rad_s = target.w_body_rad_s.value_or(Eigen::Vector3d::Zero());
  setpoint.yaw_rate = target.yaw_rate.value_or(0.0);
  setpoint.thrust = std::clamp(target.thrust.value_or(0.0), 0.0, 1.0);
  direct_ = setpoint;
}

void FlightGuide::follow(const Target& target, SimTime stamp, SimTime now) {
  if (target.R_world_body || target.w_body_rad_s) return follow_directly(target);
  circle_.reset();
  direct_.reset();
  news_until_.reset();
  streamed_acceleration_.setZero();
  landing_.is_active = false;
  wanted_yaw_rate_ = target.yaw_rate;
  if (target.yaw) yaw_goal_ = *target.yaw;
  if (target.p_m) return follow_place(target, stamp, now);
  stream_.clear();
  if (!target.v_m_s) return;
  motion_.set_velocity(limited(*target.v_m_s), motion_limits(), now);
  news_until_ = now + SimTime::from_seconds(kVelocityLasts_s);
}

Eigen::Vector3d FlightGuide::limited(const Eigen::Vector3d& v_m_s) const {
  Eigen::Vector3d result = v_m_s;
  const double across = result.head<2>().norm();
  if (across > limits_.speed_m_s) result.head<2>() *= limits_.speed_m_s / across;
  result.z() = std::clamp(result.z(), -limits_.sink_m_s, limits_.climb_m_s);
  return result;
}

/// A place that is far is flown to; places that follow one another closely are the motion itself.
void FlightGuide::follow_place(const Target& target, SimTime stamp, SimTime now) {
  stream_.push(stamp, *target.p_m, limits_.speed_m_s * 0.5);
  Reference wanted{*target.p_m, target.v_m_s.value_or(stream_.newest().v_m_s),
                   target.a_m_s2.value_or(stream_.newest().a_m_s2)};
  const bool is_steady = target.v_m_s || stream_.is_steady();
  const bool moves = wanted.v_m_s.norm() > 0.05;
  const double distance = (motion_.at(now).p_m - wanted.p_m).norm();
  if (is_steady && moves && distance < std::max(0.5, wanted.v_m_s.norm() * 0.5)) {
    motion_.follow(wanted, now);
    streamed_acceleration_ = wanted.a_m_s2;
    news_until_ = now + SimTime::from_seconds(kPlaceLasts_s);
    return;
  }
  if ((motion_.goal(now) - wanted.p_m).norm() > 0.01) {
    motion_.go_to(wanted.p_m, motion_limits(), now);
  }
}

void FlightGuide::take_sticks(const Sticks& sticks, Mode mode, SimTime now) {
  circle_.reset();
  news_until_.reset();
  streamed_acceleration_.setZero();
  landing_.is_active = false;
  const double yaw_rate = -sticks.yaw * limits_.yaw_rate_rad_s;
  wanted_yaw_rate_ = yaw_rate;
  if (mode == Mode::kPosition || mode == Mode::kAltitude) {
    direct_.reset();
    const Eigen::Vector3d v_body(
        sticks.pitch * limits_.speed_m_s, -sticks.roll * limits_.speed_m_s,
        2.0 * (sticks.throttle - 0.5) *
            (sticks.throttle > 0.5 ? limits_.climb_m_s : limits_.sink_m_s));
    motion_.set_velocity(Eigen::AngleAxisd(yaw_, Eigen::Vector3d::UnitZ()) * v_body,
                         motion_limits(), now);
    return;
  }
  Setpoint setpoint;
  setpoint.thrust = sticks.throttle;
  setpoint.yaw_rate = yaw_rate;
  if (mode == Mode::kAcro) {
    setpoint.kind = Setpoint::Kind::kRates;
    setpoint.w_body_rad_s =
        kMaxRate_rad_s * Eigen::Vector3d(sticks.roll, sticks.pitch, -sticks.yaw);
  } else {
    setpoint.kind = Setpoint::Kind::kAttitude;
    setpoint.R_world_body =
        Eigen::AngleAxisd(yaw_, Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(kMaxLean_rad * sticks.pitch, Eigen::Vector3d::UnitY()) *
        Eigen::AngleAxisd(kMaxLean_rad * sticks.roll, Eigen::Vector3d::UnitX());
  }
  direct_ = setpoint;
}

Setpoint FlightGuide::step(SimTime now, const VehicleState& state) {
  const double step_s = last_step_ ? std::clamp((now - *last_step_).seconds(), 0.0, 0.1) : 0.0;
  last_step_ = now;
  advance_yaw(state, step_s);
  if (news_until_ && now > *news_until_) brake(now);
  if (circle_) advance_circle(now, step_s);
  if (landing_.is_active) sink(now, state);
  watch_ground(now, state);
  if (direct_) {
    motion_.stop_at(state.p_world_m, now);  // whatever comes next begins here
    return *direct_;
  }
  const Reference reference = motion_.at(now);
  Setpoint setpoint;
  setpoint.kind = Setpoint::Kind::kTrajectory;
  setpoint.p_m = reference.p_m;
  setpoint.v_m_s = reference.v_m_s;
  setpoint.a_m_s2 = reference.a_m_s2;
  setpoint.a_m_s2 += streamed_acceleration_;
  setpoint.yaw = yaw_;
  setpoint.yaw_rate = yaw_rate_;
  return setpoint;
}

void FlightGuide::advance_circle(SimTime now, double step_s) {
  Circle& circle = *circle_;
  if (!circle.is_begun && !motion_.is_at_rest(now)) return;
  circle.is_begun = true;
  if (circle.turns_left <= 0.0) return;
  const double r = std::abs(circle.radius_m);
  // Speed grows from rest, and is what the limits' acceleration allows on this radius.
  const double speed = std::min(limits_.speed_m_s, std::sqrt(limits_.acceleration_m_s2 * r));
  circle.speed_m_s = std::min(speed, circle.speed_m_s + limits_.acceleration_m_s2 * step_s);
  const double braking =
      std::sqrt(2.0 * limits_.acceleration_m_s2 * circle.turns_left * 2.0 * kPi * r);
  const double v = std::min(circle.speed_m_s, braking);
  const double turned = v * step_s / r;
  const double direction = circle.radius_m < 0.0 ? 1.0 : -1.0;
  circle.angle += direction * turned;
  circle.turns_left -= turned / (2.0 * kPi);
  if (circle.turns_left < 1e-4) circle.turns_left = 0.0;
  const Eigen::Vector3d out(std::cos(circle.angle), std::sin(circle.angle), 0.0);
  const Eigen::Vector3d along = direction * Eigen::Vector3d(-out.y(), out.x(), 0.0);
  if (circle.turns_left <= 0.0) {
    motion_.stop_at(circle.center_m + r * out, now);
    return;
  }
  motion_.follow({circle.center_m + r * out, v * along, Eigen::Vector3d::Zero()}, now);
}

/// Down at the landing's speed, but never far below the vehicle, which may stand already.
void FlightGuide::sink(SimTime now, const VehicleState& state) {
  const Reference present = motion_.at(now);
  const bool is_low = state.p_world_m.z() - landing_.ground_m < kSlowBelow_m;
  const double speed = is_low ? limits_.land_speed_m_s : limits_.sink_m_s;
  if (present.p_m.z() < state.p_world_m.z() - kReferenceLead_m) {
    motion_.stop_at({present.p_m.x(), present.p_m.y(), state.p_world_m.z() - kReferenceLead_m},
                    now);
    return;
  }
  if (std::abs(present.v_m_s.z() + speed) > 0.01 && motion_.is_settled(now)) {
    motion_.set_velocity({0.0, 0.0, -speed}, motion_limits(), now);
  }
}

void FlightGuide::advance_yaw(const VehicleState& state, double step_s) {
  if (direct_) {
    yaw_ = yaw_goal_ = state.yaw();
    yaw_rate_ = 0.0;
    return;
  }
  if (wanted_yaw_rate_) {
    yaw_rate_ = *wanted_yaw_rate_;
    yaw_ = yaw_goal_ = wrap_to_pi(yaw_ + yaw_rate_ * step_s);
    return;
  }
  if (look_at_) {
    const Eigen::Vector2d offset = (*look_at_ - state.p_world_m).head<2>();
    if (offset.norm() > kShortestTurn_m) yaw_goal_ = std::atan2(offset.y(), offset.x());
  }
  const double error = angle_difference(yaw_goal_, yaw_);
  const double greatest = limits_.yaw_rate_rad_s * step_s;
  const double turn = std::clamp(error, -greatest, greatest);
  yaw_ = wrap_to_pi(yaw_ + turn);
  yaw_rate_ = step_s > 0.0 ? turn / step_s : 0.0;
}

void FlightGuide::watch_ground(SimTime now, const VehicleState& state) {
  if (landing_.is_active) return watch_touchdown(now, state);
  if (state.p_world_m.z() > landing_.ground_m + kLifted_m) landing_.is_done = false;
}

void FlightGuide::watch_touchdown(SimTime now, const VehicleState& state) {
  const bool is_below = motion_.at(now).p_m.z() < state.p_world_m.z() - 0.3;
  const bool stands = is_below && state.v_world_m_s.norm() < kStill_m_s;
  if (!stands) {
    landing_.still_since.reset();
    return;
  }
  if (!landing_.still_since) landing_.still_since = now;
  if ((now - *landing_.still_since).seconds() < kStill_s || landing_.is_done) return;
  landing_.is_done = true;
  landing_.ground_m = state.p_world_m.z();
  landing_.done_at = now;
}

bool FlightGuide::has_arrived(SimTime now, const VehicleState& state, double radius_m) const {
  if (landing_.is_active) return landing_.is_done;
  if (circle_) return circle_->is_begun && circle_->turns_left <= 0.0;
  return motion_.is_at_rest(now) && (motion_.goal(now) - state.p_world_m).norm() <= radius_m;
}

double FlightGuide::landed_s(SimTime now) const {
  return landing_.is_done && landing_.done_at ? (now - *landing_.done_at).seconds() : 0.0;
}

}  // namespace trident::bridges
