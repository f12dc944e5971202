// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "comms/relay/datagram.h"
#include "comms/relay/relay.h"
#include "comms/relay/relay_rules.h"
#include "trident_base/random_stream.h"
#include "trident_sim/bytes_sample.h"

namespace trident::sim {
namespace {

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

RelayRule rule(Reliability reliability, int depth, double deadline_s,
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

RelayMessage message(std::uint64_t number, SimTime born, std::size_t bytes = 20) {
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

/// TRIDENT_RELAY_MESSAGES is for long runs.
std::uint64_t message_count() {
  const char* const text = std::getenv("TRIDENT_RELAY_MESSAGES");
  return text == nullptr ? 50000 : std::stoull(text);
}

std::vector<std::uint64_t> numbers(std::uint64_t end) {
  std::vector<std::uint64_t> result;
  for (std::uint64_t i = 0; i < end; ++i) result.push_back(i);
  return result;
}

TEST(Datagram, IsWhatItWas) {
  PartDatagram part;
  part.rule = 513;
  part.number = 1ULL << 40;
  part.oldest = 77;
  part.part = 2;
  part.parts = 3;
  part.born = SimTime{123456789012345};
  part.data = "\x00\xffx";
  const std::string bytes = encode(part);
  const auto back = decode_part(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->rule, 513);
  EXPECT_EQ(back->number, 1ULL << 40);
  EXPECT_EQ(back->oldest, 77u);
  EXPECT_EQ(back->part, 2);
  EXPECT_EQ(back->parts, 3);
  EXPECT_EQ(back->born.ns, 123456789012345);
  EXPECT_EQ(back->data, part.data);
  EXPECT_FALSE(decode_ack(bytes));
  constexpr std::size_t kHeaderBytes = 31;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(decode_part(bytes.substr(0, size)).has_value(), size >= kHeaderBytes) << size;
  }
  const auto ack = decode_ack(encode(AckDatagram{9, 100, {102, 105}}));
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->rule, 9);
  EXPECT_EQ(ack->next, 100u);
  EXPECT_EQ(ack->beyond, (std::vector<std::uint64_t>{102, 105}));
}

TEST(Datagram, ChanceBytesAreNone) {
  RandomStream random(3, "bytes");
  std::uint64_t draw = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string bytes(static_cast<std::size_t>(random.uniform(++draw, 0) * 60), '\0');
    for (char& c : bytes) c = static_cast<char>(random.uniform(++draw, 0) * 256);
    if (!bytes.empty() && i % 2 == 0) bytes[0] = i % 4 == 0 ? 'P' : 'A';
    const auto part = decode_part(bytes);
    EXPECT_TRUE(!part || part->parts == 0 || part->part < part->parts);
    decode_ack(bytes);
  }
}

TEST(Relay, ReliableMessagesComeOnceAndInOrderThroughLossDoublesAndAnOutage) {
  Rig rig({rule(Reliability::kReliable, 100000, 0.0)});
  rig.radio.loss = 0.3;
  rig.radio.doubling = 0.1;
  rig.radio.max_delay = SimTime{40'000'000};
  rig.radio.outage_begin = SimTime::from_seconds(20.0);
  rig.radio.outage_end = SimTime::from_seconds(25.0);
  const std::uint64_t count = message_count();
  std::uint64_t next = 0;
  while (next < count) {
    std::vector<RelayMessage> some;
    for (int i = 0; i < 5 && next < count; ++i) some.push_back(message(next++, rig.radio.now));
    rig.step(some);
  }
  for (int i = 0; i < 20000 && rig.received["b"].size() < count; ++i) rig.step();
  EXPECT_EQ(rig.received["b"], numbers(count));
  EXPECT_EQ(rig.counts().delivered, count);
  EXPECT_GT(rig.counts().resent, count / 4);
  EXPECT_GT(rig.counts().doubles, 0u);
  // A third is lost of parts, and of acknowledgements.
  EXPECT_LT(rig.counts().datagrams, 3 * count);
  for (int i = 0; i < 200; ++i) rig.step();
  const std::uint64_t sent = rig.radio.sent;
  for (int i = 0; i < 200; ++i) rig.step();
  EXPECT_EQ(rig.radio.sent, sent) << "somebody still sends";
}

TEST(Relay, WhatIsTooOldIsGivenUpAndWhatFollowsIsNot) {
  Rig rig({rule(Reliability::kReliable, 1000, 2.0)});
  rig.radio.loss = 0.3;
  rig.radio.outage_begin = SimTime::from_seconds(3.0);
  rig.radio.outage_end = SimTime::from_seconds(8.0);
  std::uint64_t next = 0;
  for (int i = 0; i < 1500; ++i) {
    rig.step(i % 10 == 0 ? std::vector{message(next++, rig.radio.now)}
                         : std::vector<RelayMessage>{});
  }
  for (int i = 0; i < 300; ++i) rig.step();
  const auto& got = rig.received["b"];
  EXPECT_TRUE(std::is_sorted(got.begin(), got.end()));
  EXPECT_EQ(std::adjacent_find(got.begin(), got.end()), got.end());
  EXPECT_LE(*std::max_element(rig.ages.begin(), rig.ages.end()), 2.0);
  // Those of the outage's first three seconds had no time left after it; the others arrive.
  EXPECT_GE(got.size() + rig.counts().expired, next);
  for (std::uint64_t i = 0; i < next; ++i) {
    const double at_s = 0.1 * static_cast<double>(i);
    const bool has_arrived = std::binary_search(got.begin(), got.end(), i);
    const bool had_time = at_s < 1.0 || at_s > 6.7, had_none = at_s > 3.0 && at_s < 6.0;
    EXPECT_TRUE(has_arrived || !had_time) << i;
    EXPECT_FALSE(has_arrived && had_none) << i;
  }
}

/// Of a flow that is idle.
void expect_each_counted_once(const RelayCounts& counts) {
  EXPECT_EQ(counts.delivered + counts.expired + counts.superseded + counts.refused + counts.thinned,
            counts.offered);
}

TEST(Relay, AMessageThatIsTooOldAtBothEndsIsCountedOnce) {
  Rig rig({rule(Reliability::kReliable, 1000, 0.1)});
  rig.radio.min_delay = SimTime{150'000'000};  // whatever arrives is too old
  rig.radio.max_delay = SimTime{160'000'000};
  for (std::uint64_t i = 0; i < 20; ++i) rig.step({message(i, rig.radio.now)});
  for (int i = 0; i < 300; ++i) rig.step();
  EXPECT_TRUE(rig.received["b"].empty());
  EXPECT_EQ(rig.counts().expired, 20u);
}

TEST(Relay, AMessageWhoseAcknowledgementIsLostIsDeliveredAndNothingElse) {
  for (const int depth : {5, 1000}) {
    Rig rig({rule(Reliability::kReliable, depth, 0.5)});
    rig.radio.is_deaf = {"a"};
    for (std::uint64_t i = 0; i < 20; ++i) rig.step({message(i, rig.radio.now)});
    for (int i = 0; i < 300; ++i) rig.step();
    EXPECT_EQ(rig.received["b"], numbers(20));
    expect_each_counted_once(rig.counts());
  }
}

TEST(Relay, EachMessageIsCountedOnceWhateverIsLost) {
  for (const int depth : {3, 1000}) {
    for (const double deadline_s : {0.1, 0.3, 2.0}) {
      Rig rig({rule(Reliability::kReliable, depth, deadline_s)});
      rig.radio.loss = 0.5;
      rig.radio.doubling = 0.1;
      rig.radio.max_delay = SimTime{80'000'000};
      for (std::uint64_t i = 0; i < 2000; ++i) {
        rig.step({message(i, rig.radio.now, i % 3 == 0 ? 4000 : 20)});
      }
      for (int i = 0; i < 1000; ++i) rig.step();
      EXPECT_EQ(rig.counts().offered, 2000u);
      expect_each_counted_once(rig.counts());
      EXPECT_EQ(rig.counts().delivered, rig.received["b"].size());
    }
  }
}

TEST(Relay, NewerMessagesForOneRobotReplaceNoneForAnotherOverTheSameHop) {
  Rig rig({rule(Reliability::kBestEffort, 1, 0.0, {"b", "c"}),
           rule(Reliability::kBestEffort, 1, 0.0, {"b"})});
  rig.step({message(0, rig.radio.now)});
  const std::uint32_t flow = rig.radio.histories["b"].flow;
  EXPECT_NE(flow, rig.radio.histories["c"].flow);
  rig.step({message(1, rig.radio.now)});
  EXPECT_EQ(rig.radio.histories["b"].flow, flow) << "of one pair it stays the same";
  rig.relay.offer(1, "a", message(2, rig.radio.now), rig.radio.now, rig.radio);
  EXPECT_NE(rig.radio.histories["b"].flow, flow) << "of another rule";
}

TEST(Relay, BeyondItsDepthAReliableRuleDropsTheOldest) {
  Rig rig({rule(Reliability::kReliable, 5, 0.0)});
  rig.radio.outage_begin = SimTime{0};
  rig.radio.outage_end = SimTime::from_seconds(1.0);
  for (std::uint64_t i = 0; i < 20; ++i) rig.step({message(i, rig.radio.now)});
  for (int i = 0; i < 300; ++i) rig.step();
  EXPECT_EQ(rig.received["b"], (std::vector<std::uint64_t>{15, 16, 17, 18, 19}));
  EXPECT_EQ(rig.counts().superseded, 15u);
}

TEST(Relay, LargeMessagesAreCutAndPutTogether) {
  for (const Reliability reliability : {Reliability::kReliable, Reliability::kBestEffort}) {
    Rig rig({rule(reliability, 100, 0.0)});
    rig.radio.max_delay = SimTime{5'000'000};
    const std::vector<std::size_t> sizes{20, 1400, 1401, 2800, 90000};
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      rig.step({message(i, rig.radio.now, sizes[i])});
    }
    for (int i = 0; i < 100; ++i) rig.step();
    EXPECT_EQ(rig.bytes, sizes);
  }
}

