// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/last_command.h"

#include "trident_nav/control/motion.h"

namespace trident::nav {
namespace {

constexpr double kMaxPeriods = 3.0;  // an older command is ignored: others may have come since

}  // namespace

void LastCommand::note(const Twist2& twist, double time_s) {
  twist_ = twist;
  time_s_ = time_s;
  is_known_ = true;
}

Twist2 LastCommand::motion(const RobotState& measured) const {
  const double age_s = measured.time_s - time_s_;
  if (!is_known_ || age_s < 0.0 || age_s > kMaxPeriods * period_s_) return measured.twist;
  return reachable_window(limits_, measured.twist, kMaxDelay_s).clamp(twist_);
}

}  // namespace trident::nav
