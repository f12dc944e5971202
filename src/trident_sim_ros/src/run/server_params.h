// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server_options.h"
#include "trident_base/utc_clock.h"
#include "trident_base/yaml_config.h"

namespace trident::sim {

/// Names of the choices in parameters.
constexpr auto enum_names(LossPolicy /*tag*/) {
  return std::array{EnumName<LossPolicy>{LossPolicy::kFreeRun, "free_run"},
                    EnumName<LossPolicy>{LossPolicy::kWait, "wait"},
                    EnumName<LossPolicy>{LossPolicy::kPause, "pause"}};
}

/// Names of the choices in parameters.
constexpr auto enum_names(LoopTiming /*tag*/) {
  return std::array{EnumName<LoopTiming>{LoopTiming::kRotors, "rotors"},
                    EnumName<LoopTiming>{LoopTiming::kDirect, "direct"}};
}

/// One entry of ~answers.
struct AnswerParams {
  std::string state;
  std::vector<std::string> commands;
  std::string reader;
  double delay_s = AnswerOptions{}.delay_s;

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("state", state, "topic that the node reads");
    ar.required("commands", commands, "topics that it answers each sample on");
    ar.field("reader", reader, "node that reads the state; empty: one that sends the commands");
    ar.field("delay", delay_s, Range{0.0, 10.0}, "from a sample to the effect of its answer [s]");
  }
  /// Throws Error when a topic has no name.
  void validate() const;
  /// With the names of ports: without leading slashes.
  AnswerOptions options() const;
};

/// Private parameters of the simulator (/gazebo/...). An empty optional leaves the decision to the
/// environment that `./trident run` sets, or to the world file.
struct ServerParams {
  std::optional<double> real_time_factor, end_time_s;
  std::optional<bool> end_on_finish, strict;
  int wait_for = 0;
  std::vector<std::string> wait_for_models;
  int wait_for_sources = 0;
  std::optional<std::uint64_t> seed;
  LoopTiming timing = LoopTiming::kRotors;
  LossRules loss;  ///< Its policy is not read: see lockstep_policy.
  std::optional<LossPolicy> lockstep_policy;
  bool pin_controllers = true;
  std::map<std::string, AnswerParams> answers;
  double max_clock_rate_hz = 50.0, pub_clock_frequency_hz = 0.0;
  std::optional<std::string> out_dir;
  std::string radio_rules;
  std::string utc_start = UtcClock::kDefaultStart;  ///< read by devices that carry dates
  std::vector<std::string> plugin_libraries;
  std::optional<int> sensor_threads;

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("real_time_factor", real_time_factor, Range{0.0, 1e6},
             "simulated time per wall time; 0: as fast as possible; none: as the world file says");
    ar.field("end_time", end_time_s, Range{0.0, 1e9}, "simulated time of the end; 0: none [s]");
    ar.field("end_on_finish", end_on_finish, "end when the last set-point source has ended");
    ar.field("strict", strict, "odd elements of files are refused, not left out");
    ar.field("seed", seed, Range{0.0, 9e15}, "of all noise");
    ar.field("timing", timing, "when a command acts: as RotorS, or in the next step");
    ar.field("out_dir", out_dir, "directory for results; empty: none are written");
    ar.field("plugin_libraries", plugin_libraries, "shared libraries with further plugins");
    ar.field("radio_rules", radio_rules,
             "file of config/links: which topics cross by radio; empty: as the world file says");
    ar.field("utc_start", utc_start, "UTC at simulated time 0, for devices that carry dates");
    ar.field("sensor_threads", sensor_threads, Range{1, 256},
             "that share the work of lidars and cameras; none: one per core, at most 8");
    ar.field("max_clock_rate", max_clock_rate_hz, Range{1.0, 1e5},
             "wall rate of /clock and of the state topics [Hz]");
    ar.field("pub_clock_frequency", pub_clock_frequency_hz, Range{0.0, 1e5},
             "simulated rate of /clock; 0: every step [Hz]");
    visit_lockstep(ar);
  }
  /// Throws Error when utc_start is no instant of UTC.
  void validate() const { UtcClock{utc_start}; }

 private:
  template <class Archive>
  void visit_lockstep(Archive& ar) {
    ar.field("wait_for", wait_for, Range{0, 10000},
             "vehicles with controllers before time zero is left; a list is that of their names");
    ar.field("wait_for_models", wait_for_models, "the same by name");
    ar.field("wait_for_sources", wait_for_sources, Range{0, 10000},
             "set-point sources before time zero is left");
    ar.field("lockstep_policy", lockstep_policy, "what follows when an answer does not come");
    ar.field("lockstep_timeout", loss.timeout_s, Range{0.01, 1e6},
             "wall time without an answer that is reported [s]");
    ar.field("restart_patience", loss.restart_patience_s, Range{0.0, 1e6},
             "wall time in which a node that died may be started again [s]");
    ar.field("pin_controllers", pin_controllers,
             "as fast as possible: keep each controller's process on one core");
    ar.field("answers", answers, "nodes that answer each sample of a topic, by name");
  }
};

}  // namespace trident::sim
