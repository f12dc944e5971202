// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// Whether a footprint covers a part of a lethal cell, exactly: the polygon's inside and border
/// against the cells' squares. A footprint without points is a circle, which is in contact where
/// the costmap's inflation says so (a cost of at least 253 at its center).
///
/// Where the distance field is far from any obstacle one look-up decides; else the polygon is cut
/// into rows of cells, which are compared with a bitmap. Made once per change of the costs.
class FootprintContact {
 public:
  enum class Unknown { kFree, kBlocked };

  FootprintContact() = default;
  FootprintContact(const CostGrid& grid, const Footprint& footprint, Unknown unknown);

  /// True also where the footprint reaches over the grid's border.
  bool in_contact(const Pose2& pose) const;
  /// How far the pose can move in any direction, turning included, and surely be free [m]: the
  /// distance that is left around the circumscribed circle. 0: look closer.
  double margin(const Pose2& pose) const;
  /// From now on the cells under the footprint at this pose are free: the robot stands there, so
  /// that what is marked there is no obstacle. For a circle those at 253 within two radii, too.
  void ignore_under(const Pose2& pose);
  /// From now on, within two circumscribed radii of a pose, the footprint counts as smaller by a
  /// depth [m]: a robot that stands a little in an obstacle can leave it. False, and nothing
  /// changes: the smaller one is in contact at the pose, too, or the footprint has no points.
  bool let_leave(const Pose2& pose, double depth_m);
  const Footprint& footprint() const { return footprint_; }

 private:
  /// Cells [from, to] of one row.
  struct Span {
    int from = 0;
    int to = -1;
  };

  template <class Visit>
  bool any_span(const Pose2& pose, Visit&& visit) const;
  bool blocks(std::uint8_t cost) const {
    return cost == kLethalCost || (cost == kUnknownCost && unknown_blocks_);
  }
  bool row_blocked(int y, Span span) const;
  const Footprint& footprint_at(const Pose2& pose) const;
  bool convex_in_contact(const Pose2& pose) const;
  bool circle_in_contact(const Pose2& pose) const;

  CostGrid grid_;
  Footprint footprint_;
  bool unknown_blocks_ = false;
  bool is_convex_ = false;
  int words_ = 0;
  bool ignores_ = false;
  Pose2 ignored_;                       ///< Of a circle.
  Footprint smaller_;                   ///< Without points: none.
  Pose2 left_;                          ///< Where the smaller footprint counts.
  std::vector<std::uint64_t> blocked_;  ///< One bit per cell, rows of `words_`.
};

/// The footprint of a robot whose parameters give none: a circle of the inscribed radius, without
/// points, stays as it is; otherwise the points are made counter-clockwise and the radii computed.
Footprint completed(Footprint footprint);

}  // namespace trident::nav
