// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "loss_watch.h"
#include "served_calls.h"
#include "topics/called_services.h"
#include "topics/look_schedule.h"
#include "topics/service_types.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// Services that robots call of each other by radio (rules of libtrident_radio_medium.so): the
/// calls of nodes go into the simulation, and come out of it at the nodes that serve. Who calls
/// waits on a thread of its own, never the stepping one; the world waits for servers alone, and
/// those who wait for each other get an error. By the stepping thread, with the world's mutex held.
class RadioCalls {
 public:
  /// All arguments must outlive it.
  RadioCalls(ros::NodeHandle& node, const World& world, LossWatch& losses, ReportSink report);

  /// Follows robots that came or went.
  void sync();
  /// Advertises services whose type is known now. Looks only now and then.
  void look_for_types();
  /// The step that begins at `begin` has the answers of servers that it needs.
  bool allows_step(SimTime begin);
  /// Waits for a call or an answer for up to milliseconds; without the world's mutex.
  void wait() { bell_->wait(std::chrono::milliseconds(2)); }
  /// See ServedCalls.
  void check_timeouts(SimTime now) { served_.check_timeouts(now); }
  /// Hands over what counts in the step that begins at `begin`.
  void deliver(SimTime begin);
  /// Hands out what has crossed in the step that was made.
  void take();
  /// The world waits for these nodes: their calls, which would have to wait for the world, end.
  void abort_calls_of(const std::vector<std::string>& nodes, const std::string& why);
  /// Whether the world waits for an answer of that node.
  bool waits_for(const std::string& node) const { return served_.waits_for(node, world_.time()); }
  /// How many calls there are, in words; "" in a world without rules of services.
  std::string describe() const;
  /// Time begins again, the world's calls have ended.
  void clear();
  /// All calls end with an error.
  void end(const std::string& why);

 private:
  ServedCalls::IsCalling is_calling() const {
    return [this](const std::string& node, std::uint64_t received) {
      return called_.is_calling(node, received);
    };
  }
  void report_unserved();

  const World& world_;
  ReportSink report_;
  Repeatability& repeatability_;
  std::shared_ptr<RelayServices> relay_;  ///< nullptr: the world has no rules
  LookSchedule looks_;
  ServiceTypes types_;
  std::shared_ptr<MessageBell> bell_ = std::make_shared<MessageBell>();
  CalledServices called_;
  ServedCalls served_;
  std::uint64_t version_ = ~std::uint64_t{0};  ///< of the world's ports
  WallTime known_since_ = 0;                   ///< since when there are services to be found
  bool has_reported_unserved_ = false;
};

}  // namespace trident::sim
