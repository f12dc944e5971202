// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_control/vessel_controller.h"

namespace trident::control {
namespace {

/// Bow-first approach begins again at this multiple of the radius at which it ends.
constexpr double kLeaveStation = 1.5;
/// Further than the course the bow is not turned [rad].
constexpr double kLargestLead = 0.6;
/// The speed by which a drift becomes a bow angle is at least this fraction of the cruise speed.
constexpr double kMinSpeedFraction = 0.5;

}  // namespace

VesselController::Setpoint VesselController::setpoint(SimTime stamp, const VesselState& state,
                                                      double dt_s) {
  Setpoint setpoint;
  switch (mode_) {
    case VesselMode::kIdle:
      break;
    case VesselMode::kVelocity:
      return velocity_setpoint(stamp);
    case VesselMode::kHeading:
      setpoint.heading = angle_;
      setpoint.speed = cruise_;
      break;
    case VesselMode::kCourse:
      setpoint.heading = course_heading(state, dt_s);
      setpoint.speed = cruise_;
      break;
    case VesselMode::kPath:
      return path_setpoint(stamp, state, dt_s);
    case VesselMode::kStation:
      return station_setpoint(state, dt_s);
  }
  return setpoint;
}

VesselController::Setpoint VesselController::velocity_setpoint(SimTime stamp) const {
  Setpoint setpoint;
  const bool is_old = has_timeout_ && (stamp - commanded_at_).seconds() > params_.cmd_vel.timeout;
  setpoint.speed = is_old ? 0.0 : speed_;
  setpoint.rate = is_old ? 0.0 : rate_;
  return setpoint;
}

double VesselController::course_heading(const VesselState& state, double dt_s) {
  const bool is_moving = std::hypot(state.u, state.v) > params_.course.min_speed;
  const double crab = is_moving ? std::atan2(state.v, state.u) : 0.0;
  const double part = -std::expm1(-dt_s / params_.course.crab_time_constant);
  crab_ = wrap_to_pi(crab_ + part * angle_difference(crab, crab_));
  return wrap_to_pi(angle_ - crab_);
}

double VesselController::slowed(double heading, const VesselState& state) const {
  return std::max(params_.guidance.slowest_turn,
                  std::cos(angle_difference(heading, state.heading)));
}

/// The heading that turns the motion through the water towards `course`: a hull without a keel
/// keeps its velocity when its bow turns, so the bow has to turn further until the velocity has
/// followed.
double VesselController::steered_towards(double course, double speed,
                                         const VesselState& state) const {
  const double course_now = state.heading + std::atan2(drift_.sway(), speed);
  const double lead = params_.guidance.course_gain * angle_difference(course, course_now);
  return wrap_to_pi(course + std::clamp(lead, -kLargestLead, kLargestLead));
}

VesselController::Setpoint VesselController::path_setpoint(SimTime stamp, const VesselState& state,
                                                           double dt_s) {
  Setpoint setpoint;
  const double speed = speed_through_water(stamp, state);
  const double course = path_.update(state.p_world, drift_.drift(), speed, dt_s);
  setpoint.heading = steered_towards(course, speed, state);
  setpoint.speed = cruise_ * slowed(setpoint.heading, state);
  if (!path_.is_finished()) return setpoint;
  if (params_.guidance.at_end == PathEnd::kKeepStation) {
    keep_station(path_.goal(), path_.direction(), state);
    return station_setpoint(state, dt_s);
  }
  enter(VesselMode::kVelocity, state);
  speed_ = rate_ = 0.0;
  setpoint.speed = 0.0;
  setpoint.rate = 0.0;
  return setpoint;
}

VesselController::Setpoint VesselController::station_setpoint(const VesselState& state,
                                                              double dt_s) {
  const Eigen::Vector2d away = station_ - state.p_world;
  const double near = params_.station.approach_radius * (is_near_station_ ? kLeaveStation : 1.0);
  const bool was_near = is_near_station_;
  is_near_station_ = away.norm() <= near;
  Setpoint setpoint;
  setpoint.over_ground = true;
  if (!is_near_station_) {
    setpoint.heading = std::atan2(away.y(), away.x());
    setpoint.speed = cruise_ * slowed(setpoint.heading, state);
    return setpoint;
  }
  if (!was_near) {
    place_hold_.reset();
    weather_vane_.start(state, station_);
  }
  if (holds_pose_) {
    setpoint.heading = angle_;
    setpoint.force = place_hold_.hold(state, station_, dt_s);
    return setpoint;
  }
  const WeatherVane::Setpoint vane = weather_vane_.update(state, station_, dt_s);
  setpoint.heading = vane.heading;
  setpoint.speed = vane.speed;
  return setpoint;
}

/// As measured by a log or derived from the drift; a vessel that accelerates counts as one at half
/// of its cruise speed.
double VesselController::speed_through_water(SimTime stamp, const VesselState& state) const {
  const Eigen::Vector2d bow(std::cos(state.heading), std::sin(state.heading));
  const double measured = has_log(stamp) ? *log_ : state.u - bow.dot(drift_.drift());
  return std::max(measured, kMinSpeedFraction * cruise_);
}

}  // namespace trident::control
