// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "comms/relay/relay.h"
#include "comms/relay/relay_calls.h"
#include "trident_sim/comms/relay.h"
#include "trident_sim/samples/bytes_sample.h"
#include "trident_sim/state_archive.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// The topics of a relay: topic T of robot A is an input A/T, and what robot B hears of it an
/// output B/from/A/T, both of bytes. Calls of services go through it, too.
class RelayPorts : public RelayReport, public RelayServices {
 public:
  /// `world` must outlive it; `file` names the rules in reports.
  RelayPorts(World& world, const RelayFile& rules, std::string file);

  /// Radios that are there now: ports follow.
  void set_robots(const std::vector<std::string>& robots);
  /// Gives the radios what the topics have had by the beginning of a step.
  void send(SimTime begin, Radio& radio);
  /// Publishes what they have received by its end.
  void receive(SimTime end, Radio& radio);
  void reset();
  void state(StateArchive& archive);

  std::vector<RelayFlow> flows() const override;
  std::vector<CallFlow> calls() const override;
  bool is_thinned(const std::string& topic, SimTime at) const override;
  std::map<std::string, std::uint64_t> heard(const std::string& robot) const override;
  std::vector<std::string> route(const std::string& source,
                                 const std::string& destination) const override {
    return relay_.network().route(source, destination);
  }
  std::vector<RelayService> services() const override;
  std::uint64_t call(const RelayService& service,
                     std::shared_ptr<const std::string> request) override;
  std::vector<ServedCall> take_served() override { return calls_.take_served(); }
  void answer(const CallResult& answer) override { calls_.answer(answer, &relay_); }
  void abort(std::uint64_t number, const std::string& why) override {
    calls_.abort(number, why, relay_.rules());
  }
  std::vector<CallResult> take_results() override { return calls_.take_results(); }

 private:
  struct Input {
    InHandle<BytesSample> port;
    std::uint64_t seen = 0;
    std::vector<std::size_t> rules;
    std::string robot;
    bool has_reported_stamp = false, has_reported_loss = false;
  };
  /// A message whose stamp is still to come.
  struct Later {
    std::size_t rule;
    std::string robot;
    BytesSample sample;
  };
  using OutputKey = std::tuple<std::size_t, std::string, std::string>;  ///< rule, source, receiver
  using Latched = std::map<std::pair<std::size_t, std::string>, BytesSample>;  ///< rule, source

  void report(const std::string& text);
  bool is_command(const std::string& input) const;
  void add_inputs(const std::vector<std::string>& robots);
  void add_outputs(const std::vector<std::string>& robots);
  void read(Input& input, SimTime now, Radio& radio);
  void offer(std::size_t rule, const std::string& robot, const BytesSample& sample, SimTime now,
             Radio& radio);
  void offer_due(SimTime now, Radio& radio);
  void offer_latched(SimTime now, Radio& radio);
  void publish(const RelayDelivery& delivery);
  std::vector<std::string> missing_radios(const RelayRule& rule) const;
  bool has_heard(std::size_t rule) const;
  void report_idle_rules();

  World& world_;
  std::string file_;
  std::vector<std::string> robots_;
  std::map<std::string, Input> inputs_;  ///< by port
  std::map<OutputKey, OutHandle<BytesSample>> outputs_;
  std::set<std::string> reported_commands_;   ///< inputs that no rule can have
  std::vector<OutPort<BytesSample>*> fresh_;  ///< outputs with a message of this step
  // What changes from step to step.
  Relay relay_;
  RelayCalls calls_;
  std::vector<Later> later_;            ///< by arrival
  Latched latched_;                     ///< newest of topics that are latched
  std::vector<std::string> newcomers_;  ///< robots that have not got these
  bool has_looked_for_idle_ = false;
};

}  // namespace trident::sim
