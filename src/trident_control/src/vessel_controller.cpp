// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/vessel_controller.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "vessel_command_check.h"

namespace trident::control {
namespace {

/// Stamps further ahead than this are those of a wall clock.
constexpr std::int64_t kForeignClockNs = 60'000'000'000;
/// Bounds the memory that a sender takes while no states come.
constexpr std::size_t kMaxPending = 256;
/// A gap in the states counts as no more than this [s].
constexpr double kLongestStep = 0.5;

/// Velocity in the axes of the heading, not of the body: a hull that rolls or pitches does not turn
/// its speed into the water.
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

/// Automatic: a pose is held only where thrusters push sideways without being turned first.
bool can_hold_pose(StationBehavior behavior, const ThrustAllocation& allocation,
                   const std::string& vessel) {
  if (behavior == StationBehavior::kPose && !allocation.can_push_everywhere()) {
    throw Error("station.behaviour = pose, legal for vessel '" + vessel +
                "', whose thrusters do not push sideways, is automatic, weather_vane");
  }
  if (behavior != StationBehavior::kAutomatic) return behavior == StationBehavior::kPose;
  return allocation.can_push_everywhere_at_once();
}

}  // namespace

const char* name_of(VesselMode mode) {
  static const std::map<VesselMode, const char*> kNames{
      {VesselMode::kIdle, "idle"},       {VesselMode::kVelocity, "velocity"},
      {VesselMode::kHeading, "heading"}, {VesselMode::kCourse, "course"},
      {VesselMode::kPath, "path"},       {VesselMode::kStation, "station"}};
  return kNames.at(mode);
}

VesselController::VesselController(const VesselModel& model, const VesselControlParams& params)
    : params_(params),
      autopilot_(params.heading, model),
      speed_controller_(params.speed, model),
      path_(params.guidance),
      drift_(model, params.guidance.drift_time_constant),
      allocation_(model, params.allocation),
      station_{PlaceHold(params.station, model), WeatherVane(params.station),
               WaveFilter(params.station.wave_frequency),
               can_hold_pose(params.station.behavior, allocation_, model.name)} {
  commanded_.cruise = params.speed.cruise;
}

bool VesselCommand::operator==(const VesselCommand& other) const {
  return kind == other.kind && speed == other.speed && rate == other.rate && angle == other.angle &&
         waypoints == other.waypoints;
}

void VesselController::reset() {
  // What has no stamp and still waits came after the last state: it is of the new time.
  const auto is_stamped = [](const Pending& p) { return p.stamp.ns != 0; };
  pending_.erase(std::remove_if(pending_.begin(), pending_.end(), is_stamped), pending_.end());
  last_stamped_.reset();
  last_stamp_.reset();
  log_.speed.reset();
  mode_ = VesselMode::kIdle;
  commanded_.cruise = params_.speed.cruise;
  drift_.reset();
  forces_.asked.setZero();
  forces_.given.setZero();
  allocation_.rest();
}

CommandVerdict VesselController::push(SimTime stamp, const VesselCommand& command) {
  VesselCommand checked = command;
  CommandVerdict verdict = check_command(checked, params_);
  if (!verdict.refused.empty()) return verdict;
  const SimTime now = last_stamp_.value_or(SimTime{});
  if (stamp.ns > now.ns + kForeignClockNs) stamp = {};
  if (pending_.size() == kMaxPending) {
    verdict.refused = std::to_string(kMaxPending) + " commands wait for their time already";
    return verdict;
  }
  // In order of time; of one stamp in order of arrival.
  const auto after = std::upper_bound(pending_.begin(), pending_.end(), stamp,
                                      [](SimTime s, const Pending& p) { return s < p.stamp; });
  pending_.insert(after, {stamp, std::move(checked)});
  return verdict;
}

void VesselController::set_log(SimTime stamp, double u_water) {
  if (!(std::abs(u_water) <= 1e3)) return;  // [m/s]; the node reports it
  log_.speed = u_water;
  log_.stamp = stamp;
}

/// One state: commands that are due set the mode, the mode sets heading and speed or a force, these
/// become forces, and the allocation turns those into commands. The step is bounded, as states may
/// be missing: an integral must not jump.
ControlStatus VesselController::update(SimTime stamp, const OdometryState& odometry) {
  if (!is_valid(odometry)) return ControlStatus::invalid_state;
  if (last_stamp_ && stamp < *last_stamp_) reset();
  const double dt_s = last_stamp_ ? std::min((stamp - *last_stamp_).seconds(), kLongestStep) : 0.0;
  last_stamp_ = stamp;
  VesselState state = planar_state(odometry);
  // The drift is observed in every mode, so that it is known when a course or a path begins.
  drift_.update(state, forces_.given[1], dt_s);
  apply_due(stamp, state);
  if (mode_ == VesselMode::kIdle) {
    allocation_.rest();
    return ControlStatus::ok;
  }
  // Thrusters must not work against the waves' first-order motion, which has a mean of zero.
  if (mode_ == VesselMode::kStation) state = station_.filter.filter(state, dt_s);
  actuate(setpoint(stamp, state, dt_s), stamp, state, dt_s);
  return ControlStatus::ok;
}

/// In order of time. The same stamped command again has no effect, however often a latched topic or
/// a patient sender repeats it.
void VesselController::apply_due(SimTime stamp, const VesselState& state) {
  while (!pending_.empty() && pending_.front().stamp <= stamp) {
    const Pending due = std::move(pending_.front());
    pending_.pop_front();
    if (last_stamped_ && due == *last_stamped_) continue;
    if (due.stamp.ns != 0) last_stamped_ = due;
    apply(stamp, due.command, state);
  }
}

/// References continue from how the vessel moves, so that a change of mode makes no bump.
void VesselController::enter(VesselMode mode, const VesselState& state) {
  if (mode_ == VesselMode::kIdle) autopilot_.reset(state);
  if (!is_speed_held_ || mode_ == VesselMode::kIdle) speed_controller_.reset(state.u);
  is_speed_held_ = true;
  if (mode == VesselMode::kStation || mode == VesselMode::kCourse) commanded_.crab = 0.0;
  mode_ = mode;
}

void VesselController::apply(SimTime stamp, const VesselCommand& command,
                             const VesselState& state) {
  using Kind = VesselCommand::Kind;
  commanded_.at = stamp;
  commanded_.has_timeout = false;
  switch (command.kind) {
    case Kind::kSpeed:
      commanded_.cruise = command.speed;
      return;
    case Kind::kVelocity:
      enter(VesselMode::kVelocity, state);
      // A velocity is for a moment, as of a joystick; all other commands hold until the next one.
      commanded_.has_timeout = params_.cmd_vel.timeout > 0.0;
      commanded_.speed = command.speed;
      commanded_.rate = command.rate;
      return;
    case Kind::kHeading:
      enter(VesselMode::kHeading, state);
      commanded_.angle = command.angle;
      return;
    case Kind::kCourse:
      if (mode_ != VesselMode::kCourse) enter(VesselMode::kCourse, state);
      commanded_.angle = command.angle;
      return;
    case Kind::kPath:
      enter(VesselMode::kPath, state);
      path_.start(command.waypoints, state.p_world);
      return;
    case Kind::kStation:
      keep_station(command.waypoints.front(), command.angle, state);
      return;
    case Kind::kStop:
      mode_ = VesselMode::kIdle;
      forces_.asked.setZero();
      forces_.given.setZero();
      return;
  }
}

/// A station that is only moved keeps filters and integrals: wind and current are the same there.
void VesselController::keep_station(const Eigen::Vector2d& place, double heading,
                                    const VesselState& state) {
  const bool is_new = mode_ != VesselMode::kStation;
  if (is_new) enter(VesselMode::kStation, state);
  if (is_new) station_.filter.reset();
  station_.p_world = place;
  commanded_.angle = heading;
  if (is_new) station_.is_near = false;
}

bool VesselController::has_log(SimTime stamp) const {
  return log_.speed && (stamp - log_.stamp).seconds() <= params_.speed.log_timeout;
}

/// Nothing where a speed log is wanted and none is fresh: the feed-forward stands alone then.
std::optional<double> VesselController::measured_speed(SimTime stamp,
                                                       const VesselState& state) const {
  if (params_.speed.reference == SpeedReference::kOverGround) return state.u;
  if (!has_log(stamp)) return {};
  return log_.speed;
}

/// The integrals continue from what the actuators gave, not from what was asked (back-calculation):
/// a saturated thruster does not wind them up.
void VesselController::actuate(const Setpoint& setpoint, SimTime stamp, const VesselState& state,
                               double dt_s) {
  forces_.asked[2] = setpoint.rate ? autopilot_.turn(state, *setpoint.rate, dt_s)
                                   : autopilot_.hold(state, setpoint.heading, dt_s);
  if (setpoint.force) {
    forces_.asked.head<2>() = *setpoint.force;
    is_speed_held_ = false;
  } else {
    if (!is_speed_held_) speed_controller_.reset(state.u);
    is_speed_held_ = true;
    const auto measured = setpoint.over_ground ? state.u : measured_speed(stamp, state);
    // Without a wanted force in sway the vessel is steered as an underactuated one.
    forces_.asked[0] = speed_controller_.hold(measured, setpoint.speed, dt_s);
    forces_.asked[1] = 0.0;
  }
  forces_.given = allocation_.allocate(forces_.asked, state.u, dt_s);
  autopilot_.settle(forces_.given[2]);
  if (setpoint.force) {
    station_.hold.settle(forces_.given.head<2>());
  } else {
    speed_controller_.settle(forces_.given[0]);
  }
}

}  // namespace trident::control
