// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "trident_base/span.h"
#include "trident_control/vessel_control_params.h"
#include "trident_control/vessel_model.h"

namespace trident::control {

/// Shares a force out to fixed and turning thrusters and to rudders, within their limits.
///
/// Of forces f with effects B f the ones with the least
///   |W (B f - tau)|^2 + eps |f|^2,   f within the limits,
/// are taken, which is a quadratic program with bounds, solved exactly by an active set. W sets
/// what is kept when not everything can be given: yaw before surge, as a rule. Where thrusters turn
/// it is solved twice: once with the force of each as a vector, which gives its angle, then with
/// the angles that they have by then (at their rate, as they were commanded) for the thrusts.
/// Commands come from the inverse of each thruster's curve. Nothing is allocated on the heap.
class ThrustAllocation {
 public:
  /// Forces that the quadratic program can have; sizes its matrices on the stack.
  static constexpr int kMaxVariables = 24;

  /// Throws Error for a vessel with more actuators than that (a thruster that turns counts twice).
  ThrustAllocation(const VesselModel& model, const AllocationParams& params);

  /// What each command is for, below the vessel's namespace and in the order of commands():
  /// thrusters/<name>_thrust_cmd of each thruster, thrusters/<name>_thrust_angle [rad] of those
  /// that turn, rudders/<name>_angle [rad].
  const std::vector<std::string>& topics() const { return topics_; }

  /// Works out the commands that give `wanted` at the surge speed `u` [m/s], and returns what of it
  /// the limits allow. What a propeller's curve and dead band leave out of that is not in it.
  PlanarForce allocate(const PlanarForce& wanted, double u, double dt_s);
  /// Of the last allocate(), in the order of topics(). Valid as long as the object.
  Span<const double> commands() const { return commands_; }
  /// All commands zero.
  void rest();

  /// Whether surge, sway and yaw can be pushed one by one: by turning thrusters, or without.
  bool can_push_everywhere() const { return rank_ == 3; }
  /// The same without waiting for a thruster to turn.
  bool can_push_everywhere_at_once() const { return rank_of_fixed_ == 3; }

 private:
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxVariables, 1>;
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxVariables>;
  /// Effects and limits of the variables; a variable of 1 is an actuator's largest force.
  struct Problem {
    Columns B;
    Vector lo, hi;
    int size = 0;
    void resize(int variables);
    void add(const Eigen::Vector2d& force, const Eigen::Vector3d& position, double least,
             double most);
  };
  void weigh();
  void add_rudders(double u);
  Vector solve(const PlanarForce& wanted) const;
  void steer(const PlanarForce& wanted, double u, double dt_s);
  double pointing(const ThrusterParams& thruster, double angle_now,
                  const Eigen::Vector2d& force) const;
  double rudder_force(const RudderParams& rudder, double u) const;

  VesselModel model_;
  PlanarForce weights_;
  std::vector<std::string> topics_;
  std::vector<double> commands_, angles_rad_;  // angles_rad_: of the thrusters, as they are by now
  Problem problem_;
  Eigen::Index rank_ = 0, rank_of_fixed_ = 0;  // of what thrusters push
};

}  // namespace trident::control
