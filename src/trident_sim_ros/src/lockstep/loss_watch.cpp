// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "loss_watch.h"

#include <chrono>
#include <cstdio>

namespace trident::sim {
namespace {

/// A broken connection counts after this time without an answer, which may have been in flight.
constexpr WallTime kDisconnectedAfter = 20'000'000;
constexpr double kReportedAfter_s = 1.0;
constexpr double kEndlessPatience = 10.0;  ///< in timeouts

double seconds(WallTime time) { return static_cast<double>(time) * 1e-9; }

}  // namespace

WallTime wall_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f s", seconds);
  return text;
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Remembers who has been waited for the longest, and since when the one at hand has gone.
void LossWatch::note_wait(const Silence& silence, Waiting& waiting, WallTime now) {
  if (waited_for_.empty() || waiting.since < waited_since_) {
    waited_for_ = silence.who;
    waited_since_ = waiting.since;
  }
  if (!silence.is_gone) {
    waiting.gone_since = 0;
  } else if (waiting.gone_since == 0) {
    waiting.gone_since = now;
  }
}

bool LossWatch::gives_up(const Silence& silence, Waiting& waiting, WallTime now) {
  const WallTime waited = now - waiting.since;
  note_wait(silence, waiting, now);
  const bool is_gone = silence.is_gone && waited > kDisconnectedAfter;
  const bool is_silent = seconds(waited) >= silence.patience * rules_.timeout_s;
  if (seconds(waited) >= rules_.timeout_s) stuck_(silence);
  if (!is_gone && !is_silent) return false;
  const std::string why =
      is_gone ? "has disconnected" : silence.what + " for " + seconds_text(seconds(waited));
  // Who may wait for simulated time itself would never answer a world that waits for it.
  const bool is_endless =
      silence.may_wait_for_the_world && seconds(waited) >= kEndlessPatience * rules_.timeout_s;
  if (rules_.policy == LossPolicy::kWait && !is_endless) {
    wait_on(silence, waiting, now, why);
    return false;
  }
  report_silence(silence, why, is_endless);
  if (rules_.policy == LossPolicy::kPause) pause_();
  repeatability_.spoil(silence.who, silence.time, is_gone ? why : silence.what + " in time");
  waiting.end();
  return true;
}

void LossWatch::wait_on(const Silence& silence, Waiting& waiting, WallTime now,
                        const std::string& why) {
  const bool is_gone = waiting.gone_since != 0;
  bool& is_reported = is_gone ? waiting.is_reported_gone : waiting.is_reported;
  if (!is_reported) report_silence(silence, why, false);
  is_reported = true;
  if (!is_gone || seconds(now - waiting.gone_since) < rules_.restart_patience_s) return;
  fail_(silence.who + " has died at t = " + seconds_text(silence.time.seconds()) +
        ", and has not come back for " + seconds_text(rules_.restart_patience_s));
}

void LossWatch::report_silence(const Silence& silence, const std::string& why, bool is_endless) {
  const bool waits = rules_.policy == LossPolicy::kWait && !is_endless;
  const char* what = waits                                 ? "the world waits"
                     : rules_.policy == LossPolicy::kPause ? "the world is paused"
                                                           : "the world continues without it";
  report_(Severity::kWarning, silence.who + " " + why + "; " + what);
}

std::string LossWatch::waited_for() const {
  if (waited_for_.empty()) return {};
  const double waited_s = seconds(wall_now() - waited_since_);
  if (waited_s < kReportedAfter_s) return {};
  char text[32];
  std::snprintf(text, sizeof(text), " (%.0f s)", waited_s);
  return waited_for_ + text;
}

}  // namespace trident::sim
