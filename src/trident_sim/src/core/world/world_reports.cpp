// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/world/world_reports.h"

#include <utility>

#include "trident_base/error.h"

namespace trident::sim {

void WorldReports::report(Severity severity, const std::string& text) const {
  if (sinks_.report) sinks_.report(severity, text);
}

/// Reported once by name, counted always: a robot that is refused a command in every step would
/// fill a log otherwise.
void WorldReports::diagnose(Diagnostic diagnostic) {
  const Severity severity = diagnostic.severity;
  const std::string text = diagnostic.subject + ": " + diagnostic.message;
  if (!note(std::move(diagnostic))) return;
  if (sinks_.diagnosed) {
    sinks_.diagnosed(severity, text);
  } else {
    report(severity, text);
  }
}

bool WorldReports::note(Diagnostic diagnostic) {
  return diagnostics_.add(std::move(diagnostic), clock_.time());
}

void WorldReports::report_odd(const std::string& text) {
  odd_elements_.push_back(text);
  report(Severity::kWarning, text);
}

void WorldReports::leave_out_if_odd(const std::function<void()>& load) {
  try {
    load();
  } catch (const Error& error) {
    if (sinks_.odd_elements == OddElements::kRefuse) throw;
    report_odd(std::string(error.what()) + "; left out");
  }
}

void WorldReports::add_odd_repeats(const std::vector<std::string>& texts) {
  odd_elements_.insert(odd_elements_.end(), texts.begin(), texts.end());
}

}  // namespace trident::sim
