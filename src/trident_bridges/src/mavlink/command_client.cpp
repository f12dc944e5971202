// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/command_client.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/mission.h"
#include "trident_bridges/mavlink/whole_number.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kProgressPoll_s = 1.0;  // a vehicle that is busy is asked this often

std::int32_t whole(double value, const Command& command) {
  if (!std::isfinite(value)) return std::numeric_limits<std::int32_t>::max();
  const double scale = scale_of_place(command.command, command.frame);
  return to_whole<std::int32_t>(value * scale);
}

template <class Payload>
Payload payload_of(const Command& command, Address target) {
  Payload payload{};
  payload.target_system = target.system;
  payload.target_component = target.component;
  payload.command = command.command;
  payload.param1 = static_cast<float>(command.params[0]);
  payload.param2 = static_cast<float>(command.params[1]);
  payload.param3 = static_cast<float>(command.params[2]);
  payload.param4 = static_cast<float>(command.params[3]);
  return payload;
}

}  // namespace

CommandClient::CommandClient(Address self, MessageSink send)
    : self_(self), send_(std::move(send)) {}

void CommandClient::send(Address target, const Command& command, SimTime now, Done done) {
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    if (pending_[i].target == target && pending_[i].command.command == command.command) {
      end(i, {false, {CommandResult::kCancelled, "replaced by a newer one", 0}});
      break;
    }
  }
  pending_.push_back({target, command, 0, false, {}, now, std::move(done)});
  pending_.back().timer.start(now);
  transmit(pending_.back());
}

void CommandClient::transmit(const Pending& pending) {
  const Command& command = pending.command;
  if (command.is_int) {
    auto payload = payload_of<mavlink_command_int_t>(command, pending.target);
    payload.frame = command.frame;
    payload.x = whole(command.params[4], command);
    payload.y = whole(command.params[5], command);
    payload.z = static_cast<float>(command.params[6]);
    return send_(pack(payload, self_));
  }
  auto payload = payload_of<mavlink_command_long_t>(command, pending.target);
  payload.confirmation = pending.confirmation;
  payload.param5 = static_cast<float>(command.params[4]);
  payload.param6 = static_cast<float>(command.params[5]);
  payload.param7 = static_cast<float>(command.params[6]);
  send_(pack(payload, self_));
}

bool CommandClient::handle(const Message& message, SimTime now) {
  if (!is<mavlink_command_ack_t>(message)) return false;
  const auto ack = unpack<mavlink_command_ack_t>(message);
  // Vehicles of MAVLink 1 do not say for whom an answer is.
  if (!is_for({ack.target_system, ack.target_component}, self_)) return false;
  const auto answered = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& pending) {
    return pending.command.command == ack.command && is_for(pending.target, message.source);
  });
  if (answered == pending_.end()) return false;
  const auto result = static_cast<CommandResult>(ack.result);
  if (result != CommandResult::kInProgress) {
    end(static_cast<std::size_t>(answered - pending_.begin()), {true, {result, "", ack.progress}});
    return true;
  }
  answered->is_in_progress = true;
  answered->heard = now;
  return true;
}

void CommandClient::repeat_if_due(Pending& pending, SimTime now) {
  const bool may_repeat =
      !pending.is_in_progress || (now - pending.heard).seconds() >= kProgressPoll_s;
  if (!may_repeat || !pending.timer.is_due(now)) return;
  pending.timer.retry(now);
  if (pending.confirmation < 255) ++pending.confirmation;
  transmit(pending);
}

void CommandClient::update(SimTime now) {
  for (std::size_t i = 0; i < pending_.size();) {
    Pending& pending = pending_[i];
    const double limit_s = pending.is_in_progress ? kProgressSilence_s : kSilence_s;
    if ((now - pending.heard).seconds() >= limit_s) {
      end(i, {false,
              {CommandResult::kFailed,
               "system " + std::to_string(pending.target.system) + " did not answer for " +
                   std::to_string(static_cast<int>(limit_s)) + " s",
               0}});
      continue;
    }
    repeat_if_due(pending, now);
    ++i;
  }
}

void CommandClient::end(std::size_t at, const CommandOutcome& outcome) {
  const Done done = std::move(pending_[at].done);
  pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(at));
  if (done) done(outcome);
}

}  // namespace trident::bridges::mavlink
