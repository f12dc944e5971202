// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "command_input.h"

#include <sstream>

namespace trident::sim {

NumberInput::NumberInput(const PluginContext& context, const std::string& topic, const char* unit,
                         const Limits& limits)
    : what_(context.params.owner() + ": " + topic),
      unit_(unit),
      limits_(limits),
      port_(subscribe<ScalarSample>(context, topic)) {}

void NumberInput::poll(const World& world) {
  if (port_->count() == seen_) return;
  seen_ = port_->count();
  const double number = port_->at(seen_ - 1).value;
  // NaN fails both comparisons.
  const bool is_good = number >= limits_.lo && number <= limits_.hi;
  if (is_good) {
    value_ = number;
  } else if (!is_refused_ && throttle_.is_due()) {
    std::ostringstream text;
    text << what_ << ": " << number << " " << unit_ << " is refused, legal: " << limits_.lo
         << " to " << limits_.hi << "; the last good one stays";
    world.report(Severity::kWarning, text.str());
  }
  is_refused_ = !is_good;
}

void NumberInput::reset() {
  port_->clear();
  value_.reset();
  seen_ = 0;
  is_refused_ = false;
}

}  // namespace trident::sim
