// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trident::nav {

/// Watches whether a loop keeps its rate, and names the step that took long where it does not. Not
/// thread-safe.
class LoopWatch {
 public:
  /// A period that is longer by this part of what it should be is missed.
  static constexpr double kTolerance = 0.2;

  /// A period begins. `now_s`: on the clock that the loop runs by; `wall_s`: on one that never
  /// stands still, as in all calls.
  void begin(double now_s, double wall_s, double period_s);
  /// A step of the period is over; `step` lives for ever.
  void note(const char* step, double wall_s);
  /// The loop pauses: the next period has none before it.
  void pause() { has_begun_ = false; }

  /// A whole sentence about the periods that were missed since the last one, at most once a second
  /// of the loop's clock; empty: none were.
  std::string take_text(double now_s);
  /// Since the beginning.
  int missed() const { return missed_; }

 private:
  /// The longest period since the last text.
  struct Missed {
    double period_s = 0.0, wanted_s = 0.0;
    const char* step = "";  ///< That took longest in it.
    double step_s = 0.0, steps_s = 0.0;
  };

  bool has_begun_ = false;
  double begun_s_ = 0.0, noted_wall_s_ = 0.0;
  Missed current_, worst_;
  int missed_ = 0, unlogged_ = 0;
  double logged_s_ = -1e9;
};

}  // namespace trident::nav
