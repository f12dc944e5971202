// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/line_of_sight.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::control {
namespace {

/// The tangent of the angle by which a bow at `speed` cancels a drift across its course.
double crab_slope(double across, double speed, double largest) {
  const double most = std::sin(largest);
  const double sine = speed > 0.0 ? std::clamp(across / speed, -most, most) : 0.0;
  return sine / std::sqrt(1.0 - sine * sine);
}

}  // namespace

void LineOfSight::start(const std::vector<Eigen::Vector2d>& waypoints,
                        const Eigen::Vector2d& p_world) {
  points_.clear();
  // A path of one point, or one that begins elsewhere, is led to from here.
  if (waypoints.size() == 1 || (waypoints.front() - p_world).norm() > params_.acceptance_radius) {
    points_.push_back(p_world);
  }
  for (const Eigen::Vector2d& point : waypoints) {
    // Legs without a length have no direction.
    if (points_.empty() || (point - points_.back()).norm() > 1e-6) points_.push_back(point);
  }
  integral_m_ = cross_track_m_ = 0.0;
  steady_m_.setZero();
  leg_ = 0;
  enter(0);
}

void LineOfSight::enter(std::size_t leg) {
  const Eigen::Vector2d old_left = left();
  steady_m_ += (integral_m_ - old_left.dot(steady_m_)) * old_left;
  leg_ = leg;
  if (is_finished()) return;
  const Eigen::Vector2d along = points_[leg + 1] - points_[leg];
  direction_ = std::atan2(along.y(), along.x());
  integral_m_ = left().dot(steady_m_);
}

void LineOfSight::advance(const Eigen::Vector2d& p_world) {
  while (!is_finished()) {
    const Eigen::Vector2d to_end = points_[leg_ + 1] - p_world;
    const Eigen::Vector2d unit(std::cos(direction_), std::sin(direction_));
    const bool is_reached = to_end.norm() <= params_.acceptance_radius;
    const bool is_passed = unit.dot(to_end) <= 0.0;
    if (!is_reached && !is_passed) return;
    enter(leg_ + 1);
  }
}

double LineOfSight::update(const Eigen::Vector2d& p_world, const Eigen::Vector2d& drift_world,
                           double speed, double dt_s) {
  advance(p_world);
  cross_track_m_ = left().dot(p_world - points_[std::min(leg_, points_.size() - 1)]);
  const double ahead = params_.lookahead, sigma = params_.integral_gain;
  double offset = cross_track_m_;
  if (sigma > 0.0) {
    const double limit = ahead * std::tan(params_.max_crab_angle);
    const double known = ahead * crab_slope(left().dot(drift_world), speed, params_.max_crab_angle);
    offset += known + sigma * integral_m_;
    integral_m_ += dt_s * ahead * cross_track_m_ / (ahead * ahead + offset * offset);
    integral_m_ = std::clamp(sigma * integral_m_, -limit - known, limit - known) / sigma;
  }
  return wrap_to_pi(direction_ - std::atan(offset / ahead));
}

}  // namespace trident::control
