// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/vessel_controller.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "vessel_command_check.h"

namespace trident {
namespace {

constexpr std::int64_t kForeignClockNs = 60'000'000'000;
constexpr std::size_t kMostPending = 256;
/// A gap in the states counts as no more than this [s].
constexpr double kLongestStep = 0.5;
/// Bow-first approach begins again at this multiple of the radius at which it ends.
constexpr double kLeaveStation = 1.5;

VesselState planar_state(const OdometryState& odometry) {
  const Eigen::Vector3d v_world = odometry.R_world_body * odometry.v_body;
  VesselState state;
  state.p_world = odometry.p_world_body.head<2>();
  state.heading = yaw_from_quaternion(odometry.R_world_body);
  const double c = std::cos(state.heading), s = std::sin(state.heading);
  state.u = c * v_world.x() + s * v_world.y();
  state.v = -s * v_world.x() + c * v_world.y();
  state.r = (odometry.R_world_body * odometry.w_body).z();
  return state;
}

bool can_hold_pose(StationBehaviour behaviour, const ThrustAllocation& allocation,
                   const std::string& vessel) {
  if (behaviour == StationBehaviour::kPose && !allocation.can_push_everywhere()) {
    throw Error("station.behaviour = pose, legal for vessel '" + vessel +
                "', whose thrusters do not push sideways, is automatic, weather_vane");
  }
  if (behaviour != StationBehaviour::kAutomatic) return behaviour == StationBehaviour::kPose;
  return allocation.can_push_everywhere_at_once();
}

}  // namespace

const char* name_of(VesselMode mode) {
  switch (mode) {
    case VesselMode::kIdle:
      return "idle";
    case VesselMode::kVelocity:
      return "velocity";
    case VesselMode::kHeading:
      return "heading";
    case VesselMode::kCourse:
      return "course";
    case VesselMode::kPath:
      return "path";
    case VesselMode::kStation:
      return "station";
  }
  return "";
}

VesselController::VesselController(const VesselModel& model, const VesselControlParams& params)
    : params_(params),
      autopilot_(params.heading, model),
      speed_controller_(params.speed, model),
      path_(params.guidance),
      place_hold_(params.station, model),
      weather_vane_(params.station),
      wave_filter_(params.station.wave_frequency),
      allocation_(model, params.allocation),
      holds_pose_(can_hold_pose(params.station.behaviour, allocation_, model.name)),
      cruise_(params.speed.cruise) {}

void VesselController::reset() {
  // What has no stamp and still waits came after the last state: it is of the new time.
  const auto is_stamped = [](const Pending& p) { return p.stamp.ns != 0; };
  pending_.erase(std::remove_if(pending_.begin(), pending_.end(), is_stamped), pending_.end());
  last_stamp_.reset();
  log_.reset();
  mode_ = VesselMode::kIdle;
  cruise_ = params_.speed.cruise;
  asked_.setZero();
  given_.setZero();
  allocation_.rest();
}

CommandVerdict VesselController::push(SimTime stamp, const VesselCommand& command) {
  VesselCommand checked = command;
  CommandVerdict verdict = check_command(checked, params_);
  if (!verdict.refused.empty()) return verdict;
  const SimTime now = last_stamp_.value_or(SimTime{});
  if (stamp.ns > now.ns + kForeignClockNs) stamp = {};
  if (pending_.size() == kMostPending) {
    verdict.refused = std::to_string(kMostPending) + " commands wait for their time already";
    return verdict;
  }
  // In order of time; of one stamp in order of arrival.
  const auto after = std::upper_bound(pending_.begin(), pending_.end(), stamp,
                                      [](SimTime s, const Pending& p) { return s < p.stamp; });
  pending_.insert(after, {stamp, std::move(checked)});
  return verdict;
}

void VesselController::set_log(SimTime stamp, double u_water) {
  if (!std::isfinite(u_water)) return;
  log_ = u_water;
  log_stamp_ = stamp;
}

ControlStatus VesselController::update(SimTime stamp, const OdometryState& odometry) {
  if (!is_valid(odometry)) return ControlStatus::invalid_state;
  if (last_stamp_ && stamp < *last_stamp_) reset();
  const double dt_s = last_stamp_ ? std::min((stamp - *last_stamp_).seconds(), kLongestStep) : 0.0;
  last_stamp_ = stamp;
  VesselState state = planar_state(odometry);
  apply_due(stamp, state);
  if (mode_ == VesselMode::kIdle) {
    allocation_.rest();
    return ControlStatus::ok;
  }
  if (mode_ == VesselMode::kStation) state = wave_filter_.filter(state, dt_s);
  actuate(wish(stamp, state, dt_s), stamp, state, dt_s);
  return ControlStatus::ok;
}

void VesselController::apply_due(SimTime stamp, const VesselState& state) {
  while (!pending_.empty() && pending_.front().stamp <= stamp) {
    const VesselCommand command = std::move(pending_.front().command);
    pending_.pop_front();
    apply(stamp, command, state);
  }
}

void VesselController::enter(VesselMode mode, const VesselState& state) {
  if (mode_ == VesselMode::kIdle) autopilot_.reset(state);
  if (!is_speed_held_ || mode_ == VesselMode::kIdle) speed_controller_.reset(state.u);
  is_speed_held_ = true;
  if (mode == VesselMode::kStation || mode == VesselMode::kCourse) crab_ = 0.0;
  mode_ = mode;
}

void VesselController::apply(SimTime stamp, const VesselCommand& command,
                             const VesselState& state) {
  using Kind = VesselCommand::Kind;
  commanded_at_ = stamp;
  has_timeout_ = false;
  switch (command.kind) {
    case Kind::kSpeed:
      cruise_ = command.speed;
      return;
    case Kind::kVelocity:
      enter(VesselMode::kVelocity, state);
      has_timeout_ = params_.cmd_vel.timeout > 0.0;
      speed_ = command.speed;
      rate_ = command.rate;
      return;
    case Kind::kHeading:
      enter(VesselMode::kHeading, state);
      angle_ = command.angle;
      return;
    case Kind::kCourse:
      if (mode_ != VesselMode::kCourse) enter(VesselMode::kCourse, state);
      angle_ = command.angle;
      return;
    case Kind::kPath:
      enter(VesselMode::kPath, state);
      path_.start(command.waypoints, state.p_world);
      return;
    case Kind::kStation:
      keep_station(command.waypoints.front(), command.angle, state);
      return;
  }
}

void VesselController::keep_station(const Eigen::Vector2d& place, double heading,
                                    const VesselState& state) {
  const bool is_new = mode_ != VesselMode::kStation;
  if (is_new) enter(VesselMode::kStation, state);
  if (is_new) wave_filter_.reset();
  station_ = place;
  angle_ = heading;
  if (is_new) is_near_station_ = false;
}

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
      return path_wish(state, dt_s);
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

VesselController::Wish VesselController::path_wish(const VesselState& state, double dt_s) {
  Wish wish;
  wish.heading = path_.update(state.p_world, dt_s);
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

std::optional<double> VesselController::measured_speed(SimTime stamp,
                                                       const VesselState& state) const {
  if (params_.speed.reference == SpeedReference::kOverGround) return state.u;
  if (!log_ || (stamp - log_stamp_).seconds() > params_.speed.log_timeout) return {};
  return log_;
}

void VesselController::actuate(const Wish& wish, SimTime stamp, const VesselState& state,
                               double dt_s) {
  asked_[2] = wish.rate ? autopilot_.turn(state, *wish.rate, dt_s)
                        : autopilot_.hold(state, wish.heading, dt_s);
  if (wish.force) {
    asked_.head<2>() = *wish.force;
    is_speed_held_ = false;
  } else {
    if (!is_speed_held_) speed_controller_.reset(state.u);
    is_speed_held_ = true;
    const auto measured = wish.over_ground ? state.u : measured_speed(stamp, state);
    asked_[0] = speed_controller_.hold(measured, wish.speed, dt_s);
    asked_[1] = 0.0;
  }
  given_ = allocation_.allocate(asked_, state.u, dt_s);
  autopilot_.settle(given_[2]);
  if (wish.force) {
    place_hold_.settle(given_.head<2>());
  } else {
    speed_controller_.settle(given_[0]);
  }
}

}  // namespace trident
