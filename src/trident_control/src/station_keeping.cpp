// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/station_keeping.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::control {
namespace {

/// A vessel hangs on its point when it is nearer to its distance from it than this part of that.
constexpr double kHangs = 0.25;

Eigen::Vector2d limited(const Eigen::Vector2d& value, double most) {
  const double size = value.norm();
  return size > most ? Eigen::Vector2d(value * (most / size)) : value;
}

Eigen::Matrix2d rotation(double angle) {
  Eigen::Matrix2d R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R;
}

}  // namespace

PlaceHold::PlaceHold(const StationParams& params, const VesselModel& model)
    : params_(params), model_(model) {}

void PlaceHold::reset() {
  dt_s_ = 0.0;
  east_.reset();
  north_.reset();
}

Eigen::Vector2d PlaceHold::hold(const VesselState& state, const Eigen::Vector2d& place_world,
                                double dt_s) {
  const double w = params_.natural_frequency, zeta = params_.damping_ratio;
  // At this distance pull and damping balance at max_speed.
  const double farthest = 2.0 * zeta * params_.max_speed / w;
  error_world_ = limited(place_world - state.p_world, farthest);
  heading_ = state.heading;
  dt_s_ = dt_s;
  const Eigen::Matrix2d R_body_world = rotation(-heading_);
  const Eigen::Vector2d pull =
      w * w * (R_body_world * error_world_) - 2.0 * zeta * w * Eigen::Vector2d(state.u, state.v);
  asked_ = model_.mass.head<2>().cwiseProduct(pull) +
           R_body_world * Eigen::Vector2d(east_.value(), north_.value());
  return asked_;
}

void PlaceHold::settle(const Eigen::Vector2d& given) {
  if (params_.integral_time <= 0.0) return;
  const double w = params_.natural_frequency;
  const double gain = model_.mass.head<2>().mean() * w * w / params_.integral_time;
  const Eigen::Vector2d shortfall = rotation(heading_) * (asked_ - given);
  const double tolerance = 0.05 * asked_.norm() + 1e-9;
  east_.add(gain * error_world_.x(), dt_s_, shortfall.x(), tolerance);
  north_.add(gain * error_world_.y(), dt_s_, shortfall.y(), tolerance);
}

void WeatherVane::start(const VesselState& state, const Eigen::Vector2d& place_world) {
  const Eigen::Vector2d to_place = place_world - state.p_world;
  const Eigen::Vector2d ahead(std::cos(state.heading), std::sin(state.heading));
  const bool is_there = to_place.norm() < 0.5 * params_.suspension;
  point_ = place_world + params_.suspension * (is_there ? ahead : to_place.normalized());
}

/// The vessel is drawn to the circle about the point (speed by the distance beyond it) while it
/// looks at the point, and the point follows the error of the station slowly.
WeatherVane::Setpoint WeatherVane::update(const VesselState& state,
                                          const Eigen::Vector2d& place_world, double dt_s) {
  const Eigen::Vector2d to_point = point_ - state.p_world;
  const double beyond = to_point.norm() - params_.suspension;
  // Moved while the vessel still comes, it would be moved too far.
  if (std::abs(beyond) < kHangs * params_.suspension) {
    point_ += params_.suspension_rate * dt_s * (place_world - state.p_world);
  }
  Setpoint setpoint;
  setpoint.heading =
      to_point.norm() > 1e-6 ? std::atan2(to_point.y(), to_point.x()) : state.heading;
  // A bow that looks elsewhere must not lead there.
  const double ahead = std::max(0.0, std::cos(angle_difference(setpoint.heading, state.heading)));
  setpoint.speed =
      ahead * std::clamp(params_.natural_frequency * beyond, -params_.max_speed, params_.max_speed);
  return setpoint;
}

}  // namespace trident::control
