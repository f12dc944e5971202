// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "rudder.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

struct FoilCoefficients {
  double lift = 0.0, drag = 0.0;
};

/// `attack` in [-pi, pi]; a foil in a flow from behind works like one in a flow from ahead.
FoilCoefficients foil(const RudderParams& params, double attack) {
  if (std::abs(attack) > 0.5 * kPi) attack -= std::copysign(kPi, attack);
  const double ratio = params.aspect_ratio;
  if (std::abs(attack) <= params.stall_angle) {
    const double lift = params.lift_slope() * attack;
    return {lift, params.drag_coefficient + lift * lift / (0.9 * kPi * ratio)};
  }
  // A flat plate across the flow: normal force coefficient 2 sin(attack).
  const double normal = 2.0 * std::sin(attack);
  return {normal * std::cos(attack), params.drag_coefficient + normal * std::sin(attack)};
}

}  // namespace

void Rudder::command(double angle_rad) {
  if (!std::isfinite(angle_rad)) {
    throw Error("rudder '" + params_.name + "': angle = " + number_text(angle_rad) +
                " rad, legal is a number in [" + number_text(-params_.max_angle) + ", " +
                number_text(params_.max_angle) + "]");
  }
  command_rad_ = std::clamp(angle_rad, -params_.max_angle, params_.max_angle);
}

void Rudder::step(double dt_s) {
  const double largest = params_.angle_rate * dt_s;
  angle_rad_ += std::clamp(command_rad_ - angle_rad_, -largest, largest);
}

Vector6d Rudder::wrench(const Vector6d& nu_r, double water_density) const {
  const Eigen::Vector3d& p = params_.position;
  const Eigen::Vector3d v = nu_r.head<3>() + nu_r.tail<3>().cross(p);
  const double speed = std::hypot(v.x(), v.y());
  if (speed < 1e-9) return Vector6d::Zero();
  // The water comes along -v. The chord points aft and, at positive angles, to port.
  const double flow = std::atan2(-v.y(), -v.x());
  const double chord = kPi - angle_rad_;
  const FoilCoefficients c = foil(params_, wrap_to_pi(flow - chord));
  const double pressure_area = 0.5 * water_density * speed * speed * params_.area;
  const Eigen::Vector3d along(std::cos(flow), std::sin(flow), 0.0);
  const Eigen::Vector3d across(-along.y(), along.x(), 0.0);
  const Eigen::Vector3d force = pressure_area * (c.drag * along + c.lift * across);
  Vector6d result;
  result << force, p.cross(force);
  return result;
}

}  // namespace trident::sim
