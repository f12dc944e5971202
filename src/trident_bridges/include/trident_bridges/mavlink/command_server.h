// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>

#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/command.h"
#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// The vehicle's end of the command protocol (https://mavlink.io/en/services/command.html). Each
/// command is executed once and answered as often as it comes: a repetition is one with a higher
/// `confirmation`, the same packet again, or the same COMMAND_INT within a second.
class CommandServer {
 public:
  /// Executes a command. kInProgress promises a later finish() or progress().
  using Execute = std::function<CommandReply(const Command&, SimTime now)>;

  /// `refused` gets the reasons of refusals, for STATUSTEXT; it may be empty.
  CommandServer(Address self, MessageSink send, Execute execute,
                std::function<void(const std::string&)> refused);

  /// True when the message is a command for this vehicle.
  bool handle(const Message& message, SimTime now);
  /// Answers the command of that number that is in progress: again kInProgress, or its end.
  void progress(std::uint16_t command, const CommandReply& reply, SimTime now);
  /// True while a command of that number is in progress.
  bool is_in_progress(std::uint16_t command) const;

 private:
  struct Record {
    Command command;
    std::uint8_t confirmation = 0;
    std::uint8_t sequence = 0;
    CommandReply reply;
    SimTime when;
  };

  void execute(Record record, SimTime now);
  static bool is_repetition(const Record& record, const Record& known, SimTime now);
  Record* find_repeated(const Record& record, SimTime now);
  void report_refusal(const CommandReply& reply) const;
  void acknowledge(const Record& record);
  void forget_old(SimTime now);

  Address self_;
  MessageSink send_;
  Execute execute_;
  std::function<void(const std::string&)> refused_;
  std::deque<Record> records_;  // oldest first
};

}  // namespace trident::bridges::mavlink
