// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "planning/curves/motion_set.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// One motion of a control set, in the form of Nav2's files.
struct LatticeTrajectory {
  int start_angle_index = 0;
  int end_angle_index = 0;
  bool left_turn = true;
  double radius_m = 0.0;  ///< 0: straight, or a turn on the spot.
  double length_m = 0.0;  ///< 0: a turn on the spot.
  double arc_length_m = 0.0;
  double straight_length_m = 0.0;
  std::vector<Pose2> poses;  ///< From the start, which may be left out, to the end; headings in the
                             ///< frame of the set [m, rad].
};

/// A control set of Nav2's State Lattice planner.
struct LatticeSet {
  std::string motion_model = "ackermann";  ///< diff, ackermann or omni.
  double turning_radius_m = 0.5;
  double resolution_m = 0.05;          ///< Of the grid that the motions fit.
  std::vector<double> heading_angles;  ///< [rad]
  std::vector<LatticeTrajectory> trajectories;
};

/// What a control set is made for.
struct LatticeOptions {
  std::string motion_model = "ackermann";
  double turning_radius_m = 0.5;  ///< Of a car, or of a vessel's turning circle.
  double resolution_m = 0.05;
  int headings = 16;  ///< 8, 16 or 32.
};

/// Reads Nav2's JSON form; `label` names the text in errors. Throws Error naming label, field,
/// value and legal range.
LatticeSet parse_lattice(const std::string& text, const std::string& label);
/// The same of a file.
LatticeSet load_lattice(const std::string& path);
/// The set in Nav2's JSON form.
std::string lattice_json(const LatticeSet& set);

/// Makes a control set: from each heading the shortest straight line between cells' centers, and to
/// each heading up to three steps away the shortest line and arc of at least the turning radius
/// (after Pivtoraiko, Knepper, Kelly, J. Field Robotics 26, 2009). diff: also turns on the spot;
/// omni: also sideways. Throws Error naming option, value and legal values.
LatticeSet make_lattice(const LatticeOptions& options);

/// Costs of a lattice's motions.
struct LatticeCosts {
  float turning = 1.05F;   ///< Factor of arcs.
  float change = 0.0F;     ///< Added to it where the side of turning changes.
  float reversing = 2.0F;  ///< Factor of backward motion.
  float rotation = 5.0F;   ///< Of a turn on the spot, in lengths of cells.
  bool reverses = false;   ///< Each motion also backwards.
};

/// The motions of a set for a search, with poses at most `spacing_m` apart.
MotionSet lattice_motions(const LatticeSet& set, const LatticeCosts& costs, double spacing_m);

}  // namespace trident::nav
