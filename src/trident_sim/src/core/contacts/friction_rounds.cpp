// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Coulomb's law in the exact solver: rounds of ConstraintSolver until the limits of friction follow
// from the normal forces that go with it.
#include <algorithm>
#include <cmath>

#include "constraint_solver.h"

namespace trident::sim {
namespace {

/// Friction may be off by this part of what the largest normal force of the island allows.
constexpr double kTolerance = 1e-3;

/// A box that slides and is about to tip takes three; some that jam have no solution.
constexpr int kMaxRounds = 12;

/// Two rows of a contact that slip less than this stick [m/s].
constexpr double kSticking = 1e-7;

Eigen::Vector3d vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }

/// Velocity of a point of a body in the solution that ODE has, the body being where it was.
Eigen::Vector3d solved_velocity(const EngineBody& body, const Eigen::Vector3d& p_world) {
  return vector_of(dBodyGetLinearVel(body.ode)) +
         vector_of(dBodyGetAngularVel(body.ode)).cross(p_world - body.T_world_body.p);
}

/// Directions of friction as ODE lays them.
std::array<Eigen::Vector3d, 2> tangents(const dContact& contact) {
  const Eigen::Vector3d normal = vector_of(contact.geom.normal);
  if (contact.surface.mode & dContactFDir1) {
    const Eigen::Vector3d first = vector_of(contact.fdir1);
    return {first, normal.cross(first)};
  }
  dVector3 first, second;
  dPlaneSpace(contact.geom.normal, first, second);
  return {vector_of(first), vector_of(second)};
}

/// By how much a force along a direction is off what Coulomb says. `velocity` in that direction;
/// `slip`: what a newton yields of it also where the surfaces stick.
double coulomb_error(double force, double velocity, double slip, double limit) {
  const double sliding = velocity + slip * force;
  if (std::abs(sliding) <= kSticking) return std::max(0.0, std::abs(force) - limit);
  return std::abs(force + std::copysign(limit, sliding));
}

/// The same of a contact, as the normal force that would account for it.
double error_of_normal(const Touch& touch) {
  const dSurfaceParameters& surface = touch.ode.surface;
  const Eigen::Vector3d p_world = vector_of(touch.ode.geom.pos);
  const Eigen::Vector3d force = vector_of(touch.feedback.f1);
  Eigen::Vector3d velocity = solved_velocity(*touch.a, p_world);
  if (touch.b != nullptr) velocity -= solved_velocity(*touch.b, p_world);
  const auto directions = tangents(touch.ode);
  const double slip[] = {surface.slip1, surface.slip2};
  double error = 0.0;
  for (int i = 0; i < 2; ++i) {
    if (!(touch.mu[i] > 0.0) || !std::isfinite(touch.mu[i])) continue;
    error = std::max(error, coulomb_error(force.dot(directions[i]), velocity.dot(directions[i]),
                                          slip[i], touch.mu[i] * touch.normal_n) /
                                touch.mu[i]);
  }
  return error;
}

}  // namespace

void ConstraintSolver::refine_friction(Pass pass, double dt_s) {
  for (int round = 0; round < kMaxRounds && measure_friction(); ++round) {
    relax_friction(round == 0);
    put_back_active();
    make_joints(pass, true);
    solve_small(dt_s);
  }
}

/// Leaves those islands active in which friction is off; false without any.
bool ConstraintSolver::measure_friction() {
  for (Touch& touch : touches_) {
    const std::size_t island = island_of(touch);
    if (active_[island]) friction_[island].error_n = friction_[island].largest_n = 0.0;
  }
  for (Touch& touch : touches_) {
    const std::size_t island = island_of(touch);
    if (!active_[island]) continue;
    touch.normal_n = vector_of(touch.feedback.f1).dot(vector_of(touch.ode.geom.normal));
    Friction& friction = friction_[island];
    friction.largest_n = std::max(friction.largest_n, touch.normal_n);
    friction.error_n = std::max(friction.error_n, error_of_normal(touch));
  }
  bool any = false;
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    const std::size_t island = held_.islands[i];
    if (held_.bodies[i]->number != island || !active_[island]) continue;
    const Friction& friction = friction_[island];
    active_[island] = friction.error_n > kTolerance * friction.largest_n;
    any = any || active_[island];
  }
  return any;
}

/// The next limits: those of the normal forces that were found, then on the line through the last
/// two rounds (Aitken's relaxation, see U. Kuettler, W. Wall, Comput. Mech. 43, 2008, eq. 44).
void ConstraintSolver::relax_friction(bool first) {
  constexpr double kMinRelaxation = 0.1, kMaxRelaxation = 10.0;
  for (const std::size_t island : held_.islands) {
    friction_[island].toward = friction_[island].squared_change = 0.0;
    if (first) friction_[island].relaxation = 1.0;
  }
  for (Touch& touch : touches_) {
    Friction& friction = friction_[island_of(touch)];
    if (first) touch.limiting_normal_n = touch.normal_n, touch.change_n = 0.0;
    const double change = touch.normal_n - touch.limiting_normal_n;
    friction.toward += touch.change_n * (change - touch.change_n);
    friction.squared_change += (change - touch.change_n) * (change - touch.change_n);
    touch.change_n = change;
  }
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    if (held_.bodies[i]->number != held_.islands[i]) continue;
    Friction& friction = friction_[held_.islands[i]];
    if (friction.toward == 0.0 || !(friction.squared_change > 0.0)) continue;
    friction.relaxation =
        std::clamp(-friction.relaxation * friction.toward / friction.squared_change, kMinRelaxation,
                   kMaxRelaxation);
  }
  for (Touch& touch : touches_) {
    const double relaxation = friction_[island_of(touch)].relaxation;
    touch.limiting_normal_n = std::max(0.0, touch.limiting_normal_n + relaxation * touch.change_n);
  }
}

}  // namespace trident::sim
