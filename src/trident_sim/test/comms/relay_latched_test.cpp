// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "relay_world.h"

namespace trident::sim {
namespace {

constexpr const char* kMapRules = R"(
model: {path: free_space}
rules:
  - {topic: map, reliability: reliable, depth: 10, deadline: 1.0}
  - {topic: name}
)";

TEST(RelayPorts, ARobotThatComesLateHasTheNewestOfLatchedTopics) {
  RelayWorld two(kMapRules);
  std::vector<std::string> maps, names;
  for (const char* topic : {"a/map", "a/name"}) {
    two.latch(topic, "old");
    two.latch(topic, "new");
  }
  two.step(300, "b/from/a/map", &maps);
  EXPECT_EQ(maps, (std::vector<std::string>{"old", "new"}));
  two.add("c", 20.0);
  two.step(100, "c/from/a/map", &maps);
  two.add("d", 30.0);
  two.step(100, "d/from/a/name", &names);
  EXPECT_EQ(maps, (std::vector<std::string>{"old", "new", "new"}));
  EXPECT_EQ(names, (std::vector<std::string>{"new"}));
  const auto* const other = two.world->ports().find_out<BytesSample>("b/from/a/map");
  EXPECT_EQ(*other->value.data, "new");
  EXPECT_EQ(other->count(), 1u) << "one that has it does not get it again";
}

TEST(RelayPorts, WhatIsNotLatchedIsNotForLatecomers) {
  RelayWorld two(kMapRules);
  two.write("a/map", "map");
  two.world->step(10);
  two.add("c", 20.0);
  std::vector<std::string> maps;
  two.step(100, "c/from/a/map", &maps);
  EXPECT_TRUE(maps.empty());
}

TEST(RelayPorts, AfterAResetLatchedTopicsAreSentAgain) {
  RelayWorld two(kMapRules);
  two.latch("a/map", "map");
  two.world->step(10);
  two.world->reset();
  std::vector<std::string> maps;
  two.step(100, "b/from/a/map", &maps);
  EXPECT_EQ(maps, (std::vector<std::string>{"map"}));
}

TEST(RelayPorts, OfARobotThatHasGoneNothingLatchedIsKept) {
  RelayWorld two(kMapRules);
  two.latch("a/map", "map");
  two.world->step(10);
  two.world->remove("a");
  two.add("a", 0.0);
  two.add("c", 20.0);
  std::vector<std::string> maps;
  two.step(100, "c/from/a/map", &maps);
  EXPECT_TRUE(maps.empty());
}

}  // namespace
}  // namespace trident::sim
