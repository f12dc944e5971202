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
/// Of the cruise, from which a drift is turned into an angle of the bow.
constexpr double kSlowestWay = 0.5;

}  // namespace

VesselController::Wish VesselController::wish(SimTime stamp, const VesselState& state,
                                              double dt_s) {
  Wish wish;
  switch (mode_) {
    case VesselMode::kIdle:
      break;
    case VesselMode::kVelocity:
      return velocity_wish(stamp);
    case VesselMode::kHeading:
      wish.heading = angle_;
      wish.speed = cruise_;
      break;
    case VesselMode::kCourse:
      wish.heading = course_heading(state, dt_s);
      wish.speed = cruise_;
      break;
    case VesselMode::kPath:
      return path_wish(stamp, state, dt_s);
    case VesselMode::kStation:
      return station_wish(state, dt_s);
  }
  return wish;
}

VesselController::Wish VesselController::velocity_wish(SimTime stamp) const {
  Wish wish;
  const bool is_old = has_timeout_ && (stamp - commanded_at_).seconds() > params_.cmd_vel.timeout;
  wish.speed = is_old ? 0.0 : speed_;
  wish.rate = is_old ? 0.0 : rate_;
  return wish;
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

/// The heading that turns the way through the water towards `course`: a hull without a keel slides
/// on as it went when its bow turns, so that the bow is to turn further until the way has followed.
double VesselController::steered_towards(double course, double speed,
                                         const VesselState& state) const {
  const double way = state.heading + std::atan2(drift_.sway(), speed);
  const double lead = params_.guidance.course_gain * angle_difference(course, way);
  return wrap_to_pi(course + std::clamp(lead, -kLargestLead, kLargestLead));
}

VesselController::Wish VesselController::path_wish(SimTime stamp, const VesselState& state,
                                                   double dt_s) {
  Wish wish;
  const double speed = speed_through_water(stamp, state);
  const double course = path_.update(state.p_world, drift_.drift(), speed, dt_s);
  wish.heading = steered_towards(course, speed, state);
  wish.speed = cruise_ * slowed(wish.heading, state);
  if (!path_.is_finished()) return wish;
  if (params_.guidance.at_end == PathEnd::kKeepStation) {
    keep_station(path_.goal(), path_.direction(), state);
    return station_wish(state, dt_s);
  }
  enter(VesselMode::kVelocity, state);
  speed_ = rate_ = 0.0;
  wish.speed = 0.0;
  wish.rate = 0.0;
  return wish;
}

VesselController::Wish VesselController::station_wish(const VesselState& state, double dt_s) {
  const Eigen::Vector2d away = station_ - state.p_world;
  const double near = params_.station.approach_radius * (is_near_station_ ? kLeaveStation : 1.0);
  const bool was_near = is_near_station_;
  is_near_station_ = away.norm() <= near;
  Wish wish;
  wish.over_ground = true;
  if (!is_near_station_) {
    wish.heading = std::atan2(away.y(), away.x());
    wish.speed = cruise_ * slowed(wish.heading, state);
    return wish;
  }
  if (!was_near) {
    place_hold_.reset();
    weather_vane_.start(state, station_);
  }
  if (holds_pose_) {
    wish.heading = angle_;
    wish.force = place_hold_.hold(state, station_, dt_s);
    return wish;
  }
  const WeatherVane::Wish vane = weather_vane_.update(state, station_, dt_s);
  wish.heading = vane.heading;
  wish.speed = vane.speed;
  return wish;
}

/// As a log or the drift tells it; a vessel that gathers way is taken for one at half its cruise.
double VesselController::speed_through_water(SimTime stamp, const VesselState& state) const {
  const Eigen::Vector2d bow(std::cos(state.heading), std::sin(state.heading));
  const double told = has_log(stamp) ? *log_ : state.u - bow.dot(drift_.drift());
  return std::max(told, kSlowestWay * cruise_);
}

}  // namespace trident::control