TEST(Relay, BestEffortIsNeverOldNorOutOfOrder) {
  Rig rig({rule(Reliability::kBestEffort, 10, 0.05, {"all"})});
  rig.radio.loss = 0.3;
  rig.radio.doubling = 0.1;
  rig.radio.max_delay = SimTime{80'000'000};
  for (std::uint64_t i = 0; i < 5000; ++i) rig.step({message(i, rig.radio.now)});
  for (int i = 0; i < 20; ++i) rig.step();
  for (const char* robot : {"b", "c"}) {
    const auto& got = rig.received[robot];
    EXPECT_GT(got.size(), 500u);
    EXPECT_TRUE(std::is_sorted(got.begin(), got.end()));
    EXPECT_EQ(std::adjacent_find(got.begin(), got.end()), got.end());
  }
  EXPECT_LE(*std::max_element(rig.ages.begin(), rig.ages.end()), 0.05);
  EXPECT_EQ(rig.radio.sent, 5000u) << "a broadcast is one transmission";
}

TEST(Relay, MaxRateIsTheMeanRate) {
  RelayRule limited = rule(Reliability::kBestEffort, 10, 0.0);
  limited.max_rate_hz = 30.0;
  Rig rig({limited});
  for (std::uint64_t i = 0; i < 1000; ++i) rig.step({message(i, rig.radio.now)});
  EXPECT_NEAR(static_cast<double>(rig.received["b"].size()), 300.0, 1.0);
  EXPECT_EQ(rig.counts().thinned + rig.received["b"].size(), 1000u);
}

