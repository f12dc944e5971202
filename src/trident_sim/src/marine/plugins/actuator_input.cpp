// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "actuator_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/string_util.h"

namespace trident::sim {

ActuatorInput::ActuatorInput(const PluginContext& context, const std::string& topic,
                             std::string what, std::string unit, const Limits& limits,
                             Source source)
    : owner_(context.params.owner()),
      topic_(topic),
      what_(std::move(what)),
      unit_(std::move(unit)),
      limits_(limits) {
  if (source == Source::kTopic) port_ = subscribe<ScalarSample>(context, topic);
  if (source == Source::kSingleTopic) single_ = subscribe<SingleNumber>(context, topic);
  if (source == Source::kStampedTopic) stamped_ = subscribe<StampedNumber>(context, topic);
}

template <class Port>
std::optional<double> ActuatorInput::newest_of(World& world, const Port& port) {
  std::optional<double> newest;
  for (seen_ = std::max(seen_, port->oldest()); seen_ < port->count(); ++seen_) {
    // Of several in one step the last that is legal counts, but all are checked and reported.
    if (const auto legal = check(world, port->at(seen_).value)) newest = legal;
  }
  return newest;
}

std::optional<double> ActuatorInput::take(World& world) {
  if (single_) return newest_of(world, single_);
  if (stamped_) return newest_of(world, stamped_);
  return port_ ? newest_of(world, port_) : std::nullopt;
}

std::optional<double> ActuatorInput::check(World& world, double value) const {
  if (!std::isfinite(value)) {
    diagnose(world, Severity::kError, value);
    return {};
  }
  const double legal = std::clamp(value, limits_.lo, limits_.hi);
  if (legal != value) diagnose(world, Severity::kWarning, value);
  return legal;
}

void ActuatorInput::diagnose(World& world, Severity severity, double value) const {
  const bool is_refused = severity == Severity::kError;
  const std::string given = number_text(value) + unit_;
  const std::string legal =
      "[" + number_text(limits_.lo) + ", " + number_text(limits_.hi) + "]" + unit_;
  world.diagnose({severity,
                  owner_,
                  what_ + (is_refused ? " refused" : " clamped"),
                  topic_ + ": " + given + " is " +
                      (is_refused ? "refused, the last good one stays" : "cut to the nearest") +
                      "; legal is " + legal,
                  {{"value", given}, {"legal", legal}}});
}

void ActuatorInput::reset() {
  if (port_) port_->clear();
  if (single_) single_->clear();
  if (stamped_) stamped_->clear();
  seen_ = 0;
}

}  // namespace trident::sim
