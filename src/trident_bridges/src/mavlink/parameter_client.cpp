// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/parameter_client.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mavlink/parameter_messages.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kGap_s = 0.3;                // a list that is silent for so long has gaps
constexpr std::size_t kMaxRequests = 20;      // for single parameters at a time
constexpr std::uint32_t kTriesToBelieve = 3;  // that a vehicle keeps another value
constexpr std::uint16_t kNoIndex = 65535;     // of a PARAM_VALUE that answers PARAM_SET

}  // namespace

ParameterClient::ParameterClient(Address self, Address target, MessageSink send,
                                 ParameterEncoding encoding)
    : self_(self), target_(target), send_(std::move(send)), encoding_(encoding) {}

void ParameterClient::fetch(SimTime now, Done done) {
  fetch_ = Fetch{0, {}, now, now, std::move(done)};
  request_list();
}

void ParameterClient::request_list() {
  mavlink_param_request_list_t payload{};
  payload.target_system = target_.system;
  payload.target_component = target_.component;
  send_(pack(payload, self_));
}

void ParameterClient::request_missing() {
  std::size_t requests = 0;
  for (std::size_t i = 0; i < fetch_->count && requests < kMaxRequests; ++i) {
    if (fetch_->received.count(i) != 0) continue;
    mavlink_param_request_read_t payload{};
    payload.target_system = target_.system;
    payload.target_component = target_.component;
    payload.param_index = static_cast<std::int16_t>(i);
    send_(pack(payload, self_));
    ++requests;
  }
}

void ParameterClient::set(const std::string& name, double value, SimTime now, Done done) {
  sets_.push_back({name, value, ParameterType::kReal32, {}, std::move(done)});
  if (sets_.size() == 1) begin_set(now);
}

void ParameterClient::begin_set(SimTime now) {
  Set& set = sets_.front();
  const auto known = parameters_.find(set.name);
  if (known != parameters_.end()) set.type = known->second.type;
  set.timer.start(now);
  send_set();
}

void ParameterClient::send_set() {
  const Set& set = sets_.front();
  mavlink_param_set_t payload{};
  payload.target_system = target_.system;
  payload.target_component = target_.component;
  put_parameter_name(set.name, payload.param_id);
  payload.param_type = static_cast<std::uint8_t>(set.type);
  payload.param_value = encode_parameter(set.value, set.type, encoding_);
  send_(pack(payload, self_));
}

/// The next one is sent before this one's caller hears of it, who may set another.
void ParameterClient::end_set(bool is_good, const std::string& reason, SimTime now) {
  const Set set = std::move(sets_.front());
  sets_.pop_front();
  if (!sets_.empty()) begin_set(now);
  if (set.done) set.done(is_good, reason);
}

void ParameterClient::cancel(const std::string& reason) {
  const auto fetch = std::exchange(fetch_, std::nullopt);
  const auto sets = std::exchange(sets_, {});
  if (fetch && fetch->done) fetch->done(false, reason);
  for (const Set& set : sets) {
    if (set.done) set.done(false, reason);
  }
}

bool ParameterClient::handle(const Message& message, SimTime now) {
  if (!is<mavlink_param_value_t>(message) || !is_for(target_, message.source)) return false;
  const auto payload = unpack<mavlink_param_value_t>(message);
  Parameter parameter;
  parameter.name = parameter_name(payload.param_id);
  parameter.type = static_cast<ParameterType>(payload.param_type);
  parameter.value = decode_parameter(payload.param_value, parameter.type, encoding_);
  parameters_[parameter.name] = parameter;
  if (fetch_) note_fetched(payload.param_index, payload.param_count, now);
  if (!sets_.empty() && sets_.front().name == parameter.name) note_set(parameter, now);
  return true;
}

void ParameterClient::note_fetched(std::size_t index, std::size_t count, SimTime now) {
  fetch_->heard = now;
  fetch_->count = count;
  if (index < count && index != kNoIndex) fetch_->received.insert(index);
  if (fetch_->received.size() < count) return;
  const Done done = std::move(fetch_->done);
  fetch_.reset();
  if (done) done(true, "");
}

void ParameterClient::note_set(const Parameter& parameter, SimTime now) {
  const Set& set = sets_.front();
  const double tolerance = 1e-6 * std::max(1.0, std::abs(set.value));
  const bool is_set = std::abs(parameter.value - set.value) <= tolerance;
  // The value from before may have been in the air.
  if (!is_set && set.timer.tries() < kTriesToBelieve) return;
  const std::string stays =
      "parameter " + set.name + " stays at " + std::to_string(parameter.value);
  end_set(is_set, is_set ? "" : stays, now);
}

void ParameterClient::give_fetch_up() {
  const Done done = std::move(fetch_->done);
  const std::string got = std::to_string(fetch_->received.size());
  fetch_.reset();
  if (done)
    done(false, "system " + std::to_string(target_.system) + ": " + got +
                    " parameters came, then it was silent for 10 s");
}

void ParameterClient::request_again(SimTime now) {
  const bool is_answered_or_asked =
      (now - fetch_->heard).seconds() < kGap_s || (now - fetch_->asked).seconds() < kGap_s;
  if (is_answered_or_asked) return;
  fetch_->asked = now;
  fetch_->count == 0 ? request_list() : request_missing();
}

void ParameterClient::update_set(SimTime now) {
  Set& set = sets_.front();
  if (set.timer.waited_s(now) >= kSilence_s) {
    end_set(false,
            "parameter " + set.name + ": system " + std::to_string(target_.system) +
                " did not answer for 10 s",
            now);
  } else if (set.timer.is_due(now)) {
    set.timer.retry(now);
    send_set();
  }
}

void ParameterClient::update(SimTime now) {
  if (fetch_ && (now - fetch_->heard).seconds() >= kSilence_s) give_fetch_up();
  if (fetch_) request_again(now);
  if (!sets_.empty()) update_set(now);
}

}  // namespace trident::bridges::mavlink
