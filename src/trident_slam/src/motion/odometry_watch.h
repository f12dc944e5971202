// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "trident_base/se2.h"

namespace trident::slam {

/// Notices odometry that says nothing: it stays where it is, or where a little noise leaves it,
/// while scans show that the robot moves; its position, its heading, or both. A robot that stands
/// does not move by its scans either. Drivers that repeat their latest pose for a few scans are
/// waited for, the longer the more way odometry has told before.
class OdometryWatch {
 public:
  /// After each scan: the motion since the last one as odometry told it and as the scans showed it.
  /// `is_shown` false: the scan showed nothing of it.
  void add(const SE2& T_told, const SE2& T_seen, bool is_shown);

  bool is_silent() const { return position_.is_silent || heading_.is_silent; }
  /// Of the two the heading may be told (by a gyro) where the position is not.
  bool tells_heading() const { return !heading_.is_silent && heading_.has_ever_told; }
  /// Scans since it last told anything.
  int scans() const { return position_.is_silent ? position_.scans : heading_.scans; }
  /// What was seen meanwhile, from end to end [m], [rad].
  double seen_metres() const { return position_.T_seen.p.norm(); }
  double seen_radians() const { return std::abs(heading_.seen_radians); }

 private:
  /// Since odometry was last seen to move, in position or in heading.
  struct Still {
    SE2 T_told;
    SE2 T_seen;
    double told_metres = 0.0;   ///< all along
    double told_radians = 0.0;  ///< whole turns counted
    double seen_radians = 0.0;
    double largest_turn = 0.0;  ///< seen [rad]
    int scans = 0;
    bool is_silent = false;
    bool has_ever_told = false;

    void add(const SE2& told, const SE2& seen, bool is_shown);
    void restart(bool has_told);
  };
  bool is_patient() const { return told_metres_ + told_radians_ > 0.5; }

  Still position_;
  Still heading_;
  double told_metres_ = 0.0;  ///< since the start, or since it was silent
  double told_radians_ = 0.0;
};

}  // namespace trident::slam
