// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/thrust_allocation.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "box_least_squares.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/vehicle/thruster_curve.h"

namespace trident::control {
namespace {

/// Weight of the forces relative to that of their error; both as fractions of the largest force.
constexpr double kEffort = 1e-6;
/// Forces below this part of the largest do not turn a thruster.
constexpr double kMinForceToRotate = 0.02;

Eigen::Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

bool turns(const ThrusterParams& thruster) { return thruster.max_angle > 0.0; }

template <class Columns>
Eigen::Index rank(const Columns& B) {
  Eigen::ColPivHouseholderQR<Columns> pivoted(B);
  // Relative to the largest pivot: levers of micrometers do not make a rank.
  pivoted.setThreshold(1e-6);
  return pivoted.rank();
}

/// A rudder has one force, a thruster too; one that turns has a second, aside.
std::size_t count_forces(const VesselModel& model) {
  return model.rudders.size() + model.thrusters.size() +
         static_cast<std::size_t>(
             std::count_if(model.thrusters.begin(), model.thrusters.end(), turns));
}

double most(const ThrusterParams& thruster) {
  return std::max(0.0, thrust_at(thruster, thruster.max_command));
}
double least(const ThrusterParams& thruster) {
  return thruster.min_command < 0.0 ? std::min(0.0, thrust_at(thruster, thruster.min_command))
                                    : 0.0;
}
double largest(const ThrusterParams& thruster) {
  return std::max({most(thruster), -least(thruster), 1e-9});
}

}  // namespace

void ThrustAllocation::Problem::resize(int variables) {
  B.resize(3, variables);
  lo.resize(variables);
  hi.resize(variables);
  size = 0;
}

/// A column of B: the force of a unit variable, and its moment about z.
void ThrustAllocation::Problem::add(const Eigen::Vector2d& force, const Eigen::Vector3d& position,
                                    double least, double most) {
  B.col(size) << force, position.x() * force.y() - position.y() * force.x();
  lo[size] = least;
  hi[size] = most;
  ++size;
}

/// Topics first, as commands are laid out in their order; memory for the largest program is part of
/// the object.
ThrustAllocation::ThrustAllocation(const VesselModel& model, const AllocationParams& params)
    : model_(model), weights_(params.surge_weight, params.sway_weight, params.yaw_weight) {
  for (const ThrusterParams& thruster : model.thrusters) {
    topics_.push_back("thrusters/" + thruster.name + "_thrust_cmd");
  }
  for (const ThrusterParams& thruster : model.thrusters) {
    if (turns(thruster)) topics_.push_back("thrusters/" + thruster.name + "_thrust_angle");
  }
  for (const RudderParams& rudder : model.rudders) {
    topics_.push_back("rudders/" + rudder.name + "_angle");
  }
  const std::size_t variables = count_forces(model);
  if (variables > static_cast<std::size_t>(kMaxVariables)) {
    throw Error("vessel '" + model.name + "': " + std::to_string(variables) +
                " forces of thrusters and rudders, legal, to be controlled, is at most " +
                std::to_string(kMaxVariables));
  }
  weigh();
  rest();
}

/// Moments weigh as the forces that make them do at the longest lever.
void ThrustAllocation::weigh() {
  // [m]; the floor is for vessels whose thrusters are all at the origin.
  double lever = 0.1;
  Problem fixed, all;
  fixed.resize(static_cast<int>(model_.thrusters.size()));
  all.resize(2 * static_cast<int>(model_.thrusters.size()));
  all.B.setZero();
  for (const ThrusterParams& thruster : model_.thrusters) {
    lever = std::max(lever, thruster.position.head<2>().norm());
    const Eigen::Vector2d ahead = direction(thruster.yaw);
    fixed.add(ahead, thruster.position, 0.0, 1.0);
    all.add(ahead, thruster.position, 0.0, 1.0);
    if (turns(thruster)) {
      all.add(direction(thruster.yaw + 0.5 * kPi), thruster.position, 0.0, 1.0);
    }
  }
  // A moment divided by the lever is a force, so that the three weights compare forces.
  weights_[2] /= lever;
  rank_ = rank(all.B);
  rank_of_fixed_ = rank(fixed.B);
}

void ThrustAllocation::rest() {
  commands_.assign(topics_.size(), 0.0);
  angles_rad_.assign(model_.thrusters.size(), 0.0);
}

/// Of a rudder at its largest useful angle, to the left [N]; it works in forward motion only.
double ThrustAllocation::rudder_force(const RudderParams& rudder, double u) const {
  if (u <= 0.0) return 0.0;
  const double angle = std::min(rudder.max_angle, rudder.stall_angle);
  return -0.5 * model_.water_density * rudder.area * u * u * rudder.lift_slope() * angle;
}

void ThrustAllocation::add_rudders(double u) {
  for (const RudderParams& rudder : model_.rudders) {
    problem_.add({0.0, rudder_force(rudder, u)}, rudder.position, -1.0, 1.0);
  }
}

ThrustAllocation::Vector ThrustAllocation::solve(const PlanarForce& wanted) const {
  using Program = BoxProgram<kMaxVariables>;
  // Forces are scaled by the largest one, so that kEffort needs no unit.
  const double scale =
      std::max(problem_.B.leftCols(problem_.size).topRows(2).cwiseAbs().maxCoeff(), 1e-9);
  const Columns B = weights_.asDiagonal() * problem_.B / scale;
  const PlanarForce tau = weights_.cwiseProduct(wanted) / scale;
  // Normal equations of the weighted least squares; the effort
  // makes them positive definite where actuators are redundant.
  const Program::Matrix H = Program::Matrix(B.transpose() * B) +
                            kEffort * Program::Matrix::Identity(problem_.size, problem_.size);
  const Vector g = B.transpose() * tau;
  return Program(H, g, problem_.lo, problem_.hi).solve();
}

/// The angle at which a thruster is best asked for a force: ahead where it can turn there, else
/// astern; where both would do, whichever is nearer.
double ThrustAllocation::pointing(const ThrusterParams& thruster, double angle_now,
                                  const Eigen::Vector2d& force) const {
  if (force.norm() < kMinForceToRotate) return angle_now;
  const double ahead = std::atan2(force.y(), force.x());
  const double astern = wrap_to_pi(ahead + kPi);
  const bool can_ahead = std::abs(ahead) <= thruster.max_angle;
  const bool can_astern = std::abs(astern) <= thruster.max_angle && least(thruster) < 0.0;
  const bool astern_is_nearer = std::abs(astern - angle_now) < std::abs(ahead - angle_now);
  const double angle = can_astern && (!can_ahead || astern_is_nearer) ? astern : ahead;
  return std::clamp(angle, -thruster.max_angle, thruster.max_angle);
}

void ThrustAllocation::steer(const PlanarForce& wanted, double u, double dt_s) {
  const auto& thrusters = model_.thrusters;
  problem_.resize(static_cast<int>(count_forces(model_)));
  for (const ThrusterParams& thruster : thrusters) {
    const double full = largest(thruster);
    const bool is_free = turns(thruster);
    problem_.add(full * direction(thruster.yaw), thruster.position, least(thruster) / full,
                 most(thruster) / full);
    // A thruster that turns is a force along and one across its mounting; the limit of its angle
    // becomes the bound of the force across.
    if (is_free) {
      const double aside = std::sin(std::min(thruster.max_angle, 0.5 * kPi));
      problem_.add(full * direction(thruster.yaw + 0.5 * kPi), thruster.position, -aside, aside);
    }
  }
  add_rudders(u);
  const Vector forces = solve(wanted);
  // The second pass turns each thruster towards its force, at its rate.
  std::size_t angle_command = thrusters.size();
  for (std::size_t i = 0, variable = 0; i < thrusters.size(); ++i, ++variable) {
    if (!turns(thrusters[i])) continue;
    const auto at = static_cast<Eigen::Index>(variable++);
    double& angle = angles_rad_[i];
    const double target = pointing(thrusters[i], angle, {forces[at], forces[at + 1]});
    const double turn = thrusters[i].angle_rate * dt_s;
    angle += std::clamp(target - angle, -turn, turn);
    commands_[angle_command++] = target;
  }
}

PlanarForce ThrustAllocation::allocate(const PlanarForce& wanted, double u, double dt_s) {
  const auto& thrusters = model_.thrusters;
  // Angles first; thrusts are then allocated at the angles that the thrusters have by now.
  if (std::any_of(thrusters.begin(), thrusters.end(), turns)) steer(wanted, u, dt_s);
  problem_.resize(static_cast<int>(thrusters.size() + model_.rudders.size()));
  for (std::size_t i = 0; i < thrusters.size(); ++i) {
    const double full = largest(thrusters[i]);
    problem_.add(full * direction(thrusters[i].yaw + angles_rad_[i]), thrusters[i].position,
                 least(thrusters[i]) / full, most(thrusters[i]) / full);
  }
  add_rudders(u);
  const Vector forces = solve(wanted);
  for (std::size_t i = 0; i < thrusters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    commands_[i] = command_for(thrusters[i], forces[at] * largest(thrusters[i]));
  }
  // A rudder's variable is its part of the largest useful angle: lift is linear in the angle there.
  const std::size_t first_rudder = commands_.size() - model_.rudders.size();
  for (std::size_t i = 0; i < model_.rudders.size(); ++i) {
    const RudderParams& rudder = model_.rudders[i];
    const double angle = std::min(rudder.max_angle, rudder.stall_angle);
    commands_[first_rudder + i] = forces[static_cast<Eigen::Index>(thrusters.size() + i)] * angle;
  }
  return problem_.B * forces;
}

}  // namespace trident::control
