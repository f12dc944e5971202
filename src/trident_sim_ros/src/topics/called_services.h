// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "input_binder.h"
#include "run/repeatability.h"
#include "service_types.h"
#include "trident_ros/threaded_callback_queue.h"
#include "trident_sim/comms/relay.h"

namespace trident::sim {

class CallInbox;
class NodeCall;

/// Service S of robot A as robot B calls it by radio: /B/to/A/S, advertised as soon as its type is
/// known. A node that calls it waits, on a thread of its own, until its call has ended in the
/// simulation. Nobody looks into requests and responses. By the stepping thread, with the world's
/// mutex held.
class CalledServices {
 public:
  /// All arguments must outlive it. `bell` is rung when a call comes.
  CalledServices(ros::NodeHandle& node, ServiceTypes& types, Repeatability& repeatability,
                 const std::shared_ptr<MessageBell>& bell);
  ~CalledServices();
  CalledServices(const CalledServices&) = delete;
  CalledServices& operator=(const CalledServices&) = delete;

  /// Follows services that may be called now.
  void sync(const std::vector<RelayService>& services);
  /// Advertises what has a type now, and what has another one.
  void look_for_types();
  /// Begins the calls that have come, in a step at `begin`. Of a node that is not expected to call
  /// it is left to chance in which step that is, unless the world stood.
  void deliver(SimTime begin, RelayServices& relay,
               const std::function<bool(const std::string&)>& is_expected);
  /// Hands a result to the node that waits for it.
  void finish(const CallResult& result);
  /// How many calls have come in all.
  std::uint64_t received() const;
  /// Whether a call of that node has not ended that came after the first `received` ones.
  bool is_calling(const std::string& node, std::uint64_t received = 0) const;
  /// Ends the calls of a node that have begun with an error.
  void abort(const std::string& node, const std::string& why, RelayServices& relay);
  /// Ends those that have not begun, when time begins again.
  void clear();
  /// Ends all calls, those that come later at once.
  void end(const std::string& why);
  bool empty() const { return entries_.empty(); }                  ///< no service may be called
  std::size_t waiting() const;                                     ///< calls that have not begun
  std::size_t in_progress() const { return in_progress_.size(); }  ///< calls that have
  /// Rules, each with servers that it has, of which no service is known; see RelayService::rule.
  std::map<std::string, std::vector<std::string>> unserved() const;

 private:
  /// A service that is called by radio.
  struct Entry {
    RelayService service;
    std::string md5sum;  ///< as advertised; "": it is not
    ros::ServiceServer server;
  };
  void advertise(const std::string& name, const ros_utils::ServiceType& type, Entry* entry);
  void begin(const std::shared_ptr<NodeCall>& call, RelayServices& relay);

  ros::NodeHandle& node_;
  ServiceTypes& types_;
  Repeatability& repeatability_;
  std::shared_ptr<CallInbox> inbox_;
  std::map<std::uint64_t, std::shared_ptr<NodeCall>> in_progress_;  ///< by number
  ros_utils::ThreadedCallbackQueue queue_;
  std::map<std::string, Entry> entries_;  ///< by name
};

/// "/uav1/arm".
std::string name_at_server(const RelayService& service);
/// "/usv1/to/uav1/arm".
std::string name_at_caller(const RelayService& service);

}  // namespace trident::sim
