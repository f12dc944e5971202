// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/mac/rate_control.h"

#include <algorithm>
#include <cmath>

namespace trident::sim {
namespace {

// How many frames lie between two probes of a mode: after one that failed, and at most.
constexpr std::uint64_t kAfterFailure = 16, kLatest = 256;
// What a subframe's result weighs, and what a whole frame's does at most.
constexpr double kWeight = 0.08, kMaxWeight = 0.7;
// A report on a slower mode says nothing any more after so many frames.
constexpr std::uint64_t kForgotten = 100;
// Contention, the gap and the acknowledgement about each frame [ns].
constexpr double kOverhead_ns = 43000.0 + 7.5 * 9000.0 + 16000.0 + 32000.0;

}  // namespace

RateControl::RateControl(int width_mhz, bool has_short_guard)
    : width_mhz_(width_mhz), has_short_guard_(has_short_guard) {}

double RateControl::goodput(int mcs, std::size_t bytes) const {
  const auto duration_ns =
      static_cast<double>(vht::duration_ns(mcs, width_mhz_, has_short_guard_, bytes));
  return modes_[static_cast<std::size_t>(mcs)].success * static_cast<double>(bytes) /
         (duration_ns + kOverhead_ns);
}

int RateControl::faster(int mcs) const {
  const int next = mcs + 1;
  return vht::is_mode(next, width_mhz_) ? next : mcs;
}

int RateControl::slower(int mcs) const { return std::max(mcs - 1, 0); }

// A slower mode is no worse than this one, and as good as can be if little is known about it.
void RateControl::step_down(std::size_t bytes) {
  while (best_ > 0) {
    Mode& below = modes_[static_cast<std::size_t>(slower(best_))];
    if (frames_ - below.frame > kForgotten) below.success = 1.0;
    below.success = std::max(below.success, modes_[static_cast<std::size_t>(best_)].success);
    if (goodput(slower(best_), bytes) <= goodput(best_, bytes)) return;
    modes_[static_cast<std::size_t>(best_)].interval = kAfterFailure;
    best_ = slower(best_);
    probed_frame_ = frames_;
  }
}

RateChoice RateControl::choose(std::size_t bytes) {
  ++frames_;
  step_down(bytes);
  const int next = faster(best_);
  const bool is_due = frames_ - probed_frame_ >= modes_[static_cast<std::size_t>(next)].interval;
  if (next == best_ || !is_due) return {best_, false};
  probed_frame_ = frames_;
  return {next, true};
}

void RateControl::report(int mcs, std::size_t sent, std::size_t acknowledged) {
  if (sent == 0) return;
  Mode& mode = modes_[static_cast<std::size_t>(mcs)];
  const double share = static_cast<double>(acknowledged) / static_cast<double>(sent);
  const double weight =
      std::min(1.0 - std::pow(1.0 - kWeight, static_cast<double>(sent)), kMaxWeight);
  const bool is_probe = mcs > best_;
  mode.success += (is_probe ? 0.5 : weight) * (share - mode.success);
  mode.frame = frames_;
  if (!is_probe) return;
  constexpr std::size_t kProbeBytes = 1500;
  const bool is_better = goodput(mcs, kProbeBytes) > goodput(best_, kProbeBytes);
  if (is_better) {
    best_ = mcs;
    return;
  }
  // The less of it arrives, the longer nobody asks again.
  const std::uint64_t longer = acknowledged > 0 ? mode.interval : 2 * mode.interval;
  mode.interval = std::clamp(longer, kAfterFailure, kLatest);
}

}  // namespace trident::sim
