// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mppi_params.h"
#include "trident_nav/control/control_law.h"

namespace trident::nav {

/// A circle of a footprint's cover, in the base's axes [m].
struct CoverCircle {
  float x = 0.0F;
  float y = 0.0F;
  float radius = 0.0F;
};

/// The numbers that parameters and robot come to.
struct MppiModel {
  MppiMotion motion = MppiMotion::kDiffDrive;
  MotionLimits limits;
  VesselMotion vessel;  ///< Of the motion model Vessel.
  int blocks = 0;       ///< Of kLanes trajectories each.
  int steps = 0;
  double dt_s = 0.0;
  double period_s = 0.0;
  Twist2 noise_std;       ///< Standard deviations of what is sampled [m/s, m/s, rad/s].
  double length_m = 0.0;  ///< Driven in the horizon at full speed.
  /// Of distances along the path and to the goal: what Nav2's weights are tuned for is a horizon of
  /// 1.4 m.
  double distance_scale = 1.0;
  double inscribed_radius = 0.0, circumscribed_radius = 0.0;
  double goal_tolerance_m = 0.0;   ///< Of the position.
  std::vector<CoverCircle> cover;  ///< Circles whose union contains the footprint.

  /// Turns on the spot, so that a heading can be reached after a position.
  bool can_turn() const {
    const bool is_free = motion == MppiMotion::kDiffDrive || motion == MppiMotion::kOmni;
    return is_free || (motion == MppiMotion::kVessel && limits.min_turning_radius <= 0.0);
  }
  double horizon_s() const { return dt_s * steps; }
};

MppiModel make_mppi_model(const MppiParams& params, const ControlSetup& setup);

/// Circles in a row along the longer side of the footprint's bounding box that cover it.
std::vector<CoverCircle> cover_footprint(const Footprint& footprint);

}  // namespace trident::nav
