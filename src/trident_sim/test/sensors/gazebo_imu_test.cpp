// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// gazebo_ros' IMU plugins.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "sensors/inertial/axis_noise.h"
#include "test_world.h"
#include "trident_sim/commands.h"

namespace trident::sim {
namespace {

constexpr double kGravity = 9.8;

ParamNode noise_node(const std::string& name, const std::string& stddev, const std::string& bias) {
  ParamNode noise{"noise", "", {{"type", "gaussian"}}, {}};
  noise.children.push_back({"stddev", stddev, {}, {}});
  noise.children.push_back({"bias_mean", bias, {}, {}});
  ParamNode result{name, "", {}, {}};
  for (const char* axis : {"x", "y", "z"}) result.children.push_back({axis, "", {}, {noise}});
  return result;
}

/// A cube with an IMU sensor 0.1 m ahead of its origin.
ModelSpec body_with_sensor(const ParamList& params, double rate_hz = 0.0,
                           const ParamNode& element = {"imu", "", {}, {}}) {
  ModelSpec model = make_body("a", BoxShape{{0.2, 0.2, 0.2}}, at(0, 0, 0.1));
  SensorSpec sensor;
  sensor.name = "imu";
  sensor.type = "imu";
  sensor.update_rate_hz = rate_hz;
  sensor.params = {"sensor", "", {}, {element}};
  ParamList all = params;
  all.insert(all.begin(), {{"robotNamespace", "a"}, {"frameName", "imu_link"}});
  sensor.plugins.push_back(make_plugin("p", "libgazebo_ros_imu_sensor.so", all));
  model.links[0].sensors.push_back(sensor);
  return model;
}

OutPort<ImuSample>& listen(TestWorld& world, const std::string& name) {
  auto* port = world->ports().find_out<ImuSample>(name);
  port->add_listener();
  return *port;
}

TEST(GazeboImu, AtRestReadsGravityUpwards) {
  TestWorld world;
  world.add(make_ground());
  world.add(body_with_sensor({{"updateRateHZ", "0"}}));
  auto& imu = listen(world, "a/imu_data");
  world->step(300);
  EXPECT_TRUE(is_near(imu.value.a_imu, {0, 0, kGravity}, 1e-3));
  EXPECT_TRUE(is_near(imu.value.w_imu, {0, 0, 0}, 1e-4));
  EXPECT_EQ(imu.value.frame, "imu_link");
  EXPECT_EQ(imu.value.stamp, world->time());
}

TEST(GazeboImu, OffTheAxisOfATurnReadsTheCentripetalAcceleration) {
  TestWorld world(weightless());
  Model& body = world.add(body_with_sensor({{"updateRateHZ", "0"}, {"xyzOffset", "0.5 0 0"}}));
  auto& imu = listen(world, "a/imu_data");
  world->set_model_twist(body, {0, 0, 0}, {0, 0, 3});
  world->step(10);
  EXPECT_TRUE(is_near(imu.value.w_imu, {0, 0, 3}, 1e-6));
  EXPECT_TRUE(is_near(imu.value.a_imu, {-4.5, 0, 0}, 0.02));
}

TEST(GazeboImu, TurnsWithItsOffset) {
  TestWorld world;
  world.add(make_ground());
  world.add(body_with_sensor({{"updateRateHZ", "0"}, {"rpyOffset", "1.5707963267948966 0 0"}}));
  auto& imu = listen(world, "a/imu_data");
  world->step(300);
  EXPECT_TRUE(is_near(imu.value.a_imu, {0, kGravity, 0}, 1e-3));
}

TEST(GazeboImu, KeepsItsRate) {
  TestWorld world;
  world.add(body_with_sensor({{"updateRateHZ", "20"}}));
  auto& imu = listen(world, "a/imu_data");
  world->step(100);
  EXPECT_EQ(imu.count(), 20u);
}

TEST(GazeboImu, WithoutListenersNothingIsMeasured) {
  TestWorld world;
  world.add(body_with_sensor({{"updateRateHZ", "0"}}));
  world->step(10);
  EXPECT_EQ(world->ports().find_out<ImuSample>("a/imu_data")->count(), 0u);
}

TEST(GazeboImu, OrientationCanBeAgainstTheStart) {
  for (const bool is_against_start : {false, true}) {
    TestWorld world(weightless());
    ModelSpec model =
        body_with_sensor({{"updateRateHZ", "0"},
                          {"initialOrientationAsReference", is_against_start ? "true" : "false"}});
    model.T_world_model = SE3::from_xyz_rpy({0, 0, 1}, 0, 0, 0.7);
    world.add(std::move(model));
    auto& imu = listen(world, "a/imu_data");
    world->step(1);
    const double yaw = 2.0 * std::atan2(imu.value.R_world_imu.z(), imu.value.R_world_imu.w());
    EXPECT_NEAR(yaw, is_against_start ? 0.0 : 0.7, 1e-9);
  }
}

TEST(GazeboImu, NoiseHasTheStatisticsOfTheFile) {
  TestWorld world(weightless());
  const ParamNode element{"imu",
                          "",
                          {},
                          {noise_node("angular_velocity", "0.01", "0"),
                           noise_node("linear_acceleration", "0.2", "0.5")}};
  world.add(body_with_sensor({{"updateRateHZ", "0"}}, 0.0, element));
  auto& imu = listen(world, "a/imu_data");
  constexpr int kSamples = 20000;
  double rate = 0.0, rate_squares = 0.0, force = 0.0, force_squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    world->step(1);
    rate += imu.value.w_imu.x();
    rate_squares += imu.value.w_imu.x() * imu.value.w_imu.x();
    force += imu.value.a_imu.z();
    force_squares += imu.value.a_imu.z() * imu.value.a_imu.z();
  }
  const double mean = force / kSamples;
  EXPECT_NEAR(rate / kSamples, 0.0, 4 * 0.01 / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(rate_squares / kSamples), 0.01, 0.01 * 4 / std::sqrt(2.0 * kSamples));
  EXPECT_NEAR(std::abs(mean), 0.5, 4 * 0.2 / std::sqrt(kSamples)) << "a bias of either sign";
  EXPECT_NEAR(std::sqrt(force_squares / kSamples - mean * mean), 0.2, 0.01);
  EXPECT_DOUBLE_EQ(imu.value.accel_covariance[0], 0.2 * 0.2);
}

TEST(GazeboImu, AWanderingBiasKeepsItsSpread) {
  AxisNoise noise;
  noise.dynamic_bias_stddev = 0.3;
  noise.dynamic_bias_correlation_time_s = 2.0;
  AxisNoiseSource source(noise, 0.1, 0);
  const RandomStream stream(3, "imu");
  constexpr int kSamples = 200000;
  double squares = 0.0, products = 0.0, last = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double value = source.sample(stream, static_cast<std::uint64_t>(i));
    squares += value * value;
    products += value * last;
    last = value;
  }
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.3, 0.02);
  EXPECT_NEAR(products / squares, std::exp(-0.1 / 2.0), 0.005);
}

