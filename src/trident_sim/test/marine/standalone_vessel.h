// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/physics/engine_body.h"
#include "marine/environment/current.h"
#include "marine/vessel/vessel_dynamics.h"

namespace trident::sim {

/// What carries a vessel: its hull in the water, or Fossen's linear springs about CO.
enum class Restoring { kHull, kLinear, kNone };

/// A vessel alone in the sea, moved by the simulator's own integrator for free bodies, which gets
/// gravity and the wrench of VesselDynamics as from a plugin.
class StandaloneVessel {
 public:
  explicit StandaloneVessel(const VesselParams& params, Restoring restoring = Restoring::kHull,
                            double gravity_m_s2 = 9.81);

  const VesselDynamics& dynamics() const { return dynamics_; }
  const Hull& hull() const { return hull_; }
  /// Springs of Restoring::kLinear, force -G (0, 0, z, roll, pitch, 0).
  void set_springs(const Matrix6d& G) { springs_ = G; }
  void set_pose(const SE3& T_world_co);
  /// At the place where the hull rests in still water.
  void set_at_rest();
  void set_nu(const Vector6d& nu);

  SE3 T_world_co() const;
  Vector6d nu() const;
  double time_s() const { return time_s_; }
  /// Kinetic energy of boat and added mass in water at rest, and potential of springs and weight.
  double kinetic_energy() const;

  /// `tau`: thrust and the like about CO, body axes.
  void step(const Vector6d& tau, double dt_s, const Water& water, const Current& current);
  void step(const Vector6d& tau, double dt_s) {
    step(tau, dt_s, StillWater(), Current(CurrentParams{}));
  }

 private:
  Vector6d spring_wrench() const;

  VesselDynamics dynamics_;
  Hull hull_;
  Restoring restoring_;
  double gravity_;
  Matrix6d springs_ = Matrix6d::Zero();
  EngineBody body_;
  double time_s_ = 0.0;
};

/// The shipped parameters of a vessel, e.g. "otter".
VesselParams shipped_vessel(const std::string& name);

}  // namespace trident::sim
