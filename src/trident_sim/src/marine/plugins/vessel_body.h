// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/plugins/plugin_util.h"
#include "marine/vessel/vessel_dynamics.h"
#include "marine/vessel/vrx_hull.h"
#include "trident_sim/sea.h"

namespace trident::sim {

/// How a vessel lies in the water as a step begins.
struct Afloat {
  SE3 T_world_co;
  Vector6d nu = Vector6d::Zero();  ///< of CO over ground, body axes
  HullLoad load;

  Vector6d nu_r() const { return nu - load.water.velocity; }
};

/// Of plugins that float, for the sea that comes after them.
class Floating {
 public:
  virtual ~Floating() = default;
  /// Throws Error when the vessel stands where the water does not carry it.
  virtual void check_afloat(const Sea& sea) const = 0;
};

/// A link's body as a vessel: its hull in the world's sea, damping and added mass.
class VesselBody {
 public:
  struct Place {
    SE3 T_link_co;
    /// Added to the level of the world's sea [m]: VRX' vessels have a level of their own.
    double level_m = 0.0;
  };
  /// `vessel` in FLU; mass and inertia of the body count, its own do not. Throws Error as
  /// VesselDynamics does, and as check_afloat() when the world has a sea already.
  VesselBody(const PluginContext& context, Link& link, const VesselParams& vessel,
             const Place& place);

  /// Throws Error naming the figures when the body's mass, centre of gravity or inertia differs by
  /// more than 1 % from the vessel's; of the centre of gravity 1 % of the radius of gyration.
  void check_inertial() const;

  /// Throws Error naming vessel, place, depth there and least depth where the still water is
  /// shallower, now, than the draft below any section of the hull.
  void check_afloat(const Sea& sea) const;

  Afloat sense(World& world, const StepInfo& info);
  /// Pushes the body by the water, the wind and what the vessel's actuators do, about CO, body
  /// axes. What others have put on the body in this step so far is felt with added mass; what comes
  /// later, contacts and joints act on its own mass alone.
  void push(const World& world, const StepInfo& info, const Afloat& now,
            const Vector6d& tau_actuators);

  /// The body's frame has moved in it.
  void body_frames_moved();
  void reset();
  void state(StateArchive& archive);

 private:
  void look_around(World& world);
  Vector6d wind_on_hull(const Afloat& now) const;
  void push_legacy(const StepInfo& info, const Afloat& now, const Vector6d& tau);
  void add_about_cg(const Afloat& now, const Vector6d& wrench);

  std::string owner_;
  Link& link_;
  VesselParams vessel_;
  Place place_;
  SE3 T_body_co_;
  std::unique_ptr<VesselDynamics> dynamics_;
  struct Legacy {
    LegacyVrxForce force;
    VrxHull hull;
  };
  std::optional<Legacy> legacy_;
  double gravity_;
  Hull hull_;
  const World& world_;
  Surroundings around_;
  bool is_reported_ = false;
};

/// A link's body about CO as a vessel's file would have it, FLU.
RigidBody rigid_body_of(const Link& link, const SE3& T_link_co);

/// A link of the model that moves. Throws Error.
Link& moving_link(const PluginContext& context, const std::string& key);

}  // namespace trident::sim
