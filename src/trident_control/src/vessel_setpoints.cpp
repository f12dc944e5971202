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
/// A turn to the other side is shorter from here on [rad].
constexpr double kHalfAround = 0.95 * kPi;
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
      setpoint.heading = commanded_.angle;
      setpoint.speed = commanded_.cruise;
      break;
    case VesselMode::kCourse:
      setpoint.heading = course_heading(state, dt_s);
      setpoint.speed = commanded_.cruise;
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
  const bool is_old =
      commanded_.has_timeout && (stamp - commanded_.at).seconds() > params_.cmd_vel.timeout;
  setpoint.speed = is_old ? 0.0 : commanded_.speed;
  setpoint.rate = is_old ? 0.0 : commanded_.rate;
  return setpoint;
}

double VesselController::course_heading(const VesselState& state, double dt_s) {
  const bool is_moving = std::hypot(state.u, state.v) > params_.course.min_speed;
  const double crab = is_moving ? std::atan2(state.v, state.u) : 0.0;
  const double part = -std::expm1(-dt_s / params_.course.crab_time_constant);
  commanded_.crab = wrap_to_pi(commanded_.crab + part * angle_difference(crab, commanded_.crab));
  return wrap_to_pi(commanded_.angle - commanded_.crab);
}

double VesselController::slowed(double heading, const VesselState& state) const {
  return std::max(params_.guidance.slowest_turn,
                  std::cos(angle_difference(heading, state.heading)));
}

/// The heading that turns the motion through the water towards `course`: a hull without a keel
/// keeps its velocity when its bow turns, so the bow has to turn further until the velocity has
/// followed. It does not turn further than half around: beyond, the other turn would be the shorter
/// one, the lead would change its sign with it, and the bow would swing between both.
double VesselController::steered_towards(double course, double speed,
                                         const VesselState& state) const {
  const double course_now = state.heading + std::atan2(drift_.sway(), speed);
  const double lead = params_.guidance.course_gain * angle_difference(course, course_now);
  const double turn = angle_difference(course, state.heading);
  const double left_room = std::max(kHalfAround - turn, 0.0);
  const double right_room = std::max(kHalfAround + turn, 0.0);
  return wrap_to_pi(course + std::clamp(lead, -std::min(kLargestLead, right_room),
                                        std::min(kLargestLead, left_room)));
}

VesselController::Setpoint VesselController::path_setpoint(SimTime stamp, const VesselState& state,
                                                           double dt_s) {
  Setpoint setpoint;
  const double speed = speed_through_water(stamp, state);
  const double course = path_.update(state.p_world, drift_.drift(), speed, dt_s);
  setpoint.heading = steered_towards(course, speed, state);
  setpoint.speed = commanded_.cruise * slowed(setpoint.heading, state);
  if (!path_.is_finished()) return setpoint;
  if (params_.guidance.at_end == PathEnd::kKeepStation) {
    keep_station(path_.goal(), path_.direction(), state);
    return station_setpoint(state, dt_s);
  }
  enter(VesselMode::kVelocity, state);
  commanded_.speed = commanded_.rate = 0.0;
  setpoint.speed = 0.0;
  setpoint.rate = 0.0;
  return setpoint;
}

VesselController::Setpoint VesselController::station_setpoint(const VesselState& state,
                                                              double dt_s) {
  const Eigen::Vector2d away = station_.p_world - state.p_world;
  const double near = params_.station.approach_radius * (station_.is_near ? kLeaveStation : 1.0);
  const bool was_near = station_.is_near;
  station_.is_near = away.norm() <= near;
  Setpoint setpoint;
  setpoint.over_ground = true;
  if (!station_.is_near) {
    setpoint.heading = std::atan2(away.y(), away.x());
    setpoint.speed = commanded_.cruise * slowed(setpoint.heading, state);
    return setpoint;
  }
  if (!was_near) {
    station_.hold.reset();
    station_.vane.start(state, station_.p_world);
  }
  if (station_.holds_pose) {
    setpoint.heading = commanded_.angle;
    setpoint.force = station_.hold.hold(state, station_.p_world, dt_s);
    return setpoint;
  }
  const WeatherVane::Setpoint vane = station_.vane.update(state, station_.p_world, dt_s);
  setpoint.heading = vane.heading;
  setpoint.speed = vane.speed;
  return setpoint;
}

/// As measured by a log or derived from the drift; a vessel that accelerates counts as one at half
/// of its cruise speed.
double VesselController::speed_through_water(SimTime stamp, const VesselState& state) const {
  const Eigen::Vector2d bow(std::cos(state.heading), std::sin(state.heading));
  const double measured = has_log(stamp) ? *log_.speed : state.u - bow.dot(drift_.drift());
  return std::max(measured, kMinSpeedFraction * commanded_.cruise);
}

}  // namespace trident::control
