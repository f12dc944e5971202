// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// kWarning: what was asked for was changed or may surprise; kError: it was not done.
enum class Severity { kWarning, kError };

/// Something that does not stop the world and that a user should know: a command that was refused
/// or clamped, a robot that was spawned inside a wall.
struct Diagnostic {
  Severity severity = Severity::kWarning;  ///< the level in ROS' diagnostics
  std::string subject;  ///< whom it is about: "model 'm'", "model 'm' plugin 'p'"
  std::string kind;     ///< e.g. "velocity command refused"
  std::string message;  ///< a sentence without the subject, which comes before it in a report
  /// E.g. the value that was found and the legal range.
  std::vector<std::pair<std::string, std::string>> values{};

  /// What equal diagnostics are counted under.
  std::string name() const { return subject + ": " + kind; }
};

/// What is known of a name: the newest of it, and how often it occurred.
struct DiagnosticEntry {
  Diagnostic newest;        ///< with the message and values of the last occurrence
  std::uint64_t count = 0;  ///< occurrences since the world began
  SimTime first, last;      ///< simulated time of the first and the newest occurrence
};

/// Diagnostics by name. One that occurs again is counted, so that what happens in every step stays
/// one entry.
class Diagnostics {
 public:
  /// Returns whether it is the first of its name.
  bool add(Diagnostic diagnostic, SimTime now);
  /// Forgets what is about a model or its plugins.
  void forget_model(const std::string& model_name);
  /// By Diagnostic::name().
  const std::map<std::string, DiagnosticEntry>& entries() const { return entries_; }

 private:
  std::map<std::string, DiagnosticEntry> entries_;
};

}  // namespace trident::sim
