// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planning/curves/motion_curve.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// A motion of fixed form between two headings of a set. Lengths in cells, angles in radians.
struct Primitive {
  double dx = 0.0;  ///< Of the end from the start, in the frame of the set.
  double dy = 0.0;
  float length = 0.0F;  ///< What its cost is taken for.
  float factor = 1.0F;  ///< Of its cost.
  float change = 0.0F;  ///< Added to the factor after a turn to another side.
  std::uint16_t start_heading = 0;
  std::uint16_t end_heading = 0;
  std::int8_t turn = 0;  ///< 1: to the left, -1: to the right, 0: neither.
  bool reverses = false;
  std::uint32_t first_pose = 0;
  std::uint32_t pose_count = 0;
};

/// The motions that a search puts together: for each of a finite number of headings those that
/// begin there, with poses in between.
class MotionSet {
 public:
  /// `headings` in [-pi, pi], at most 65535 of them.
  explicit MotionSet(std::vector<double> headings);

  /// Adds a motion that begins at the heading of the last one or at a later one. `poses`: offsets
  /// from its start in the frame of the set [cells], and headings less that of the start; without
  /// the start, the end is the last.
  void add(Primitive primitive, const std::vector<Pose2>& poses);
  /// After the last motion.
  void finish();

  std::size_t heading_count() const { return headings_.size(); }
  double heading(std::size_t i) const { return headings_[i]; }
  std::size_t nearest_heading(double yaw) const;
  const std::vector<Primitive>& primitives() const { return primitives_; }
  /// The motions that begin at a heading: from begin(h) up to begin(h + 1).
  std::uint32_t begin(std::size_t heading) const { return first_[heading]; }
  const Pose2* poses(const Primitive& p) const { return &poses_[p.first_pose]; }
  /// The longest distance between the ends of a motion [cells].
  double longest() const { return longest_; }

 private:
  std::vector<double> headings_;
  std::vector<Primitive> primitives_;
  std::vector<std::uint32_t> first_;
  std::vector<Pose2> poses_;
  double longest_ = 0.0;
};

/// What arcs a set is made of.
struct ArcMotions {
  MotionModel model = MotionModel::kDubins;
  double radius = 8.0;        ///< Of the tightest arc [cells].
  int headings = 72;          ///< Number of headings, evenly spaced.
  bool interpolates = false;  ///< Also the wider arcs to the headings in between.
  double pose_spacing = 0.2;  ///< Between the poses of a motion, at most [cells].
  float turning = 1.0F;       ///< Factors of costs.
  float change = 0.0F;
  float reversing = 1.0F;
};

/// A straight line and arcs to both sides from each heading; backwards, too, in the model of Reeds
/// and Shepp. All leave their cell: their chord is not shorter than its diagonal.
MotionSet arc_motions(const ArcMotions& options);

/// The same motions, driven from their ends to their starts: a search with them goes from a goal to
/// where it can be reached from.
MotionSet reversed(const MotionSet& motions);

}  // namespace trident::nav
