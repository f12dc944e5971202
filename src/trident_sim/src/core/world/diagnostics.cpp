// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/diagnostics.h"

namespace trident::sim {

bool Diagnostics::add(Diagnostic diagnostic, SimTime now) {
  DiagnosticEntry& entry = entries_[diagnostic.name()];
  const bool is_first = entry.count == 0;
  if (is_first) entry.first = now;
  entry.last = now;
  ++entry.count;
  entry.newest = std::move(diagnostic);
  return is_first;
}

void Diagnostics::forget_model(const std::string& model_name) {
  // The quote at its end keeps "model 'a'" apart from "model 'ab'".
  const std::string prefix = "model '" + model_name + "'";
  auto it = entries_.lower_bound(prefix);
  while (it != entries_.end() && it->first.compare(0, prefix.size(), prefix) == 0) {
    it = entries_.erase(it);
  }
}

}  // namespace trident::sim
