// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/plugins/plugin_util.h"
#include "core/plugins/report_throttle.h"
#include "trident_sim/commands.h"

namespace trident::sim {

/// A number that may be set while the world runs; the newest legal one counts. Others are reported
/// once, and the last good one stays.
class NumberInput {
 public:
  /// `unit` is printed with a number that is refused.
  NumberInput(const PluginContext& context, const std::string& topic, const char* unit,
              const Limits& limits);

  void poll(const World& world);
  /// None: nothing legal came since the last reset.
  const std::optional<double>& value() const { return value_; }
  /// Takes back a number that turned out not to do.
  void put(const std::optional<double>& value) { value_ = value; }
  void reset();
  void state(StateArchive& archive) { archive(value_, seen_, is_refused_); }

 private:
  std::string what_, unit_;
  Limits limits_;
  InHandle<ScalarSample> port_;
  std::optional<double> value_;
  std::uint64_t seen_ = 0;
  bool is_refused_ = false;
  ReportThrottle throttle_;
};

/// Something that may be asked for while the world runs: TriggerCommand or ServiceCommand.
template <class Command>
class RequestInput {
 public:
  RequestInput(const PluginContext& context, const std::string& name)
      : port_(subscribe<Command>(context, name)) {}

  /// Whether it was asked for since the last call.
  bool take() {
    const bool is_new = port_->count() != seen_;
    seen_ = port_->count();
    return is_new;
  }
  void reset() {
    port_->clear();
    seen_ = 0;
  }
  void state(StateArchive& archive) { archive(seen_); }

 private:
  InHandle<Command> port_;
  std::uint64_t seen_ = 0;
};

}  // namespace trident::sim
