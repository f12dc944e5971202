// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "run/repeatability.h"
#include "run/server_options.h"
#include "trident_sim/lockstep.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// Steady wall clock [ns].
WallTime wall_now();
/// "1.25 s".
std::string seconds_text(double seconds);
std::string join(const std::vector<std::string>& words);

/// One whom the world waits for.
struct Waiting {
  WallTime since = 0;       ///< 0: it is not waited for
  WallTime gone_since = 0;  ///< 0: it lives, as far as one knows
  bool is_reported = false, is_reported_gone = false;

  void end() { *this = {}; }
};

/// What happens when one whom the world waits for is silent or has gone. A process that lives, be
/// it slow or stopped, is waited for under LossPolicy::kWait, so that the wall clock decides
/// nothing; one that has died and is not started again ends the run with an error. Under the other
/// policies the world continues (or is paused), and the run is marked as not repeatable. So it is
/// for one that may wait for the world itself, and has been silent for ten timeouts.
class LossWatch {
 public:
  using Action = std::function<void()>;
  using Failure = std::function<void(const std::string&)>;
  struct Silence {
    std::string who;
    std::string what;       ///< it has not done, without "for N s"
    bool is_gone = false;   ///< its connection has ended, or its process
    double patience = 1.0;  ///< in timeouts
    SimTime time;           ///< at which the world stands
    std::function<std::vector<std::string>()> nodes = {};  ///< whose answer is awaited
    /// It may need simulated time to answer, so that waiting has no end: under LossPolicy::kWait it
    /// is given up, too, after ten timeouts.
    bool may_wait_for_the_world = false;
  };
  using Stuck = std::function<void(const Silence&)>;
  /// `pause`: what LossPolicy::kPause does; `fail`: ends the run with an error; `stuck`: called
  /// again and again while one has been silent for a timeout, as it may wait for the world itself.
  LossWatch(const LossRules& rules, Repeatability& repeatability, ReportSink report, Action pause,
            Failure fail, Stuck stuck)
      : rules_(rules),
        repeatability_(repeatability),
        report_(std::move(report)),
        pause_(std::move(pause)),
        fail_(std::move(fail)),
        stuck_(std::move(stuck)) {}

  /// True: it is to be waited for no longer. `waiting.since` is when the world began to wait.
  bool gives_up(const Silence& silence, Waiting& waiting, WallTime now);

  Repeatability& repeatability() { return repeatability_; }
  /// Whom the world waits for at present, and how long it has; "" where it is less than a second.
  std::string waited_for() const;
  /// The world continues.
  void clear() { waited_for_.clear(); }

 private:
  void report_silence(const Silence& silence, const std::string& why, bool is_endless);
  void note_wait(const Silence& silence, Waiting& waiting, WallTime now);
  void wait_on(const Silence& silence, Waiting& waiting, WallTime now, const std::string& why);

  const LossRules& rules_;
  Repeatability& repeatability_;
  ReportSink report_;
  Action pause_;
  Failure fail_;
  Stuck stuck_;
  std::string waited_for_;
  WallTime waited_since_ = 0;
};

}  // namespace trident::sim
