// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trident_sim/diagnostics.h"
#include "trident_sim/world/world_clock.h"
#include "trident_sim/world/world_setting.h"

namespace trident::sim {

/// Where problems go that do not stop a world: to its user at once, and into a count by name.
class WorldReports {
 public:
  /// Hands a text to WorldOptions::report as it is. For what a user should see each time it occurs;
  /// what may occur in every step goes to diagnose().
  void report(Severity severity, const std::string& text) const;
  /// Counts it among diagnostics(), and reports the first of its name.
  void diagnose(Diagnostic diagnostic);
  /// The same without a report: for what is reported by its cause. Returns whether it is the first.
  bool note(Diagnostic diagnostic);
  /// What occurred since the world began, those of deleted models left out. Not part of its state.
  const Diagnostics& diagnostics() const { return diagnostics_; }

  /// What was left out or changed in the files of this world and its models, a sentence each.
  const std::vector<std::string>& odd_elements() const { return odd_elements_; }

 protected:
  /// Both must outlive the reports.
  WorldReports(const WorldOptions& sinks, const WorldClock& clock) : sinks_(sinks), clock_(clock) {}
  ~WorldReports() = default;

  /// Lists what was left out or changed in a file, and reports it.
  void report_odd(const std::string& text);
  /// Lists what was reported before.
  void add_odd_repeats(const std::vector<std::string>& texts);
  /// Runs what may throw for an odd element; with OddElements::kLeaveOut its Error is reported
  /// instead.
  void leave_out_if_odd(const std::function<void()>& load);

  Diagnostics diagnostics_;

 private:
  const WorldOptions& sinks_;
  const WorldClock& clock_;
  std::vector<std::string> odd_elements_;
};

}  // namespace trident::sim
