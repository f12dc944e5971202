// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "loss_watch.h"
#include "node_probe.h"
#include "run/server_options.h"
#include "topics/input_binder.h"
#include "topics/port_binder.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// Lockstep with nodes whose commands carry no stamp: one that turns each sample of a topic (an
/// odometry) into one message on each of some inputs (a Twist, thrusters' Float64). The world
/// continues by `delay` beyond a sample, waits there for its answers, and hands them to the plugins
/// in that very step, whenever they came. A set-point's source (lockstep.h) says by stamps what
/// time it covers and may be far ahead; here a message is known only as the next one after a
/// sample, so that messages are counted and held back. By the stepping thread, with the world's
/// mutex held.
class AnsweredInputs {
 public:
  AnsweredInputs(const ServerOptions& options, PortBoard& board, PortBinder& outputs,
                 InputBinder& inputs, LossWatch& losses, NodeProbe& probe, ReportSink report);

  /// After models came or went: the inputs of the declared nodes are held for their moment.
  void sync();
  /// What time zero is held for, in words; "" when nothing is missing.
  std::string missing_for_start();
  bool empty() const { return drivers_.empty(); }

  /// The step that begins at `begin` has the answers that it needs.
  bool allows_step(SimTime begin);
  /// Waits for a message for up to milliseconds; without the world's mutex.
  void wait() { inputs_.wait_for_message(std::chrono::milliseconds(2)); }
  /// Nodes that have been silent for too long run free from then on, or are waited for.
  void check_timeouts(SimTime now);
  /// Hands over what is due in the step that begins at `begin`.
  void deliver(SimTime begin);
  /// The step has been made: are there samples to answer?
  void look_for_samples(SimTime now);
  void clear();

 private:
  struct Driver {
    std::string name;
    AnswerOptions options;
    std::uint64_t seen = 0;  ///< of the state's samples
    bool is_open = false;    ///< a sample waits for its answers
    bool is_lost = false;
    SimTime sample;
    std::map<std::string, std::uint64_t> wanted;       ///< messages per input that answer it
    std::map<std::string, std::uint64_t> handed_over;  ///< messages per input when it was answered
    std::set<std::string> nodes;                       ///< that read the samples and answer
    Waiting waiting;
  };
  bool is_due(const Driver& driver, SimTime begin) const;
  bool is_answered(const Driver& driver) const;
  void open(Driver& driver, SimTime now);
  std::vector<std::string> missing_connections(const Driver& driver) const;
  std::string missing_node(Driver& driver);
  bool has_lost_node(const Driver& driver) const;
  void note_surplus(const std::string& command, std::uint64_t expected, SimTime time);

  const ServerOptions& options_;
  PortBoard& board_;
  PortBinder& outputs_;
  InputBinder& inputs_;
  LossWatch& losses_;
  NodeProbe& probe_;
  ReportSink report_;
  std::vector<Driver> drivers_;
};

}  // namespace trident::sim
