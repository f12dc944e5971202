// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "loss_watch.h"
#include "topics/called_services.h"
#include "topics/input_binder.h"
#include "topics/service_types.h"
#include "trident_sim/comms/relay.h"

namespace trident::sim {

/// Calls that have come to their servers' robots by radio. Each is made on a thread of its own as
/// soon as it has come; when its answer is due the world waits for it, so that the answer leaves at
/// that simulated time however slow the server is. By the stepping thread, with the world's mutex
/// held.
class ServedCalls {
 public:
  /// All arguments must outlive it. `bell` is rung when a server has answered.
  ServedCalls(ServiceTypes& types, std::shared_ptr<MessageBell> bell, LossWatch& losses);
  ~ServedCalls();
  ServedCalls(const ServedCalls&) = delete;
  ServedCalls& operator=(const ServedCalls&) = delete;

  /// Whether a node makes a call by radio that came after the first `received` ones.
  using IsCalling = std::function<bool(const std::string& node, std::uint64_t received)>;

  /// Calls the server. `received`: how many calls by radio have come from nodes so far.
  void begin(const ServedCall& call, std::uint64_t received);
  /// All answers that are due are there. A server whose node makes a call by radio that has come
  /// since is not waited for: that call may be what the answer needs.
  bool allows_step(SimTime now, const IsCalling& is_calling);
  /// A server that has been silent for too long is waited for no longer; see LossWatch.
  void check_timeouts(SimTime now);
  /// Hands over the answers that are due.
  void deliver(SimTime now, RelayServices& relay, const IsCalling& is_calling);
  /// Whether the world waits for a node's answer.
  bool waits_for(const std::string& node, SimTime now) const;
  /// A call has ended otherwise: nobody waits for its answer any more.
  void forget(std::uint64_t number);
  std::size_t size() const { return served_.size(); }  ///< that have not been handed over
  void clear() { served_.clear(); }                    ///< forgets all

 private:
  class Attempt;
  struct Served {
    ServedCall call;
    std::string node;            ///< of the server; "": not known
    std::uint64_t received = 0;  ///< calls that had come when this one was handed over
    std::shared_ptr<Attempt> attempt;
    Waiting waiting;
    bool is_lost = false;     ///< its answer counts when it comes
    bool was_passed = false;  ///< the world has made a step since its answer was due
  };
  static bool is_awaited(const Served& served, SimTime now);

  ServiceTypes& types_;
  std::shared_ptr<MessageBell> bell_;
  LossWatch& losses_;
  std::vector<Served> served_;  ///< by arrival
};

}  // namespace trident::sim
