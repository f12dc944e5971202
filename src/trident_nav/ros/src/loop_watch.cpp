// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/loop_watch.h"

#include <cstdio>

namespace trident::nav {

void LoopWatch::begin(double now_s, double wall_s, double period_s) {
  if (has_begun_) {
    current_.period_s = now_s - begun_s_;
    if (current_.period_s > (1.0 + kTolerance) * current_.wanted_s) {
      ++missed_;
      ++unlogged_;
      if (current_.period_s > worst_.period_s) worst_ = current_;
    }
  }
  has_begun_ = true;
  begun_s_ = now_s;
  noted_wall_s_ = wall_s;
  current_ = {};
  current_.wanted_s = period_s;
}

void LoopWatch::note(const char* step, double wall_s) {
  const double took_s = wall_s - noted_wall_s_;
  noted_wall_s_ = wall_s;
  current_.steps_s += took_s;
  if (took_s <= current_.step_s) return;
  current_.step_s = took_s;
  current_.step = step;
}

std::string LoopWatch::take_text(double now_s) {
  constexpr double kPeriod_s = 1.0;
  const bool is_early = now_s >= logged_s_ && now_s - logged_s_ < kPeriod_s;
  if (unlogged_ == 0 || is_early) return "";
  char text[256];
  const bool is_own = worst_.steps_s > worst_.wanted_s;
  std::snprintf(text, sizeof text,
                "The control loop missed %d of its periods of %.3f s; the longest was %.3f s. %s "
                "took longest in it, %.3f s%s.",
                unlogged_, worst_.wanted_s, worst_.period_s, worst_.step, worst_.step_s,
                is_own ? "" : ", and all steps fit into the period: the processor was elsewhere");
  logged_s_ = now_s;
  unlogged_ = 0;
  worst_ = {};
  return text;
}

}  // namespace trident::nav
