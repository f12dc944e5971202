// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr double kGravity = 9.8;

ParamList imu_params(const std::string& ns, const std::string& noise) {
  ParamList params{{"robotNamespace", ns}, {"linkName", "link"}};
  for (const char* key :
       {"gyroscopeNoiseDensity", "gyroscopeRandomWalk", "gyroscopeTurnOnBiasSigma",
        "accelerometerNoiseDensity", "accelerometerRandomWalk", "accelerometerTurnOnBiasSigma"}) {
    params.emplace_back(key, noise);
  }
  return params;
}

ModelSpec body_with_imu(const std::string& name, const SE3& T_world_model,
                        const std::string& noise = "0") {
  ModelSpec model = make_body(name, BoxShape{{0.2, 0.2, 0.2}}, T_world_model);
  model.plugins.push_back(
      make_plugin("imu", "librotors_gazebo_imu_plugin.so", imu_params(name, noise)));
  return model;
}

OutPort<ImuSample>& listen(TestWorld& world, const std::string& name) {
  auto* port = world->ports().find_out<ImuSample>(name + "/imu");
  port->add_listener();
  return *port;
}

TEST(Imu, AtRestOnTheGroundReadsGravityUpwards) {
  TestWorld world;
  world.add(make_ground());
  world.add(body_with_imu("a", at(0, 0, 0.1)));
  auto& imu = listen(world, "a");
  world->step(300);
  EXPECT_TRUE(is_near(imu.value.a_imu, {0, 0, kGravity}, 1e-3));
  EXPECT_TRUE(is_near(imu.value.w_imu, {0, 0, 0}, 1e-4));
  EXPECT_EQ(imu.value.orientation_covariance[0], -1.0);
}

TEST(Imu, AtRestOnItsSideReadsGravityInItsOwnFrame) {
  TestWorld world;
  world.add(make_ground());
  world.add(body_with_imu("a", SE3::from_xyz_rpy({0, 0, 0.1}, std::acos(0.0), 0, 0)));
  auto& imu = listen(world, "a");
  world->step(300);
  EXPECT_TRUE(is_near(imu.value.a_imu, {0, kGravity, 0}, 0.02));
}

TEST(Imu, InFreeFallReadsNothing) {
  TestWorld world;
  world.add(body_with_imu("a", at(0, 0, 10)));
  auto& imu = listen(world, "a");
  world->step(10);
  EXPECT_TRUE(is_near(imu.value.a_imu, {0, 0, 0}, 1e-9));
}

TEST(Imu, OffTheCenterOfASpinningBodyReadsTheCentripetalAcceleration) {
  WorldSpec spec = world_spec(0.001);
  spec.physics.gravity.setZero();
  TestWorld world(spec);
  ModelSpec model = body_with_imu("a", {});
  model.links.push_back(make_link("arm", 1e-9, {1e-9, 1e-9, 1e-9}, at(0.5, 0, 0)));
  model.joints.push_back(
      make_joint("fix", JointType::kFixed, "link", "arm", at(0.5, 0, 0), {0, 0, 1}));
  for (ParamNode& node : model.plugins[0].params.children) {
    if (node.name == "linkName") node.text = "arm";
  }
  Model& body = world.add(std::move(model));
  auto& imu = listen(world, "a");
  world->set_model_twist(body, {0, 0, 0}, {0, 0, 4});
  world->step(50);
  EXPECT_TRUE(is_near(imu.value.a_imu, {-4.0 * 4.0 * 0.5, 0, 0}, 0.02));
  EXPECT_TRUE(is_near(imu.value.w_imu, {0, 0, 4}, 1e-9));
}

TEST(Imu, TeleportingIsNotAnAcceleration) {
  TestWorld world;
  Model& body = world.add(body_with_imu("a", at(0, 0, 10)));
  auto& imu = listen(world, "a");
  world->step(5);
  world->set_model_twist(body, {30, 0, 0}, {0, 0, 0});
  world->step();
  EXPECT_LT(imu.value.a_imu.norm(), kGravity + 1e-9);
}

TEST(Imu, StampIsTheEndOfTheStep) {
  TestWorld world;
  world.add(body_with_imu("a", at(0, 0, 10)));
  auto& imu = listen(world, "a");
  world->step(7);
  EXPECT_EQ(imu.value.stamp, SimTime::from_seconds(0.07));
}

/// Readings of imu `name` for `steps`, heard from step `first` on.
std::vector<Eigen::Vector3d> readings(const std::string& name, std::uint64_t first,
                                      std::uint64_t steps, std::uint64_t seed, int others) {
  WorldOptions options;
  options.seed = seed;
  TestWorld world(world_spec(), options);
  for (int i = 0; i < others; ++i) {
    const std::string other = "other" + std::to_string(i);
    world.add(body_with_imu(other, at(5 + i, 0, 10), "0.1"));
    listen(world, other);
  }
  world.add(body_with_imu(name, at(0, 0, 10), "0.1"));
  std::vector<Eigen::Vector3d> result;
  auto* port = world->ports().find_out<ImuSample>(name + "/imu");
  for (std::uint64_t k = 1; k <= steps; ++k) {
    if (k == first) port->add_listener();
    world->step();
    if (k >= first) result.push_back(port->value.a_imu);
  }
  return result;
}

TEST(Imu, NoiseDoesNotDependOnWhoListensSinceWhen) {
  const auto early = readings("a", 1, 60, 3, 0), late = readings("a", 41, 60, 3, 2);
  ASSERT_EQ(late.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(early[40 + i], late[i]);
}

TEST(Imu, EveryVehicleAndSeedHasItsOwnNoise) {
  const auto a = readings("a", 1, 20, 3, 0), b = readings("b", 1, 20, 3, 0);
  const auto other_seed = readings("a", 1, 20, 4, 0);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_GT((a[i] - b[i]).norm(), 1e-6);
    EXPECT_GT((a[i] - other_seed[i]).norm(), 1e-6);
  }
}

TEST(Imu, WhiteNoiseHasItsDensity) {
  TestWorld world;
  ModelSpec model = body_with_imu("a", at(0, 0, 10));
  for (ParamNode& node : model.plugins[0].params.children) {
    if (node.name == "accelerometerNoiseDensity") node.text = "0.02";
  }
  world.add(std::move(model));
  auto& imu = listen(world, "a");
  double sum = 0.0, squares = 0.0;
  constexpr int kSamples = 3000;
  for (int i = 0; i < kSamples; ++i) {
    world->step();
    sum += imu.value.a_imu.x();
    squares += imu.value.a_imu.x() * imu.value.a_imu.x();
  }
  const double sigma = 0.02 / std::sqrt(0.01);
  EXPECT_NEAR(sum / kSamples, 0.0, 4.0 * sigma / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(squares / kSamples), sigma, 0.05 * sigma);
}

}  // namespace
}  // namespace trident::sim
