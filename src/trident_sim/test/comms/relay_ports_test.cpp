// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Topics that cross between robots of a world by the rules of a file.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "relay_world.h"
#include "trident_sim/samples/radio_samples.h"

namespace trident::sim {
namespace {

constexpr const char* kRules = R"(
radio: {tx_power: 10.0, height: 0.5}
model: {path: free_space, shadowing_sigma: 0}
rules:
  - {topic: odometry, reliability: best_effort, depth: 1, deadline: 0.5, priority: 2}
  - {topic: detections, from: [a], to: [b], reliability: reliable, depth: 100, deadline: 30.0}
)";

TEST(RelayPorts, ATopicOfOneIsHeardByTheOtherWhenTheRadioDeliversIt) {
  RelayWorld two(kRules);
  std::vector<std::string> heard;
  two.world->step(3);
  two.write("a/detections", std::string("x\0y", 3));
  two.step(1, "b/from/a/detections", &heard);
  EXPECT_EQ(heard, (std::vector<std::string>{std::string("x\0y", 3)}));
  EXPECT_EQ(two.world->ports().find_out<BytesSample>("b/from/a/detections")->value.origin,
            "a/detections");
  two.step(20, "b/from/a/detections", &heard);
  EXPECT_EQ(heard.size(), 1u);
  // What is in no rule has no port.
  EXPECT_EQ(two.world->ports().find("a/from/b/detections", PortDirection::kOut), nullptr);
  EXPECT_EQ(two.world->ports().find("b/detections", PortDirection::kIn), nullptr);
  EXPECT_NE(two.world->ports().find("a/from/b/odometry", PortDirection::kOut), nullptr);
}

TEST(RelayPorts, TheFileStandsInPlaceOfTheElements) {
  RelayWorld two(kRules);
  const RadioLink link = find_radio(*two.world)->links()[0];
  RelayWorld free("model: {path: free_space, shadowing_sigma: 0}", 50.0);
  EXPECT_NEAR(find_radio(*free.world)->links()[0].rssi_dbm - link.rssi_dbm, 10.0, 1e-9);
  EXPECT_EQ(link.loss_db, find_radio(*free.world)->links()[0].loss_db);
}

TEST(RelayPorts, AStampIsWaitedFor) {
  RelayWorld two(kRules);
  std::vector<std::string> heard;
  two.world->step(1);
  two.write("a/detections", "later", SimTime::from_seconds(0.1));
  two.write("a/detections", "now", SimTime::from_seconds(0.005));
  two.step(1, "b/from/a/detections", &heard);
  EXPECT_EQ(heard, (std::vector<std::string>{"now"}));
  two.step(8, "b/from/a/detections", &heard);
  EXPECT_EQ(heard.size(), 1u);
  two.step(1, "b/from/a/detections", &heard);
  EXPECT_EQ(heard, (std::vector<std::string>{"now", "later"}));
  two.write("a/detections", "of a wall clock", SimTime::from_seconds(1.8e9));
  two.step(1, "b/from/a/detections", &heard);
  EXPECT_EQ(heard.back(), "of a wall clock");
  EXPECT_EQ(two.world.report_count(Severity::kWarning, "ahead of the simulated time"), 1u);
}

TEST(RelayPorts, AfterAnOutageTheFirstIsNotOlderThanAPeriod) {
  RelayWorld two(kRules);
  auto radio = find_radio(*two.world);
  std::vector<std::string> heard;
  for (int i = 0; i < 130; ++i) {
    two.write("a/odometry", std::to_string(i));
    if (i == 10) radio->set_outage("a", "", two.world->time() + SimTime::from_seconds(10.0));
    two.step(10, "b/from/a/odometry", &heard);
  }
  // Ten each second; the outage is from 1.0 to 11.0 s.
  ASSERT_EQ(heard.size(), 30u);
  EXPECT_EQ(heard[9], "9");
  EXPECT_EQ(heard[10], "110");
}

TEST(RelayPorts, ReliableOnesSurviveAnOutage) {
  RelayWorld two(kRules);
  auto radio = find_radio(*two.world);
  std::vector<std::string> heard, sent;
  for (int i = 0; i < 100; ++i) {
    sent.push_back(std::to_string(i));
    two.write("a/detections", sent.back());
    if (i == 10) radio->set_outage("a", "b", two.world->time() + SimTime::from_seconds(5.0));
    two.step(10, "b/from/a/detections", &heard);
  }
  EXPECT_EQ(heard, sent);
  const auto flows = find_relay(*two.world)->flows();
  ASSERT_FALSE(flows.empty());
  EXPECT_EQ(flows.back().rule, "rule 2 (detections)");
  EXPECT_EQ(flows.back().counts.delivered, 100u);
}

TEST(RelayPorts, ARobotsStatusSaysHowManyMessagesHaveComeToIt) {
  RelayWorld two(kRules);
  auto* const status = two.world->ports().find_out<LinkStatusArraySample>("b/link_status");
  ASSERT_NE(status, nullptr);
  status->add_listener();
  std::vector<std::string> heard;
  for (int i = 0; i < 10; ++i) {
    two.write("a/detections", "x");
    two.step(10, "b/from/a/detections", &heard);
  }
  ASSERT_EQ(heard.size(), 10u);
  ASSERT_EQ(status->value.heard.size(), 1u);
  EXPECT_EQ(status->value.heard[0].topic, "from/a/detections");
  EXPECT_EQ(status->value.heard[0].messages, 10u);
}

constexpr const char* kRoutedRules = R"(
routing: true
radio: {tx_power: 10.0}
model: {path: free_space, shadowing_sigma: 0}
rules:
  - {topic: detections, from: [a], to: [b], reliability: reliable, depth: 100, deadline: 5.0}
  - {topic: pose, from: [a], to: [b], depth: 1, deadline: 0.5}
)";