TEST(Relay, WhatIsThinnedNeedsNoBytes) {
  RelayRule limited = rule(Reliability::kBestEffort, 10, 0.0);
  limited.max_rate_hz = 30.0;
  Rig with({limited}), without({limited});
  for (std::uint64_t i = 0; i < 1000; ++i) {
    with.step({message(i, with.radio.now)});
    RelayMessage bare = message(i, without.radio.now);
    if (without.relay.is_thinned(0, "a", without.radio.now)) bare.data = nullptr;
    without.step({bare});
  }
  EXPECT_EQ(without.received["b"], with.received["b"]);
  EXPECT_EQ(without.counts().thinned, with.counts().thinned);
  EXPECT_FALSE(without.relay.is_thinned(0, "c", without.radio.now)) << "it has had no message";
}

TEST(Relay, WhenTheFirstMessageWasToBeSentIsKnown) {
  Rig rig({rule(Reliability::kReliable, 10, 0.0)});
  rig.step();
  rig.step({message(0, rig.radio.now)});
  rig.step({message(1, rig.radio.now)});
  EXPECT_EQ(rig.counts().first_s, 0.01);
}

TEST(StampUse, AMessageCountsAtItsStampUnlessThatIsOfAnotherClock) {
  const SimTime now = SimTime::from_seconds(5.0);
  EXPECT_EQ(stamp_use({}, now), StampUse::kNow);
  EXPECT_EQ(stamp_use(now, now), StampUse::kNow);
  EXPECT_EQ(stamp_use(now + SimTime{1}, now), StampUse::kAtItsStamp);
  EXPECT_EQ(stamp_use(now + kFarAhead, now), StampUse::kAtItsStamp);
  EXPECT_EQ(stamp_use(now + kFarAhead + SimTime{1}, now), StampUse::kOfOtherClock);
}

TEST(Relay, WhatCannotBeIsReportedOnce) {
  Rig large({rule(Reliability::kBestEffort, 10, 0.0)});
  for (int i = 0; i < 3; ++i) large.step({message(0, large.radio.now, 200000)});
  ASSERT_EQ(large.reports.size(), 1u);
  EXPECT_EQ(large.reports[0],
            "rule 1 (topic): a message of a/topic has 200000 bytes, legal: at most 100000, its "
            "radio's queue; reliable rules take larger ones");
  EXPECT_EQ(large.counts().refused, 3u);

  Rig fast({rule(Reliability::kBestEffort, 10, 0.0, {"all"})});
  for (int i = 0; i < 300; ++i) fast.step({message(0, fast.radio.now, 20000)});
  ASSERT_EQ(fast.reports.size(), 1u);
  EXPECT_NE(fast.reports[0].find("rule 1 (topic): a/topic has 16"), std::string::npos)
      << fast.reports[0];
}