TEST(GazeboImu, TheModelsPluginMeasuresABodyByName) {
  TestWorld world;
  world.add(make_ground());
  ModelSpec model = make_body("a", BoxShape{{0.2, 0.2, 0.2}}, at(0, 0, 0.1));
  model.plugins.push_back(make_plugin("imu", "libgazebo_ros_imu.so",
                                      {{"robotNamespace", "a"},
                                       {"bodyName", "link"},
                                       {"topicName", "imu"},
                                       {"updateRate", "50"},
                                       {"gaussianNoise", "0"}}));
  world.add(std::move(model));
  auto& imu = listen(world, "a/imu");
  world->step(300);
  EXPECT_EQ(imu.count(), 150u);
  EXPECT_TRUE(is_near(imu.value.a_imu, {0, 0, kGravity}, 1e-3));
  EXPECT_EQ(imu.value.frame, "link");
}

/// Mean of the rates over many samples.
Eigen::Vector3d mean_rate(TestWorld& world, const OutPort<ImuSample>& imu, int samples) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < samples; ++i) {
    world->step(1);
    sum += imu.value.w_imu;
  }
  return sum / samples;
}

TEST(GazeboImu, ACalibrationTakesTheGyroscopesBiasOut) {
  for (const char* service : {"a/imu_data/calibrate", "a/imu_service"}) {
    TestWorld world(weightless());
    const ParamNode element{"imu",
                            "",
                            {},
                            {noise_node("angular_velocity", "0.01", "0.3"),
                             noise_node("linear_acceleration", "0", "0.5")}};
    Model& body = world.add(
        body_with_sensor({{"updateRateHZ", "0"}, {"serviceName", "imu_service"}}, 0.0, element));
    auto& imu = listen(world, "a/imu_data");
    world->set_model_twist(body, {0, 0, 0}, {0, 0, 0.2});
    EXPECT_NEAR(std::abs(mean_rate(world, imu, 400).x()), 0.3, 0.003);
    auto* const calibrate = world->ports().find_in<ServiceCommand>(service);
    ASSERT_NE(calibrate, nullptr) << service;
    calibrate->write({});
    EXPECT_TRUE(is_near(mean_rate(world, imu, 400), {0, 0, 0.2}, 0.003)) << "the motion stays";
    EXPECT_NEAR(std::abs(imu.value.a_imu.x()), 0.5, 1e-6) << "the force's bias, too";
    world->reset_models();
    world->step(1);
    EXPECT_NEAR(std::abs(imu.value.w_imu.x()), 0.3, 0.05) << "as it was at the start";
  }
}

