// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "odometry_watch.h"

#include <algorithm>

namespace trident::slam {
namespace {

/// Odometry that is farther from where it stood has told something [m], [rad].
constexpr double kStill = 0.02;

/// What must be seen before odometry that stands is not believed, and in how many scans, ...
struct Patience {
  int scans;
  double distance;  ///< [m]
  double heading;   ///< [rad]
};
/// ... where it has told motions before, and where not.
constexpr Patience kPatient{8, 0.15, 0.15};
constexpr Patience kWary{3, 0.05, 0.05};
/// A laser that does not sit where it is told to goes round the robot when that turns on the spot:
/// by so much [m/rad].
constexpr double kMountError = 0.5;
/// Odometry that tells no turn may still be off by this [rad/m] on a straight way.
constexpr double kDrift = 0.15;
/// What these two excuse is bounded: longer turns and ways are looked at in pieces [rad], [m].
constexpr double kLongestTurn = 0.5;
constexpr double kLongestWay = 2.0;

}  // namespace

void OdometryWatch::Still::restart(bool has_told) {
  const bool has_told_before = has_ever_told;
  *this = Still();
  has_ever_told = has_told || has_told_before;
}

void OdometryWatch::Still::add(const SE2& told, const SE2& seen, bool is_shown) {
  T_told = T_told * told;
  told_metres += told.p.norm();
  told_radians += told.angle;
  if (!is_shown) return;
  ++scans;
  T_seen = T_seen * seen;
  seen_radians += seen.angle;
  largest_turn = std::max(largest_turn, std::abs(seen_radians));
}

void OdometryWatch::add(const SE2& T_told, const SE2& T_seen, bool is_shown) {
  for (Still* still : {&position_, &heading_}) still->add(T_told, T_seen, is_shown);
  told_metres_ += T_told.p.norm();
  told_radians_ += std::abs(T_told.angle);
  const bool was_silent = is_silent();
  if (position_.T_told.p.norm() > kStill) position_.restart(true);
  if (std::abs(heading_.told_radians) > kStill) heading_.restart(true);
  const Patience& patience = is_patient() ? kPatient : kWary;
  if (position_.scans >= patience.scans &&
      position_.T_seen.p.norm() > patience.distance + kMountError * position_.largest_turn) {
    position_.is_silent = true;
  }
  const double way = heading_.told_metres + heading_.T_seen.p.norm();
  if (heading_.scans >= patience.scans &&
      std::abs(heading_.seen_radians) > patience.heading + kDrift * way) {
    heading_.is_silent = true;
  }
  if (!position_.is_silent && position_.largest_turn > kLongestTurn) position_.restart(false);
  if (!heading_.is_silent && way > kLongestWay) heading_.restart(false);
  if (!was_silent && is_silent()) told_metres_ = told_radians_ = 0.0;
}

}  // namespace trident::slam
