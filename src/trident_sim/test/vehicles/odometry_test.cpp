// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

ModelSpec body_with_odometry(const ParamList& extra, const SE3& T_world_model = at(0, 0, 10)) {
  ModelSpec model = make_body("a", SphereShape{0.1}, T_world_model);
  ParamList params{{"robotNamespace", "a"}, {"linkName", "link"}, {"childFrameId", "a/link"}};
  params.insert(params.end(), extra.begin(), extra.end());
  model.plugins.push_back(make_plugin("odometry", "librotors_gazebo_odometry_plugin.so", params));
  return model;
}

OutPort<OdometrySample>& listen(TestWorld& world) {
  auto* port = world->ports().find_out<OdometrySample>("a/odometry");
  port->add_listener();
  return *port;
}

/// Steps and returns the numbers of the steps in which something was sent.
std::vector<std::uint64_t> sent_in(TestWorld& world, OutPort<OdometrySample>& port, int steps) {
  std::vector<std::uint64_t> sent;
  for (int i = 0; i < steps; ++i) {
    const auto before = port.count();
    world->step();
    if (port.count() != before) sent.push_back(world->step_count());
  }
  return sent;
}

TEST(Odometry, TwistIsInTheBodyFrame) {
  TestWorld world;
  Model& body =
      world.add(body_with_odometry({}, SE3::from_xyz_rpy({0, 0, 10}, 0, 0, std::acos(0.0))));
  auto& odometry = listen(world);
  world->set_model_twist(body, {3, 0, 0}, {0.5, 0, 0});
  world->step();
  EXPECT_TRUE(is_near(odometry.value.v_child, {0, -3, 0}, 1e-9));
  EXPECT_TRUE(is_near(odometry.value.w_child, {0, -0.5, 0}, 1e-9));
  EXPECT_EQ(odometry.value.parent_frame, "world");
  EXPECT_EQ(odometry.value.child_frame, "a/link");
}

TEST(Odometry, PositionIsThatOfTheCenterOfMassAndVelocityThatOfTheLink) {
  TestWorld world;
  ModelSpec spec = body_with_odometry({});
  spec.links[0].inertial.T_link_com.p = {0.1, 0, 0};
  Model& body = world.add(std::move(spec));
  auto& odometry = listen(world);
  world->set_model_twist(body, {1, 0, 0}, {0, 0, 2});
  world->step();
  EXPECT_TRUE(is_near(odometry.value.T_parent_child.p, {0.1, 0, 10}, 1e-9));
  EXPECT_TRUE(is_near(odometry.value.v_child, {1, 0, 0}, 1e-9));
}

TEST(Odometry, AllTopicsShowTheSamePose) {
  TestWorld world;
  world.add(body_with_odometry({}, SE3::from_xyz_rpy({1, 2, 10}, 0.1, 0.2, 0.3)));
  PortBoard& ports = world->ports();
  for (const char* name : {"a/odometry", "a/pose", "a/pose_with_covariance", "a/position",
                           "a/transform", "tf/a/link"}) {
    ASSERT_NE(ports.find(name, PortDirection::kOut), nullptr) << name;
    ports.find(name, PortDirection::kOut)->add_listener();
  }
  world->step(3);
  const SE3 T = ports.find_out<OdometrySample>("a/odometry")->value.T_parent_child;
  EXPECT_TRUE(is_near(ports.find_out<PoseSample>("a/pose")->value.T_frame_body, T, 0.0));
  EXPECT_TRUE(
      is_near(ports.find_out<TransformSample>("a/transform")->value.T_parent_child, T, 0.0));
  EXPECT_TRUE(is_near(ports.find_out<FrameSample>("tf/a/link")->value.T_parent_child, T, 0.0));
  EXPECT_EQ(ports.find_out<PointSample>("a/position")->value.p_frame, T.p);
  EXPECT_EQ(ports.find("a/pose_with_covariance", PortDirection::kOut)->count(), 3u);
}

TEST(Odometry, NothingIsMadeForNobody) {
  TestWorld world;
  world.add(body_with_odometry({}));
  world->step(5);
  EXPECT_EQ(world->ports().find_out<OdometrySample>("a/odometry")->count(), 0u);
}

TEST(Odometry, DivisorThinsOut) {
  TestWorld world;
  world.add(body_with_odometry({{"measurementDivisor", "4"}}));
  EXPECT_EQ(sent_in(world, listen(world), 12), (std::vector<std::uint64_t>{4, 8, 12}));
}

TEST(Odometry, DelayHoldsBackWhatWasMeasured) {
  TestWorld world;
  world.add(body_with_odometry({{"measurementDelay", "3"}}));
  auto& odometry = listen(world);
  EXPECT_EQ(sent_in(world, odometry, 5), (std::vector<std::uint64_t>{4, 5}));
  EXPECT_EQ(odometry.value.stamp, SimTime::from_seconds(0.02));
}

TEST(Odometry, DelayCountsStepsWhateverTheDivisor) {
  TestWorld world;
  world.add(body_with_odometry({{"measurementDelay", "3"}, {"measurementDivisor", "2"}}));
  EXPECT_EQ(sent_in(world, listen(world), 10), (std::vector<std::uint64_t>{5, 7, 9}));
}

TEST(Odometry, ANewListenerGetsNothingOld) {
  TestWorld world;
  world.add(body_with_odometry({{"measurementDelay", "3"}}));
  auto& odometry = listen(world);
  world->step(10);
  odometry.remove_listener();
  world->step(100);
  odometry.add_listener();
  EXPECT_EQ(sent_in(world, odometry, 5), (std::vector<std::uint64_t>{114, 115}));
}

TEST(Odometry, UnknownDelayShiftsTheStamp) {
  TestWorld world;
  world.add(body_with_odometry({{"unknownDelay", "0.25"}}));
  auto& odometry = listen(world);
  world->step();
  EXPECT_EQ(odometry.value.stamp, SimTime::from_seconds(0.26));
}

TEST(Odometry, NormalNoiseHasItsSpreadAndIsInTheCovariance) {
  TestWorld world;
  ModelSpec spec = body_with_odometry(
      {{"noiseNormalPosition", "0.1 0.2 0"}, {"noiseUniformLinearVelocity", "0 0 0.5"}});
  spec.links[0].gravity = false;
  world.add(std::move(spec));
  auto& odometry = listen(world);
  constexpr int kSamples = 3000;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  double largest = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    world->step();
    squares += (odometry.value.T_parent_child.p - Eigen::Vector3d(0, 0, 10)).cwiseAbs2();
    largest = std::max(largest, std::abs(odometry.value.v_child.z()));
  }
  EXPECT_NEAR(std::sqrt(squares.x() / kSamples), 0.1, 0.005);
  EXPECT_NEAR(std::sqrt(squares.y() / kSamples), 0.2, 0.01);
  EXPECT_EQ(squares.z(), 0.0);
  EXPECT_GT(largest, 0.45);
  EXPECT_LE(largest, 0.5);
  EXPECT_DOUBLE_EQ(odometry.value.pose_covariance[0], 0.01);
  EXPECT_DOUBLE_EQ(odometry.value.pose_covariance[7], 0.04);
}

}  // namespace
}  // namespace trident::sim
