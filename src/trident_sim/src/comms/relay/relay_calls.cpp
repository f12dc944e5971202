// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/relay/relay_calls.h"

#include <algorithm>
#include <utility>

#include "comms/wire.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

std::string text_of(const RelayRule& rule, const Relay::Key& key) {
  return rule.text(key.rule) + ": the call of " + key.source + " to " + key.destination + "/" +
         rule.service;
}

bool is_kind(char kind) {
  return kind == static_cast<char>(CallMessageKind::kRequest) ||
         kind == static_cast<char>(CallMessageKind::kAnswer) ||
         kind == static_cast<char>(CallMessageKind::kError);
}

}  // namespace

std::string encode(const CallMessage& message) {
  std::string bytes(1, static_cast<char>(message.kind));
  wire::put(message.number, &bytes);
  return bytes.append(message.data);
}

std::optional<CallMessage> decode_call(std::string_view bytes) {
  wire::Fields fields(bytes);
  const char kind = fields.get<char>();
  CallMessage message;
  message.kind = static_cast<CallMessageKind>(kind);
  message.number = fields.get<std::uint64_t>();
  message.data = fields.rest();
  return fields.is_whole() && is_kind(kind) ? std::optional(message) : std::nullopt;
}

int RelayCalls::in_progress(const Relay::Key& key) const {
  return static_cast<int>(std::count_if(
      calls_.begin(), calls_.end(), [&key](const auto& entry) { return entry.second.key == key; }));
}

void RelayCalls::end(Calls::iterator call, bool is_answered, std::string data) {
  results_.push_back(
      {call->first, is_answered, std::make_shared<const std::string>(std::move(data))});
  calls_.erase(call);
}

void RelayCalls::end_with_error(Calls::iterator call, const std::vector<RelayRule>& rules,
                                const std::string& why) {
  const Relay::Key key = call->second.key;
  end(call, false, text_of(rules[key.rule], key) + " " + why);
}

std::uint64_t RelayCalls::begin(const Relay::Key& key, const std::string& request, SimTime now,
                                Relay* relay) {
  const RelayRule& rule = relay->rules()[key.rule];
  const bool has_room = in_progress(key) < rule.depth;
  const std::uint64_t number = next_++;
  CallCounts& counts = counts_[key];
  ++counts.called;
  // A call that is refused has a number and a result as well, so that its caller does not wait.
  const auto call = calls_.emplace(number, Call{key, now, Stage::kRequested}).first;
  if (!has_room) {
    ++counts.refused;
    end_with_error(call, relay->rules(),
                   "is refused: " + std::to_string(rule.depth) +
                       " others are in progress, legal: fewer than depth");
  } else if (!relay->post(key, encode({CallMessageKind::kRequest, number, request}), now)) {
    ++counts.refused;
    end_with_error(call, relay->rules(),
                   "is refused: its request has " + std::to_string(request.size()) +
                       " bytes, legal: at most " + std::to_string(kMaxCallBytes));
  }
  return number;
}

void RelayCalls::take(const RelayDelivery& delivery, SimTime end_of_step,
                      const std::vector<RelayRule>& rules) {
  const auto message = decode_call(*delivery.message.data);
  if (!message) return;
  const auto call = calls_.find(message->number);
  if (call == calls_.end()) return;
  const Relay::Key key = call->second.key;
  const RelayRule& rule = rules[key.rule];
  if (message->kind == CallMessageKind::kRequest) {
    call->second.stage = Stage::kServed;
    // The answer leaves at the end of this step, or after the rule's delay.
    served_.push_back({call->first,
                       {rule.text(key.rule), key.source, key.destination, rule.service},
                       std::make_shared<const std::string>(message->data),
                       end_of_step + SimTime::from_seconds(rule.delay_s)});
    return;
  }
  CallCounts& counts = counts_[key];
  if (message->kind == CallMessageKind::kError) {
    ++counts.failed;
    end_with_error(call, rules, "has failed: " + std::string(message->data));
    return;
  }
  ++counts.answered;
  const double delay_s = (delivery.received - call->second.begun).seconds();
  counts.delay_s += delay_s;
  counts.max_delay_s = std::max(counts.max_delay_s, delay_s);
  end(call, true, std::string(message->data));
}

void RelayCalls::answer(const CallResult& answer, Relay* relay) {
  const auto call = calls_.find(answer.number);
  if (call == calls_.end() || call->second.stage != Stage::kServed) return;
  call->second.stage = Stage::kAnswered;
  const Relay::Key& key = call->second.key;
  const Relay::Key back{key.rule, key.destination, key.source};
  const CallMessageKind kind =
      answer.is_answered ? CallMessageKind::kAnswer : CallMessageKind::kError;
  // Request and answer share the deadline of the call.
  const SimTime born = call->second.begun;
  if (relay->post(back, encode({kind, answer.number, *answer.data}), born)) return;
  const std::string error = "its answer has " + std::to_string(answer.data->size()) +
                            " bytes, legal: at most " + std::to_string(kMaxCallBytes);
  // The caller learns of an answer that is too large by an error, which is short.
  relay->post(back, encode({CallMessageKind::kError, answer.number, error}), born);
}

void RelayCalls::abort(std::uint64_t number, const std::string& why,
                       const std::vector<RelayRule>& rules) {
  const auto call = calls_.find(number);
  if (call == calls_.end()) return;
  ++counts_[call->second.key].aborted;
  end_with_error(call, rules, "has ended: " + why);
}

void RelayCalls::expire(SimTime now, const std::vector<RelayRule>& rules) {
  for (auto call = calls_.begin(); call != calls_.end();) {
    const auto next = std::next(call);
    const Relay::Key& key = call->second.key;
    const RelayRule& rule = rules[key.rule];
    if (now - call->second.begun >= SimTime::from_seconds(rule.deadline_s)) {
      ++counts_[key].expired;
      const Stage stage = call->second.stage;
      end_with_error(call, rules,
                     "has no answer after " + number_text(rule.deadline_s) + " s: " +
                         (stage == Stage::kRequested ? "its request has not arrived"
                          : stage == Stage::kServed  ? "its server has not answered"
                                                     : "the answer has not arrived"));
    }
    call = next;
  }
}

void RelayCalls::set_robots(const std::vector<std::string>& robots,
                            const std::vector<RelayRule>& rules) {
  for (auto call = calls_.begin(); call != calls_.end();) {
    const auto next = std::next(call);
    const Relay::Key& key = call->second.key;
    for (const std::string* name : {&key.source, &key.destination}) {
      if (std::binary_search(robots.begin(), robots.end(), *name)) continue;
      ++counts_[key].aborted;
      end_with_error(call, rules, "has ended: there is no radio '" + *name + "' any more");
      break;
    }
    call = next;
  }
}

void RelayCalls::reset(const std::vector<RelayRule>& rules) {
  while (!calls_.empty()) end_with_error(calls_.begin(), rules, "has ended: the world was reset");
  served_.clear();
  counts_.clear();
}

}  // namespace trident::sim
