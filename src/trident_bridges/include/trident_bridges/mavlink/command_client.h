// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trident_bridges/mavlink/command.h"
#include "trident_bridges/mavlink/retry_timer.h"

namespace trident::bridges::mavlink {

/// How a command ended.
struct CommandOutcome {
  bool is_answered = false;  ///< false: the vehicle was silent
  CommandReply reply;        ///< its answer; a reason that this end knows
};

/// The ground's end of the command protocol: repeats a command until it is answered. Of one vehicle
/// and number one command at a time is in progress.
class CommandClient {
 public:
  static constexpr double kSilence_s = 5.0;           ///< after which a command has failed
  static constexpr double kProgressSilence_s = 30.0;  ///< the same once it is in progress
  using Done = std::function<void(const CommandOutcome&)>;

  CommandClient(Address self, MessageSink send);

  /// Sends command.command with command.params, as COMMAND_INT in command.frame where
  /// command.is_int. `done` is called once. An older one of the same number ends as cancelled.
  void send(Address target, const Command& command, SimTime now, Done done);
  /// True when the message answers a command of this end.
  bool handle(const Message& message, SimTime now);
  /// Repeats and gives up; to be called at least every 50 ms while is_busy().
  void update(SimTime now);
  bool is_busy() const { return !pending_.empty(); }  ///< something was not answered

 private:
  struct Pending {
    Address target;
    Command command;
    std::uint8_t confirmation = 0;
    bool is_in_progress = false;
    RetryTimer timer;
    SimTime heard;
    Done done;
  };

  void transmit(const Pending& pending);
  void repeat_if_due(Pending& pending, SimTime now);
  void end(std::size_t at, const CommandOutcome& outcome);

  Address self_;
  MessageSink send_;
  std::vector<Pending> pending_;
};

}  // namespace trident::bridges::mavlink
