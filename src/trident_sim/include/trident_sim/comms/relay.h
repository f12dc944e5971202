// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What crosses between the robots of a world by rules (config/links): topics, and calls of
// services.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

class World;

/// What became of the messages of a rule from one robot to another, since the world was reset.
struct RelayCounts {
  std::uint64_t offered = 0;     ///< that the topic had
  std::uint64_t thinned = 0;     ///< left out for max_rate
  std::uint64_t superseded = 0;  ///< of a reliable rule: had to go for newer ones, by depth
  std::uint64_t expired = 0;     ///< too old, at either end
  std::uint64_t refused = 0;     ///< larger than the radio's queue, or the queue was full
  std::uint64_t delivered = 0;   ///< whole, each once
  std::uint64_t doubles = 0;     ///< datagrams that had arrived before
  std::uint64_t datagrams = 0;   ///< sent, without acknowledgements
  std::uint64_t resent = 0;      ///< of these those that were sent before
  double delay_s = 0.0, max_delay_s = 0.0;  ///< age as it was delivered: sum, greatest
  double first_s = -1.0;  ///< when the first was to be sent; negative: there was nothing to send

  /// Calls take(name, count) for each count.
  template <class Take>
  void visit(Take&& take) const {
    take("offered", offered);
    take("thinned", thinned);
    take("superseded", superseded);
    take("expired", expired);
    take("refused", refused);
    take("delivered", delivered);
    take("doubles", doubles);
    take("datagrams", datagrams);
    take("resent", resent);
  }
};

/// A topic that crosses from one robot to another.
struct RelayFlow {
  std::string rule;                 ///< "rule 2 (detections)"
  bool is_reliable = false;         ///< of the rule
  double deadline_s = 0.0;          ///< of the rule; 0: none
  std::string source, destination;  ///< robots; "all": as it was sent, what arrived is by robot
  RelayCounts counts;
};

/// What became of the calls of a service by one robot of another, since the world was reset. What
/// is in none of the other counts is still in progress.
struct CallCounts {
  std::uint64_t called = 0;
  std::uint64_t answered = 0;  ///< by its server
  std::uint64_t failed = 0;    ///< answered with an error: there was no server, or it reported one
  std::uint64_t refused = 0;   ///< not sent: too large, or too many were in progress
  std::uint64_t expired = 0;   ///< no answer had come by the deadline
  std::uint64_t aborted = 0;   ///< one of the two radios has gone, or it was ended from outside
  double delay_s = 0.0,
         max_delay_s = 0.0;  ///< of those answered, from call to answer: sum, greatest

  /// Calls take(name, count) for each count.
  template <class Take>
  void visit(Take&& take) const {
    take("called", called);
    take("answered", answered);
    take("failed", failed);
    take("refused", refused);
    take("expired", expired);
    take("aborted", aborted);
  }
};

/// A service that one robot calls of another.
struct CallFlow {
  std::string rule;            ///< "rule 3 (arm)"
  double deadline_s = 0.0;     ///< of the rule
  std::string caller, server;  ///< robots
  CallCounts counts;
};

/// What has crossed between robots by rules.
class RelayReport {
 public:
  virtual ~RelayReport() = default;
  /// Of topics by rule, source and destination, as far as there was anything.
  virtual std::vector<RelayFlow> flows() const = 0;
  /// Of services by rule, caller and server, as far as there was a call.
  virtual std::vector<CallFlow> calls() const = 0;
  /// Whether a message of that topic ("uav1/odom") which counts then is left out for max_rate by
  /// all rules, so that nobody needs its bytes.
  virtual bool is_thinned(const std::string& topic, SimTime at) const = 0;
  /// Messages that have come to a robot so far, by topic: from/<source>/<topic>.
  virtual std::map<std::string, std::uint64_t> heard(const std::string& robot) const = 0;
  /// From a robot over all hops to another one; ends where no route is known.
  virtual std::vector<std::string> route(const std::string& source,
                                         const std::string& destination) const = 0;
};

/// A service that a rule lets one robot call of another, both with a radio.
struct RelayService {
  std::string rule;            ///< "rule 3 (arm)"
  std::string caller, server;  ///< robots
  std::string name;            ///< below the server's namespace
};

/// A request that has come to its server's robot.
struct ServedCall {
  std::uint64_t number = 0;  ///< of the call
  RelayService service;
  std::shared_ptr<const std::string> request;  ///< never nullptr
  SimTime due;                                 ///< when its answer leaves
};

/// How a call has ended.
struct CallResult {
  std::uint64_t number = 0;                 ///< of the call
  bool is_answered = false;                 ///< by its server
  std::shared_ptr<const std::string> data;  ///< the answer, or the text of an error; never nullptr
};

/// Calls of services between the robots of a world: the request crosses by radio, the answer, too.
/// Used between steps; nobody looks into the bytes of requests and answers.
class RelayServices {
 public:
  virtual ~RelayServices() = default;
  /// That may be called now, by caller, server and name. They change with the ports of the world.
  virtual std::vector<RelayService> services() const = 0;
  /// Begins a call now and returns its number; its result is one of take_results(). Throws Error
  /// for a service that is not among services().
  virtual std::uint64_t call(const RelayService& service,
                             std::shared_ptr<const std::string> request) = 0;
  /// Requests that have arrived since this was last called, in order.
  virtual std::vector<ServedCall> take_served() = 0;
  /// What the server has answered, or the text of an error. A call that has ended is left alone.
  virtual void answer(const CallResult& answer) = 0;
  /// Ends a call with an error; one that has ended is left alone.
  virtual void abort(std::uint64_t number, const std::string& why) = 0;
  /// Calls that have ended since this was last called.
  virtual std::vector<CallResult> take_results() = 0;
};

/// nullptr: nothing crosses by rules.
std::shared_ptr<const RelayReport> find_relay(const World& world);
/// The same.
std::shared_ptr<RelayServices> find_relay_services(const World& world);

}  // namespace trident::sim
