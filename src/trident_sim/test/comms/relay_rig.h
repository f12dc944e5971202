// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "comms/relay/relay.h"
#include "comms/relay/relay_rules.h"
#include "trident_base/random_stream.h"

namespace trident::sim {

constexpr SimTime kStep{10'000'000};

/// Radios between which datagrams are lost, doubled and late by chance, and sometimes all lost.
class LossyRadio : public Radio {
 public:
  double loss = 0.0, doubling = 0.0;
  SimTime min_delay{1'000'000}, max_delay{1'000'000};
  SimTime outage_begin{-1}, outage_end{-1};
  SimTime now;
  std::uint64_t sent = 0;
  std::map<std::string, RadioHistory> histories;  ///< newest by destination
  std::set<std::string> is_deaf;                  ///< what is for these is lost

  std::vector<std::string> names() override { return {"a", "b", "c"}; }
  bool send(const std::string& source, const std::string& destination, std::string data,
            const RadioQos& qos) override {
    ++sent;
    EXPECT_EQ(qos.port, kRelayPort);
    if (qos.history.depth > 0) histories[destination] = qos.history;
    for (const std::string& name : names()) {
      if (name == source || (destination != kAll && destination != name)) continue;
      if (is_deaf.count(name) > 0) continue;
      if (random_.uniform(++draws_, 0) >= loss) put(source, name, data);
      if (random_.uniform(++draws_, 0) < doubling) put(source, name, data);
    }
    return true;
  }
  std::vector<RadioMessage> receive(const std::string& name, int port) override {
    EXPECT_EQ(port, kRelayPort);
    std::vector<RadioMessage> result;
    auto& own = on_air_[name];
    for (auto at = own.begin(); at != own.end() && at->first <= now.ns; at = own.erase(at)) {
      result.push_back(at->second);
    }
    return result;
  }
  RadioLimits limits(const std::string&) override { return {100000, 6e6, false}; }
  double rate_bit_s(const std::string&, const std::string&) override { return 65e6; }
  std::vector<RadioLink> links(const std::string& source) override {
    RadioLink link;
    link.source = source;
    link.destination = "b";
    link.rate_bit_s = 65e6;
    return {link};
  }
  void set_outage(const std::string&, const std::string&, SimTime) override {}
  std::string state_text() const override { return ""; }

 private:
  void put(const std::string& source, const std::string& name, const std::string& data) {
    if (now >= outage_begin && now < outage_end) return;
    const double share = random_.uniform(++draws_, 0);
    const SimTime at =
        now + min_delay +
        SimTime{static_cast<std::int64_t>(share * static_cast<double>((max_delay - min_delay).ns))};
    on_air_[name].emplace(at.ns, RadioMessage{source, data, now, at, 20.0});
  }

  RandomStream random_{7, "lossy"};
  std::uint64_t draws_ = 0;
  std::map<std::string, std::multimap<std::int64_t, RadioMessage>> on_air_;
};

inline RelayRule rule(Reliability reliability, int depth, double deadline_s,
                      std::vector<std::string> to = {"b"}) {
  RelayRule result;
  result.topic = "topic";
  result.from = {"a"};
  result.to = std::move(to);
  result.reliability = reliability;
  result.depth = depth;
  result.deadline_s = deadline_s;
  return result;
}

inline RelayMessage message(std::uint64_t number, SimTime born, std::size_t bytes = 20) {
  std::string text = std::to_string(number) + " ";
  text.resize(std::max(bytes, text.size()), 'x');
  return {born, std::make_shared<const std::string>(std::move(text))};
}

/// A relay and its air, stepped together.
struct Rig {
  explicit Rig(std::vector<RelayRule> rules)
      : relay(std::move(rules), [this](const std::string& text) { reports.push_back(text); }) {
    relay.set_robots({"a", "b", "c"});
  }

  void step(const std::vector<RelayMessage>& messages = {}) {
    for (const RelayMessage& m : messages) relay.offer(0, "a", m, radio.now, radio);
    relay.send(radio.now, radio);
    radio.now = radio.now + kStep;
    for (RelayDelivery& delivery : relay.receive(radio.now, radio)) {
      EXPECT_LE(delivery.received, radio.now);
      received[delivery.destination].push_back(std::stoull(*delivery.message.data));
      bytes.push_back(delivery.message.data->size());
      ages.push_back((delivery.received - delivery.message.born).seconds());
    }
  }
  const RelayCounts& counts(const std::string& to = "b") { return relay.counts().at({0, "a", to}); }

  std::vector<std::string> reports;
  Relay relay;
  LossyRadio radio;
  std::map<std::string, std::vector<std::uint64_t>> received;
  std::vector<std::size_t> bytes;
  std::vector<double> ages;
};

/// From 0 on.
inline std::vector<std::uint64_t> numbers(std::uint64_t end) {
  std::vector<std::uint64_t> result;
  for (std::uint64_t i = 0; i < end; ++i) result.push_back(i);
  return result;
}

}  // namespace trident::sim
