// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "odometry_watch.h"

#include <algorithm>

namespace trident::slam {
namespace {

/// Odometry that is farther from where it stood has reported a motion [m], [rad].
constexpr double kStill = 0.02;

/// What must be seen before odometry that stands is not believed, and in how many scans, ...
struct Patience {
  int scans;
  double distance;  ///< [m]
  double heading;   ///< [rad]
};
/// ... where it has reported motions before, and where not.
constexpr Patience kPatient{8, 0.15, 0.15};
constexpr Patience kWary{3, 0.05, 0.05};
/// A laser that is not mounted where it is configured to be circles the robot when that turns on
/// the spot: by so much [m/rad].
constexpr double kMountError = 0.5;
/// Odometry that reports no rotation may still be off by this [rad/m] on a straight path.
constexpr double kDrift = 0.15;
/// What these two excuse is bounded: longer rotations and paths are judged in pieces [rad], [m].
constexpr double kLongestTurn = 0.5;
constexpr double kMaxPathLength = 2.0;

}  // namespace

void OdometryWatch::Still::restart(bool has_reported) {
  const bool had_reported = has_ever_reported;
  *this = Still();
  has_ever_reported = has_reported || had_reported;
}

void OdometryWatch::Still::add(const SE2& reported, const SE2& seen, bool is_shown) {
  T_reported = T_reported * reported;
  reported_meters += reported.p.norm();
  reported_radians += reported.angle;
  if (!is_shown) return;
  ++scans;
  T_seen = T_seen * seen;
  seen_radians += seen.angle;
  largest_turn = std::max(largest_turn, std::abs(seen_radians));
}

/// Scans that show more motion than the error of a mount or a drift explains, while odometry
/// reports none, show that it is silent.
void OdometryWatch::judge_silence(double path_length) {
  const Patience& patience = is_patient() ? kPatient : kWary;
  if (position_.scans >= patience.scans &&
      position_.T_seen.p.norm() > patience.distance + kMountError * position_.largest_turn) {
    position_.is_silent = true;
  }
  if (heading_.scans >= patience.scans &&
      std::abs(heading_.seen_radians) > patience.heading + kDrift * path_length) {
    heading_.is_silent = true;
  }
}

/// Judges long rotations and paths in pieces: what a mount and a drift excuse is bounded.
void OdometryWatch::end_long_pieces(double path_length) {
  if (!position_.is_silent && position_.largest_turn > kLongestTurn) position_.restart(false);
  if (!heading_.is_silent && path_length > kMaxPathLength) heading_.restart(false);
}

void OdometryWatch::add(const SE2& T_reported, const SE2& T_seen, bool is_shown) {
  for (Still* still : {&position_, &heading_}) still->add(T_reported, T_seen, is_shown);
  reported_meters_ += T_reported.p.norm();
  reported_radians_ += std::abs(T_reported.angle);
  const bool was_silent = is_silent();
  if (position_.T_reported.p.norm() > kStill) position_.restart(true);
  if (std::abs(heading_.reported_radians) > kStill) heading_.restart(true);
  const double path_length = heading_.reported_meters + heading_.T_seen.p.norm();
  judge_silence(path_length);
  end_long_pieces(path_length);
  if (!was_silent && is_silent()) reported_meters_ = reported_radians_ = 0.0;
}

}  // namespace trident::slam
