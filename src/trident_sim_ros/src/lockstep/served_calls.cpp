// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "served_calls.h"

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/mutex.h"
#include "trident_ros/raw_service.h"
#include "trident_ros/schedule_fuzz.h"

namespace trident::sim {

/// One call of a server, on a thread of its own, which may outlive it: who asks the master cannot
/// be interrupted.
class ServedCalls::Attempt {
 public:
  Attempt(const ServedCall& call, const ros_utils::ServiceType& type,
          std::shared_ptr<MessageBell> bell)
      : state_(std::make_shared<State>(name_at_server(call.service))) {
    // TCPROS takes "*" for any type.
    const std::string md5sum = type.md5sum.empty() ? "*" : type.md5sum;
    std::thread([state = state_, bell = std::move(bell), number = call.number,
                 request = call.request, md5sum] {
      state->run(number, md5sum, *request);
      bell->ring();
    }).detach();
  }
  ~Attempt() { state_->client.cancel(); }
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;

  /// nullopt: the server has not answered yet.
  std::optional<CallResult> result() const {
    const Lock lock(state_->mutex);
    return state_->result;
  }

 private:
  struct State {
    explicit State(const std::string& service) : client(service) {}

    void run(std::uint64_t number, const std::string& md5sum, const std::string& request) {
      CallResult answer{number, false, nullptr};
      try {
        ros_utils::hand_over("call handed to its server");
        answer.data = std::make_shared<const std::string>(client.call(md5sum, request));
        answer.is_answered = true;
      } catch (const std::exception& error) {
        answer.data = std::make_shared<const std::string>(error.what());
      }
      const Lock lock(mutex);
      result = std::move(answer);
    }

    ros_utils::RawServiceClient client;
    mutable Mutex mutex;
    std::optional<CallResult> result TRIDENT_GUARDED_BY(mutex);
  };
  std::shared_ptr<State> state_;
};

ServedCalls::ServedCalls(ServiceTypes& types, std::shared_ptr<MessageBell> bell, LossWatch& losses)
    : types_(types), bell_(std::move(bell)), losses_(losses) {}

ServedCalls::~ServedCalls() = default;

void ServedCalls::begin(const ServedCall& call, std::uint64_t received) {
  const ros_utils::ServiceType type = types_.look(name_at_server(call.service));
  Served served;
  served.call = call;
  served.node = type.node;
  served.received = received;
  served.attempt = std::make_shared<Attempt>(call, type, bell_);
  served_.push_back(std::move(served));
}

bool ServedCalls::is_awaited(const Served& served, SimTime now) {
  return served.call.due <= now && !served.is_lost && !served.attempt->result();
}

bool ServedCalls::allows_step(SimTime now, const IsCalling& is_calling) {
  bool allowed = true;
  for (Served& served : served_) {
    const bool is_late = is_awaited(served, now);
    // A server that makes a call by radio itself waits for the world, which must not wait for it.
    const bool is_passed = is_late && is_calling(served.node, served.received);
    served.was_passed = served.was_passed || is_passed;
    if (!is_late || is_passed) {
      served.waiting.end();
      continue;
    }
    if (served.waiting.since == 0) served.waiting.since = wall_now();
    allowed = false;
  }
  return allowed;
}

void ServedCalls::check_timeouts(SimTime now) {
  losses_.clear();
  for (Served& served : served_) {
    if (served.waiting.since == 0) continue;
    LossWatch::Silence silence;
    silence.who = "the server of " + name_at_server(served.call.service);
    silence.what = "has not answered a call of " + served.call.service.caller +
                   " (one that needs simulated time has a delay in its rule)";
    silence.may_wait_for_the_world = true;
    silence.time = now;
    served.is_lost = losses_.gives_up(silence, served.waiting, wall_now());
  }
}

void ServedCalls::deliver(SimTime now, RelayServices& relay, const IsCalling& is_calling) {
  const auto hand_over = [&](const Served& served) {
    const std::optional<CallResult> result =
        served.call.due <= now ? served.attempt->result() : std::nullopt;
    if (!result) return false;
    if (served.was_passed && is_calling(served.node, served.received)) {
      losses_.repeatability().spoil(served.node, now,
                                    "answers a call by radio while it makes one itself");
    }
    if (!result->is_answered) types_.ask_again(name_at_server(served.call.service));
    relay.answer(*result);
    return true;
  };
  served_.erase(std::remove_if(served_.begin(), served_.end(), hand_over), served_.end());
}

bool ServedCalls::waits_for(const std::string& node, SimTime now) const {
  return std::any_of(served_.begin(), served_.end(), [&](const Served& served) {
    return served.node == node && is_awaited(served, now);
  });
}

void ServedCalls::forget(std::uint64_t number) {
  const auto is_it = [number](const Served& served) { return served.call.number == number; };
  served_.erase(std::remove_if(served_.begin(), served_.end(), is_it), served_.end());
}

}  // namespace trident::sim
