// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "quad_world.h"

namespace trident::sim {
namespace {

TEST(PortBoard, OutputsAreUniqueByName) {
  PortBoard board;
  auto* port = board.advertise<ScalarSample>("a/speed", PortRank::kState);
  EXPECT_TRUE(contains(
      error_of([&] { board.advertise<ScalarSample>("a/speed", PortRank::kState); }), "a/speed"));
  board.release(port);
  EXPECT_NO_THROW(board.advertise<WindSample>("a/speed", PortRank::kState));
}

TEST(PortBoard, ReadersOfOneInputShareIt) {
  PortBoard board;
  auto* first = board.subscribe<ScalarSample>("in");
  auto* second = board.subscribe<ScalarSample>("in");
  EXPECT_EQ(first, second);
  board.release(first);
  EXPECT_EQ(board.find_in<ScalarSample>("in"), second);
  board.release(second);
  EXPECT_EQ(board.find("in", PortDirection::kIn), nullptr);
}

TEST(PortBoard, AnInputHasOneType) {
  PortBoard board;
  board.subscribe<ScalarSample>("in");
  EXPECT_TRUE(
      contains(error_of([&] { board.subscribe<WindSample>("in"); }), "two different types"));
  EXPECT_EQ(board.find_in<WindSample>("in"), nullptr);
}

TEST(PortBoard, VersionCountsEveryChange) {
  PortBoard board;
  const auto start = board.version();
  auto* port = board.advertise<ScalarSample>("out", PortRank::kState);
  const auto added = board.version();
  EXPECT_NE(added, start);
  board.release(port);
  EXPECT_NE(board.version(), added);
}

TEST(PortBoard, IsVisitedInNameOrder) {
  PortBoard board;
  for (const char* name : {"c", "a", "b"}) board.advertise<ScalarSample>(name, PortRank::kState);
  std::string order;
  board.for_each([&](const PortBase& port) { order += port.name(); });
  EXPECT_EQ(order, "abc");
}

TEST(InPort, KeepsTheLastValues) {
  InPort<int> port("in");
  for (int i = 0; i < 20; ++i) port.write(i);
  EXPECT_EQ(port.count(), 20u);
  EXPECT_EQ(port.oldest(), 20u - InPort<int>::kDepth);
  for (std::uint64_t i = port.oldest(); i < port.count(); ++i) {
    EXPECT_EQ(port.at(i), static_cast<int>(i));
  }
}

TEST(Ports, TwoPluginsOfOneTopicRefuseTheModelAndLeaveNoTrace) {
  TestWorld world;
  ModelSpec quad = make_quad();
  quad.plugins.push_back(quad.plugins.back());
  std::size_t before = 0, after = 0;
  world->ports().for_each([&](const PortBase&) { ++before; });
  EXPECT_TRUE(contains(error_of([&] { world.add(quad); }), "model 'quad' plugin"));
  world->ports().for_each([&](const PortBase&) { ++after; });
  EXPECT_EQ(before, after);
  EXPECT_EQ(world->find_model("quad"), nullptr);
  quad.plugins.pop_back();
  EXPECT_NO_THROW(world.add(quad));
}

TEST(Ports, WhatNobodyWantsIsNotComputed) {
  QuadWorld quad;
  quad->step(3);
  quad->ports().for_each([](const PortBase& port) {
    if (port.direction() == PortDirection::kOut) {
      EXPECT_EQ(port.count(), 0u) << port.name();
    }
  });
}

TEST(MultirotorBase, ShowsSignedSpeedsAndJointAngles) {
  QuadWorld quad;
  auto* speeds = quad->ports().find_out<ActuatorState>("quad/motor_speed");
  auto* joints = quad->ports().find_out<JointStateSample>("quad/joint_states");
  speeds->add_listener();
  joints->add_listener();
  quad.settle({400, 400, 400, 400});
  quad->step(2);
  ASSERT_EQ(speeds->value.angular_velocities.size, 4u);
  EXPECT_NEAR(speeds->value.angular_velocities.data[0], -400.0, 1e-3);
  EXPECT_NEAR(speeds->value.angular_velocities.data[1], 400.0, 1e-3);
  EXPECT_EQ(joints->value.names[2], "rotor_2_joint");
  const double before = joints->value.positions[1];
  quad->step();
  EXPECT_NEAR(joints->value.positions[1] - before, 400.0 / quad.options.slowdown * 0.01, 1e-6);
}

}  // namespace
}  // namespace trident::sim