TEST(Relay, OfARobotThatIsReplacedNothingIsKept) {
  Rig rig({rule(Reliability::kReliable, 100, 0.0)});
  rig.step({message(0, rig.radio.now)});
  rig.step();
  rig.relay.set_robots({"a", "c"});
  rig.relay.set_robots({"a", "b", "c"});
  rig.step({message(1, rig.radio.now)});
  rig.step();
  EXPECT_EQ(rig.received["b"], (std::vector<std::uint64_t>{0, 1}));
}

const char* const kFile = R"(
radio: {tx_power: 10.0, height: 0.3}
model: {path: free_space}
rules:
  - {topic: odometry, from: all, to: all, reliability: best_effort, depth: 1, max_rate: 5.0, deadline: 0.5, priority: 2}
  - {topic: detections, to: [usv1, gcs], reliability: reliable, depth: 50, deadline: 30.0, priority: 0}
)";

TEST(RelayRules, AreRead) {
  const RelayFile file = parse_relay_file(kFile, "team.yaml");
  EXPECT_EQ(file.radio.at("tx_power"), "10.0");
  ASSERT_EQ(file.rules.size(), 2u);
  EXPECT_TRUE(file.rules[0].is_broadcast());
  EXPECT_FALSE(file.rules[1].is_broadcast());
  EXPECT_TRUE(file.rules[1].is_reliable());
  EXPECT_EQ(file.rules[1].to, (std::vector<std::string>{"usv1", "gcs"}));
  EXPECT_TRUE(file.rules[1].is_from("anybody"));
  EXPECT_FALSE(file.rules[1].is_to("anybody"));
}

TEST(RelayRules, AServiceAndATopicOfOneNameAreTwoThings) {
  const RelayFile file = parse_relay_file(
      "rules:\n  - {topic: x}\n  - {service: x, from: a, to: all, deadline: 3}\n", "team.yaml");
  ASSERT_EQ(file.rules.size(), 2u);
  EXPECT_FALSE(file.rules[0].is_service());
  EXPECT_TRUE(file.rules[1].is_service());
  EXPECT_TRUE(file.rules[1].is_reliable());
  EXPECT_FALSE(file.rules[1].is_broadcast());
  EXPECT_EQ(file.rules[1].from, (std::vector<std::string>{"a"}));
}

std::string error_of(const std::string& text) {
  try {
    parse_relay_file(text, "team.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(RelayRules, WhatCannotBeIsOneErrorWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"rules:\n  - {topic: x, reliability: sure}", "team.yaml:2"},
      {"rules:\n  - {from: all}", "topic"},
      {"rules:\n  - {topic: /x}", "without outer slashes"},
      {"rules:\n  - {topic: from/b/x}", "which a robot has by radio"},
      {"rules:\n  - {topic: x, to: [all, b]}", "names of robots, or all alone"},
      {"rules:\n  - {topic: x, to: []}", "names of robots, or all alone"},
      {"rules:\n  - {topic: x, depth: 0}", "[1, 1e+05]"},
      {"rules:\n  - {topic: x, priority: 4}", "[0, 3]"},
      {"rules:\n  - {topic: x, deadline: .nan}", "team.yaml:2"},
      {"rules:\n  - {topic: x}\n  - {topic: x, from: [a]}", "rule 1 (x) and rule 2 (x)"},
      {"rules:\n  - {service: x}", "deadline: missing required key"},
      {"rules:\n  - {service: x, deadline: 0}", "[0.001, 1e+06]"},
      {"rules:\n  - {service: x, topic: y, deadline: 1}", "topic: unknown key"},
      {"rules:\n  - {service: x, deadline: 1, max_rate: 1}", "max_rate: unknown key"},
      {"rules:\n  - {topic: x, delay: 1}", "delay: unknown key"},
      {"rules:\n  - {service: x, deadline: 1, delay: 1}", "delay is 1, legal: less than deadline"},
      {"rules:\n  - {service: to/b/x, deadline: 1}", "by radio; legal: one of its own"},
      {"rules:\n  - {service: x/, deadline: 1}", "service is 'x/', legal: a name without outer"},
      {"rules:\n  - {service: x, deadline: 1}\n  - {service: x, deadline: 2}",
       "rule 1 (x) and rule 2 (x) relay one service"},
      {"rule: []", "rules"},
  };
  for (const auto& [text, part] : cases) {
    EXPECT_NE(error_of(text).find(part), std::string::npos) << text << "\n" << error_of(text);
  }
}

}  // namespace
}  // namespace trident::sim
