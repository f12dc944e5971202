// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "dead_end_escape.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::nav {
namespace {

double moved_m(const Pose2& from, const Pose2& to) { return distance(from.x, from.y, to.x, to.y); }

double turned(const Pose2& from, const Pose2& to) {
  return std::fabs(wrap_angle(to.yaw - from.yaw));
}

}  // namespace

double DeadEndEscape::distance_m() const {
  const double wanted_m = std::ldexp(limits_.distance_m, count_ - 1);
  return std::max(limits_.distance_m, std::min(wanted_m, 0.5 * limits_.leaving_m));
}

bool DeadEndEscape::is_over(const Pose2& pose) const {
  return from_ && (moved_m(*from_, pose) > distance_m() ||
                   (!is_straight() && turned(*from_, pose) > limits_.turn));
}

bool DeadEndEscape::has_left(const Pose2& pose) const {
  return dead_end_ &&
         (moved_m(*dead_end_, pose) > limits_.leaving_m || turned(*dead_end_, pose) > 0.5 * kPi);
}

bool DeadEndEscape::update(const RobotState& state) {
  if (is_over(state.pose)) from_.reset();
  if (has_left(state.pose)) {
    dead_end_.reset();
    count_ = 0;
  }
  if (standstill_.update(state)) return false;
  standstill_.reset();
  standstill_.update(state);
  return true;
}

void DeadEndEscape::begin(const RobotState& state, bool is_straight) {
  if (!dead_end_) dead_end_ = state.pose;
  if (!from_) {
    from_ = state.pose;
    ++count_;
  }
  if (is_straight) count_ = std::max(count_, 2);
}

}  // namespace trident::nav