ModelSpec body_with_hector_imu(ParamList params) {
  ModelSpec model = make_body("a", BoxShape{{0.2, 0.2, 0.2}}, {});
  params.insert(params.begin(), {{"robotNamespace", "a"}, {"frameId", "imu_frame"}});
  model.plugins.push_back(make_plugin("imu", "libhector_gazebo_ros_imu.so", params));
  return model;
}

TEST(HectorImu, HasUpstreamsNamesAndErrors) {
  TestWorld world(weightless());
  world.add(body_with_hector_imu({{"topicName", "raw_imu"},
                                  {"updateRate", "100"},
                                  {"rateOffset", "0.1 0.2 0.3"},
                                  {"accelOffset", "1"},
                                  {"accelGaussianNoise", "0.35 0.35 0.3"},
                                  {"headingOffset", "0.4"}}));
  auto& imu = listen(world, "a/raw_imu");
  world->step(10);
  EXPECT_TRUE(is_near(mean_rate(world, imu, 990), {0.1, 0.2, 0.3}, 1e-9));
  EXPECT_EQ(imu.count(), 100u);
  EXPECT_EQ(imu.value.frame, "imu_frame");
  EXPECT_DOUBLE_EQ(imu.value.accel_covariance[0], 0.35 * 0.35);
  EXPECT_NEAR(2.0 * std::atan2(imu.value.R_world_imu.z(), imu.value.R_world_imu.w()), 0.4, 1e-9);
  EXPECT_NE(world->ports().find_in<ServiceCommand>("a/raw_imu/calibrate"), nullptr);
}

TEST(HectorImu, AMountingIsAnErrorOfForceAndHeading) {
  TestWorld world(weightless());
  world.add(body_with_hector_imu({{"rpyOffset", "0.01 0.02 0.03"}}));
  auto& imu = listen(world, "a/imu");
  world->step(1);
  EXPECT_TRUE(is_near(imu.value.a_imu, {0.02 * 9.8065, -0.01 * 9.8065, 0}, 1e-9));
  EXPECT_NEAR(2.0 * imu.value.R_world_imu.z(), 0.03, 1e-5);
}

TEST(HectorImu, ADriftHasItsSpread) {
  const ParamNode node{
      "plugin",
      "",
      {},
      {{"rateDrift", "0.02", {}, {}}, {"rateDriftFrequency", "0.5 0.5 0.5", {}, {}}}};
  const auto noises = read_hector_noises(PluginParams(node, "test"), "rate");
  AxisNoiseSource source(noises[1], 0.1, 0);
  const RandomStream stream(3, "imu");
  constexpr int kSamples = 100000;
  double squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    squares += std::pow(source.sample(stream, static_cast<std::uint64_t>(i)), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.02, 0.0015);
  const ParamNode bad{"plugin", "", {}, {{"rateDrift", "0.1 -1 0", {}, {}}}};
  EXPECT_TRUE(contains(error_of([&] { read_hector_noises(PluginParams(bad, "test"), "rate"); }),
                       "<rateDrift> is '0.1 -1 0', expected numbers in [0, 1e9]"));
}

TEST(GazeboImu, BadParametersAreRefused) {
  TestWorld world;
  const auto refusal = [&](const ParamList& params, const ParamNode& element) {
    return error_of([&] { world.add(body_with_sensor(params, 0.0, element)); });
  };
  const ParamNode plain{"imu", "", {}, {}};
  EXPECT_TRUE(contains(refusal({{"gaussianNoise", "-1"}}, plain), "<gaussianNoise> is '-1'"));
  EXPECT_TRUE(contains(refusal({{"xyzOffset", "1 2"}}, plain), "three finite numbers"));
  EXPECT_TRUE(contains(refusal({}, {"imu", "", {}, {noise_node("angular_velocity", "-0.1", "0")}}),
                       "<angular_velocity> <x> <noise>: <stddev> is '-0.1'"));
  ModelSpec lost = make_body("b", BoxShape{{0.2, 0.2, 0.2}}, at(0, 0, 1));
  lost.plugins.push_back(make_plugin("p", "libgazebo_ros_imu_sensor.so", {{"frameName", "f"}}));
  EXPECT_TRUE(contains(error_of([&] { world.add(std::move(lost)); }), "belongs in a <sensor>"));
}

}  // namespace
}  // namespace trident::sim
