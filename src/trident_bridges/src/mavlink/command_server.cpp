// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/command_server.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/mission.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kRemembered_s = 30.0;  // a command that is confirmed again
constexpr double kSamePacket_s = 2.0;   // less than 256 packets of a slow sender
constexpr double kRepeatedInt_s = 1.0;  // COMMAND_INT has no confirmation
constexpr std::size_t kMaxRecords = 128;
constexpr std::int32_t kNotGiven = std::numeric_limits<std::int32_t>::max();

struct Received {
  Command command;
  Address target;
  std::uint8_t confirmation = 0;
};

Received read_long(const mavlink_command_long_t& payload) {
  Received received;
  received.target = {payload.target_system, payload.target_component};
  received.confirmation = payload.confirmation;
  received.command.command = payload.command;
  received.command.params = {payload.param1, payload.param2, payload.param3, payload.param4,
                             payload.param5, payload.param6, payload.param7};
  return received;
}

double place(std::int32_t value, const mavlink_command_int_t& payload) {
  if (!has_place(payload.command)) return value;
  if (value == kNotGiven) return std::numeric_limits<double>::quiet_NaN();
  return value / scale_of_place(payload.command, payload.frame);
}

Received read_int(const mavlink_command_int_t& payload) {
  Received received;
  received.target = {payload.target_system, payload.target_component};
  received.command.command = payload.command;
  received.command.is_int = true;
  received.command.frame = payload.frame;
  received.command.params = {payload.param1,
                             payload.param2,
                             payload.param3,
                             payload.param4,
                             place(payload.x, payload),
                             place(payload.y, payload),
                             payload.z};
  return received;
}

std::optional<Received> read_command(const Message& message) {
  std::optional<Received> received;
  if (is<mavlink_command_long_t>(message)) {
    received = read_long(unpack<mavlink_command_long_t>(message));
  } else if (is<mavlink_command_int_t>(message)) {
    received = read_int(unpack<mavlink_command_int_t>(message));
  }
  if (received) received->command.source = message.source;
  return received;
}

/// NaN, which stands for what is not given, equals itself.
bool are_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool are_same(const Command& a, const Command& b) {
  const auto same_number = [](double x, double y) { return are_same(x, y); };
  return a.command == b.command && a.source == b.source && a.is_int == b.is_int &&
         a.frame == b.frame &&
         std::equal(a.params.begin(), a.params.end(), b.params.begin(), same_number);
}

}  // namespace

const char* text_of(CommandResult result) {
  constexpr std::array<const char*, 7> kTexts{
      "accepted", "temporarily rejected", "denied",   "unsupported",
      "failed",   "in progress",          "cancelled"};
  const auto index = static_cast<std::size_t>(result);
  return index < kTexts.size() ? kTexts[index] : "unknown result";
}

CommandServer::CommandServer(Address self, MessageSink send, Execute execute,
                             std::function<void(const std::string&)> refused)
    : self_(self),
      send_(std::move(send)),
      execute_(std::move(execute)),
      refused_(std::move(refused)) {}

bool CommandServer::handle(const Message& message, SimTime now) {
  const std::optional<Received> received = read_command(message);
  if (!received || !is_for(received->target, self_)) return false;
  forget_old(now);
  Record record{received->command, received->confirmation, message.sequence, {}, now};
  if (Record* known = find_repeated(record, now)) {
    known->confirmation = record.confirmation;
    acknowledge(*known);
    return true;
  }
  execute(std::move(record), now);
  return true;
}

/// Whether a command repeats an equal one from before, whose answer was lost.
bool CommandServer::is_repetition(const Record& record, const Record& known, SimTime now) {
  const double age_s = (now - known.when).seconds();
  return record.confirmation > known.confirmation ||
         (record.sequence == known.sequence && age_s < kSamePacket_s) ||
         (record.command.is_int && age_s < kRepeatedInt_s) ||
         known.reply.result == CommandResult::kInProgress;
}

CommandServer::Record* CommandServer::find_repeated(const Record& record, SimTime now) {
  const auto it = std::find_if(records_.rbegin(), records_.rend(), [&](const Record& known) {
    return are_same(known.command, record.command) && is_repetition(record, known, now);
  });
  return it == records_.rend() ? nullptr : &*it;
}

void CommandServer::report_refusal(const CommandReply& reply) const {
  const bool is_refused =
      reply.result != CommandResult::kAccepted && reply.result != CommandResult::kInProgress;
  if (is_refused && refused_ && !reply.reason.empty()) refused_(reply.reason);
}

void CommandServer::execute(Record record, SimTime now) {
  record.reply =
      execute_ ? execute_(record.command, now) : CommandReply{CommandResult::kUnsupported, "", 0};
  acknowledge(record);
  report_refusal(record.reply);
  if (records_.size() == kMaxRecords) records_.pop_front();
  records_.push_back(std::move(record));
}

void CommandServer::acknowledge(const Record& record) {
  mavlink_command_ack_t payload{};
  payload.command = record.command.command;
  payload.result = static_cast<std::uint8_t>(record.reply.result);
  payload.progress = record.reply.progress;
  payload.target_system = record.command.source.system;
  payload.target_component = record.command.source.component;
  send_(pack(payload, self_));
}

void CommandServer::progress(std::uint16_t command, const CommandReply& reply, SimTime now) {
  for (Record& record : records_) {
    if (record.command.command != command) continue;
    if (record.reply.result != CommandResult::kInProgress) continue;
    record.reply = reply;
    record.when = now;
    acknowledge(record);
    report_refusal(reply);
  }
}

bool CommandServer::is_in_progress(std::uint16_t command) const {
  return std::any_of(records_.begin(), records_.end(), [&](const Record& record) {
    return record.command.command == command && record.reply.result == CommandResult::kInProgress;
  });
}

void CommandServer::forget_old(SimTime now) {
  const auto is_old = [&](const Record& record) {
    return record.reply.result != CommandResult::kInProgress &&
           (now - record.when).seconds() > kRemembered_s;
  };
  records_.erase(std::remove_if(records_.begin(), records_.end(), is_old), records_.end());
}

}  // namespace trident::bridges::mavlink
