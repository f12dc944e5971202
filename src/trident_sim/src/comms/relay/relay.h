// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "comms/relay/best_effort_flow.h"
#include "comms/relay/relay_message.h"
#include "comms/relay/relay_network.h"
#include "comms/relay/relay_rules.h"
#include "comms/relay/reliable_flow.h"
#include "trident_sim/comms/radio.h"
#include "trident_sim/comms/relay.h"

namespace trident::sim {

/// A message that has crossed.
struct RelayDelivery {
  std::size_t rule = 0;
  std::string source, destination;  ///< robots
  RelayMessage message;
  SimTime received;
};

/// Carries messages from robots to robots over their radios, by rules: those of a topic in their
/// order and once each. Called between steps. A value.
class Relay {
 public:
  using Report = std::function<void(const std::string&)>;
  /// Rule, source and destination ("all": by broadcast, as sent).
  struct Key {
    std::size_t rule;
    std::string source, destination;
    bool operator<(const Key& other) const;
    bool operator==(const Key& other) const;
  };
  /// Of a message of a reliable rule.
  static constexpr std::size_t kMaxBytes = kPartBytes * std::numeric_limits<std::uint16_t>::max();

  /// `report`: takes what a user should know.
  Relay(std::vector<RelayRule> rules, Report report, bool has_routing = false);

  const std::vector<RelayRule>& rules() const { return rules_; }
  const RelayNetwork& network() const { return network_; }
  /// Robots with radios, now. What others had sent or were to receive is void.
  void set_robots(const std::vector<std::string>& robots);
  /// A message of a robot's topic that counts now. Without data: one that is_thinned().
  void offer(std::size_t rule, const std::string& source, const RelayMessage& message, SimTime now,
             Radio& radio);
  /// The same again, for one robot alone, whatever max_rate says.
  void offer_again(const Key& key, const RelayMessage& message, SimTime now, Radio& radio);
  /// Whether a message of a robot's topic that counted at `at` would be left out for max_rate.
  bool is_thinned(std::size_t rule, const std::string& source, SimTime at) const;
  /// A message of a service's rule, from robot to robot. False: it has more than kMaxBytes.
  bool post(const Key& key, std::string data, SimTime born);
  /// Gives the radios what reliable flows have to send.
  void send(SimTime now, Radio& radio);
  /// Takes what the radios have received, acknowledges, and returns what is whole, by time.
  std::vector<RelayDelivery> receive(SimTime now, Radio& radio);
  /// Of both kinds of rules.
  const std::map<Key, RelayCounts>& counts() const { return counts_; }
  void reset();

 private:
  /// A topic that crosses, at its source.
  struct Topic {
    SimTime due;  ///< from which on max_rate lets the next message pass
    std::uint64_t next_number = 0;
    std::map<std::string, std::uint32_t> flows;  ///< of the radios' queues, by destination
    SimTime second;                              ///< when the present second of counting began
    std::uint64_t bytes = 0;                     ///< in it
    bool has_reported_rate = false, has_reported_size = false;
  };

  static bool thin(const RelayRule& rule, Topic* topic, SimTime now);
  void check_rate(const std::pair<std::size_t, std::string>& key, Topic* topic, std::size_t bytes,
                  SimTime now, Radio& radio);
  bool is_too_large(const std::pair<std::size_t, std::string>& key, Topic* topic, std::size_t bytes,
                    Radio& radio);
  ReliableSender& sender(const Key& key);
  std::uint64_t passed(const Key& key) const;
  void send_to(const Key& key, const RelayMessage& message, std::uint64_t number, SimTime now,
               Radio& radio);
  std::vector<std::string> destinations(const RelayRule& rule, const std::string& source) const;
  void send_once(const Key& key, const RelayMessage& message, std::uint64_t number, SimTime now,
                 Radio& radio);
  bool is_for(const PartDatagram& part, const std::string& receiver) const;
  void take(const std::string& receiver, const RadioMessage& packet,
            std::vector<RelayDelivery>* deliveries);
  void take_part(const Key& key, const PartDatagram& part, SimTime now,
                 std::vector<RelayDelivery>* deliveries);
  void acknowledge(SimTime now, Radio& radio);

  std::vector<RelayRule> rules_;
  Report report_;
  RelayNetwork network_;
  std::vector<std::string> robots_;
  std::map<std::pair<std::size_t, std::string>, Topic> topics_;  ///< by rule and source
  std::uint32_t next_flow_ = 1;
  std::map<Key, ReliableSender> senders_;
  std::map<Key, ReliableReceiver> reliable_;
  std::map<Key, BestEffortReceiver> best_effort_;
  std::map<Key, RelayCounts> counts_;
};

}  // namespace trident::sim
