// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "trident_base/se2.h"

namespace trident::slam {

/// Notices odometry that says nothing: it stays where it is, or where a little noise leaves it,
/// while scans show that the robot moves; its position, its heading, or both. A robot that stands
/// does not move by its scans either. Drivers that repeat their latest pose for a few scans are
/// waited for, the longer the more distance odometry has reported before.
class OdometryWatch {
 public:
  /// After each scan: the motion since the last one by odometry and by scans.
  /// `is_shown` false: the scan showed nothing of it.
  void add(const SE2& T_reported, const SE2& T_seen, bool is_shown);

  bool is_silent() const { return position_.is_silent || heading_.is_silent; }
  /// The heading may be reported (by a gyro) where the position is not.
  bool reports_heading() const { return !heading_.is_silent && heading_.has_ever_reported; }
  /// Scans since it last reported anything.
  int scans() const { return position_.is_silent ? position_.scans : heading_.scans; }
  /// What was seen meanwhile, from end to end [m], [rad].
  double seen_meters() const { return position_.T_seen.p.norm(); }
  double seen_radians() const { return std::abs(heading_.seen_radians); }

 private:
  /// Since odometry was last seen to move, in position or in heading.
  struct Still {
    SE2 T_reported;
    SE2 T_seen;
    double reported_meters = 0.0;   ///< all along
    double reported_radians = 0.0;  ///< whole turns counted
    double seen_radians = 0.0;
    double largest_turn = 0.0;  ///< seen [rad]
    int scans = 0;
    bool is_silent = false;
    bool has_ever_reported = false;

    void add(const SE2& reported, const SE2& seen, bool is_shown);
    void restart(bool has_reported);
  };
  void judge_silence(double path_length);
  void end_long_pieces(double path_length);
  bool is_patient() const { return reported_meters_ + reported_radians_ > 0.5; }

  Still position_;
  Still heading_;
  double reported_meters_ = 0.0;  ///< since the start, or since it was silent
  double reported_radians_ = 0.0;
};

}  // namespace trident::slam