TEST(RelayPorts, WhatIsOutOfReachGoesOverARobotBetween) {
  RelayWorld two(kRoutedRules, 1600.0);  // twice as far as a radio reaches
  std::vector<std::string> heard, sent, poses;
  for (int i = 0; i < 20; ++i) {
    two.write("a/detections", std::string(3000, 'x') + std::to_string(i));
    two.step(10, "b/from/a/detections", &heard);
  }
  EXPECT_TRUE(heard.empty());
  const auto relay = find_relay(*two.world);
  EXPECT_EQ(relay->route("a", "b"), (std::vector<std::string>{"a"}));
  two.add("c", 800.0);
  std::vector<std::string> late;
  two.step(600, "b/from/a/detections", &late);
  EXPECT_EQ(relay->route("a", "b"), (std::vector<std::string>{"a", "c", "b"}));
  heard.clear();
  for (int i = 0; i < 200; ++i) {
    sent.push_back(std::string(3000, 'x') + std::to_string(i));
    two.write("a/detections", sent.back());
    two.write("a/pose", std::to_string(i));
    two.step(10, "b/from/a/detections", &heard);
    const auto* const port = two.world->ports().find_out<BytesSample>("b/from/a/pose");
    if (port->count() > poses.size()) poses.push_back(*port->value.data);
  }
  EXPECT_EQ(heard, sent);
  EXPECT_GT(poses.size(), 195u);
}

TEST(RelayPorts, ARobotThatPassedOnAndIsOutIsGoneRound) {
  RelayWorld two(kRoutedRules, 1600.0);
  two.add("c", 800.0);
  two.add("d", 810.0);
  std::vector<std::string> heard;
  two.step(300, "b/from/a/detections", &heard);
  const auto relay = find_relay(*two.world);
  const auto route = relay->route("a", "b");
  ASSERT_EQ(route.size(), 3u);
  find_radio(*two.world)->set_outage(route[1], "", SimTime::from_seconds(1e6));
  two.step(100, "b/from/a/detections", &heard);
  const auto other = relay->route("a", "b");
  ASSERT_EQ(other.size(), 3u);
  EXPECT_NE(other[1], route[1]);
  two.write("a/detections", "after a second");
  two.step(5, "b/from/a/detections", &heard);
  EXPECT_EQ(heard, (std::vector<std::string>{"after a second"}));
}

std::vector<std::string> flight(const WorldOptions& options, bool with_snapshot,
                                std::string* hash) {
  RelayWorld two(kRules, 1000.0, {}, options);  // some frames are lost
  std::vector<std::string> heard;
  for (int i = 0; i < 100; ++i) {
    two.write("a/detections", std::string(3000, 'x') + std::to_string(i));
    two.step(2, "b/from/a/detections", &heard);
    if (!with_snapshot || i != 50) continue;
    const Snapshot snapshot = two.world->save_snapshot();
    std::vector<std::string> other;
    two.step(30, "b/from/a/detections", &other);
    two.world->restore_snapshot(snapshot);
  }
  *hash = two.world->state_hash();
  return heard;
}

TEST(RelayPorts, RunsRepeatWithAndWithoutSnapshotsAndThreads) {
  WorldOptions four;
  four.sensor_threads = 4;
  std::string hash, other_hash;
  const auto heard = flight({}, false, &hash);
  EXPECT_GT(heard.size(), 50u);
  EXPECT_EQ(flight({}, true, &other_hash), heard);
  EXPECT_EQ(other_hash, hash);
  EXPECT_EQ(flight(four, false, &other_hash), heard);
  EXPECT_EQ(other_hash, hash);
}

