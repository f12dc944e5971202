// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hull_params.h"
#include "marine/environment/water.h"
#include "trident_base/se3.h"

namespace trident::sim {

/// What the water's own motion is for a hull that is not small: about CO, body axes.
struct HullWater {
  Vector6d velocity = Vector6d::Zero();
  Vector6d acceleration = Vector6d::Zero();  ///< inertial
};

struct HullLoad {
  Vector6d wrench = Vector6d::Zero();  ///< hydrostatics and Froude-Krylov, about CO, body axes
  HullWater water;
  double displaced_m3 = 0.0;
};

/// Figures of the upright hull, immersed to its design waterline (CO's plane); x from CO.
struct Hydrostatics {
  double displaced_m3 = 0.0;
  double waterplane_m2 = 0.0;
  double center_of_buoyancy_x_m = 0.0, center_of_buoyancy_z_m = 0.0;
  double center_of_flotation_x_m = 0.0;
  double inertia_transverse_m4 = 0.0;    ///< of the waterplane about the x axis
  double inertia_longitudinal_m4 = 0.0;  ///< about the transverse axis through CF

  /// Metacentric heights above a centre of gravity at `z_cg` from CO [m].
  double gm_transverse_m(double z_cg) const;
  double gm_longitudinal_m(double z_cg) const;
};

/// Where a hull comes to rest: z of CO above the still water, and its pitch (REP 103: bow down >
/// 0).
struct StaticPose {
  double z_m = 0.0;
  double pitch_rad = 0.0;
};

/// Hulls cut into sections. By Gauss' theorem the pressure on a wetted section pushes as
/// rho integral (g + a) dV over the immersed volume: buoyancy, and Froude-Krylov by the water's
/// acceleration a, which carries the attenuation with depth. The tilt of the surface against a
/// section moves its centre of buoyancy by its own waterplane's inertia (wall-sided formula), so
/// that few sections do.
class Hull {
 public:
  Hull(const HullParams& params, double water_density, double gravity_m_s2);

  bool empty() const { return slices_.empty(); }
  HullLoad load(const SE3& T_world_co, const Water& water, double time_s) const;
  Hydrostatics hydrostatics() const;
  /// In still water at level 0, without roll. Throws Error when the hull cannot carry the mass.
  StaticPose rest(double mass_kg, const Eigen::Vector3d& center_of_gravity) const;

 private:
  struct Slice {
    HullSection section;
    double y_m;
    /// Depths below the surface at which the water is sampled: the centre of buoyancy, for
    /// Froude-Krylov, and the mean draft, for what moves with the hull's bottom.
    std::array<double, 2> depths_m;
  };
  struct Accumulator;
  void add_slice(const Slice& slice, const SE3& T_world_co, const Water& water, double time_s,
                 Accumulator* sum) const;

  std::vector<Slice> slices_;
  double density_;
  double gravity_;
};

/// Geometry of a section immersed to `height_m` above its keel.
struct Immersion {
  double area_m2 = 0.0;
  double centroid_m = 0.0;  ///< above the keel
  double breadth_m = 0.0;   ///< at the surface
};
Immersion immersion(const HullSection& section, double height_m);

}  // namespace trident::sim