TEST(RelayPorts, InWhichOrderRobotsComeBeforeTheFirstStepDoesNotCount) {
  const auto hash_of = [](bool is_turned) {
    RelayWorld two("rules:\n  - {topic: pose}\n", 60.0);
    two.world->remove("b");
    if (is_turned) two.add("c", 70.0);
    two.add("b", 60.0);
    if (!is_turned) two.add("c", 70.0);
    std::vector<std::string> heard;
    for (int i = 0; i < 20; ++i) {
      for (const char* name : {"a", "b", "c"}) two.write(std::string(name) + "/pose", "here");
      two.step(10, "a/from/b/pose", &heard);
    }
    EXPECT_GT(heard.size(), 15u);
    return two.world->state_hash();
  };
  EXPECT_EQ(hash_of(false), hash_of(true));
}

TEST(RelayPorts, AResetForgetsWhatWaits) {
  RelayWorld two(kRules);
  std::vector<std::string> heard;
  two.write("a/detections", "0");
  two.step(5, "b/from/a/detections", &heard);
  two.write("a/detections", "lost", SimTime::from_seconds(1.0));
  two.world->step(1);
  two.world->reset();
  two.step(5, "b/from/a/detections", &heard);
  two.write("a/detections", "1");
  two.step(200, "b/from/a/detections", &heard);
  EXPECT_EQ(heard, (std::vector<std::string>{"0", "1"}));
}

TEST(RelayPorts, RobotsComeAndGo) {
  RelayWorld two(kRules);
  two.add("c", 20.0);
  std::vector<std::string> heard;
  two.write("c/odometry", "here");
  two.step(2, "b/from/c/odometry", &heard);
  EXPECT_EQ(heard, (std::vector<std::string>{"here"}));
  two.world->remove("c");
  EXPECT_EQ(two.world->ports().find("b/from/c/odometry", PortDirection::kOut), nullptr);
  EXPECT_EQ(two.world->ports().find("c/odometry", PortDirection::kIn), nullptr);
  two.world->step(2);
  two.add("c", 20.0);
  two.write("c/odometry", "again");
  two.step(2, "b/from/c/odometry", &heard);
  EXPECT_EQ(heard.back(), "again");
}

TEST(RelayPorts, WhatWaitsForItsStampGoesWithItsRobot) {
  RelayWorld two(kRules);
  two.add("c", 20.0);
  two.write("c/odometry", "later", SimTime::from_seconds(0.2));
  two.world->step(2);
  two.world->remove("c");
  EXPECT_NO_THROW(two.world->step(30));
}

TEST(RelayPorts, RulesThatMatchNothingAreNamed) {
  RelayWorld two("rules:\n  - {topic: x, from: [ship]}\n  - {topic: y}\n  - {topic: z, to: [b]}\n");
  two.write("a/z", "1");
  two.world->step(600);
  EXPECT_EQ(two.world.report_count(Severity::kWarning,
                                   "rule 1 (x): there is no radio 'ship' after 5 s, radios: a, b"),
            1u);
  EXPECT_EQ(
      two.world.report_count(Severity::kWarning,
                             "rule 2 (y): no robot of all has sent a message on its y after 5 s"),
      1u);
  EXPECT_EQ(two.world.report_count(Severity::kWarning, "rule 3"), 0u);
}

TEST(RelayPorts, ACommandThatTheSimulatorReadsItselfIsNoTopicOfARule) {
  RelayWorld two("rules:\n  - {topic: radio/send}\n  - {topic: y}\n");
  std::vector<std::string> heard;
  two.write("a/y", "1");
  two.step(10, "b/from/a/y", &heard);
  EXPECT_EQ(heard, (std::vector<std::string>{"1"}));
  EXPECT_EQ(two.world.report_count(
                Severity::kWarning,
                "rule 1 (radio/send): a/radio/send is a command that the simulator reads itself"),
            1u);
}

TEST(RelayPorts, WhatTheFileCannotSayIsOneError) {
  const auto refusal = [](const std::string& rules) {
    WorldOptions strict;
    strict.odd_elements = OddElements::kRefuse;
    return error_of([&] { RelayWorld(rules, 50.0, {}, strict); });
  };
  EXPECT_TRUE(contains(refusal("radio: {tx_powr: 10}"), "team.yaml: radio: 'tx_powr'"));
  EXPECT_TRUE(contains(refusal("radio: {gain: .nan}"), "gain"));
  EXPECT_TRUE(contains(refusal("model: {path: three_rays}"), "three_rays"));
  EXPECT_TRUE(contains(refusal("model: {pth: two_ray}"), "path"));
  EXPECT_TRUE(contains(refusal("rules: [{topic: x, depht: 3}]"), "depth"));
}

}  // namespace
}  // namespace trident::sim
