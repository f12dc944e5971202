// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What the parameters of both IMUs' noise mean, read off what they publish: densities, the slopes
// of the Allan deviation, and biases of turning on.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "models.h"
#include "sample_statistics.h"
#include "sensors/inertial/axis_noise.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr double kPeriod = 0.01;  ///< [s]
constexpr std::size_t kSamples = 200'000;

/// White noise and random walk of one quantity. They are equal at sqrt(3) density / walk.
struct Densities {
  double white, walk;
};
constexpr Densities kGyro{2e-3, 2e-3};   ///< [rad/s/sqrt(Hz)], [rad/s^2/sqrt(Hz)]
constexpr Densities kAccel{0.03, 0.05};  ///< [m/s^2/sqrt(Hz)], [m/s^3/sqrt(Hz)]

std::string text_of(double value) { return std::to_string(value); }

/// RotorS' IMU; the biases' correlation time is so long that they walk at random.
PluginSpec rotors_imu() {
  return make_plugin("rotors", "librotors_gazebo_imu_plugin.so",
                     {{"robotNamespace", "rotors"},
                      {"linkName", "link"},
                      {"gyroscopeNoiseDensity", text_of(kGyro.white)},
                      {"gyroscopeRandomWalk", text_of(kGyro.walk)},
                      {"gyroscopeBiasCorrelationTime", "1e5"},
                      {"gyroscopeTurnOnBiasSigma", "0"},
                      {"accelerometerNoiseDensity", text_of(kAccel.white)},
                      {"accelerometerRandomWalk", text_of(kAccel.walk)},
                      {"accelerometerBiasCorrelationTime", "1e5"},
                      {"accelerometerTurnOnBiasSigma", "0"}});
}

/// The same densities as SDF expresses them: white noise by the spread of one sample, a bias by its
/// spread in the long run and its correlation time.
ParamNode sdf_noise(const std::string& name, const Densities& densities) {
  constexpr double kCorrelationTime = 1e4;
  const double spread = densities.walk * std::sqrt(kCorrelationTime / 2.0);
  ParamNode noise{"noise", "", {{"type", "gaussian"}}, {}};
  noise.children = {{"stddev", text_of(densities.white / std::sqrt(kPeriod)), {}, {}},
                    {"dynamic_bias_stddev", text_of(spread), {}, {}},
                    {"dynamic_bias_correlation_time", text_of(kCorrelationTime), {}, {}}};
  ParamNode result{name, "", {}, {}};
  for (const char* axis : {"x", "y", "z"}) result.children.push_back({axis, "", {}, {noise}});
  return result;
}

SensorSpec gazebo_imu() {
  SensorSpec sensor;
  sensor.name = "imu";
  sensor.type = "imu";
  sensor.params = {
      "sensor",
      "",
      {},
      {{"imu",
        "",
        {},
        {sdf_noise("angular_velocity", kGyro), sdf_noise("linear_acceleration", kAccel)}}}};
  sensor.plugins.push_back(make_plugin("p", "libgazebo_ros_imu_sensor.so",
                                       {{"robotNamespace", "gazebo"},
                                        {"topicName", "imu"},
                                        {"frameName", "link"},
                                        {"updateRateHZ", "0"}}));
  return sensor;
}

/// Rates of axes x, y, z, then forces; of a body at rest in nothing.
using Record = std::array<std::vector<double>, 6>;

Record record_of(const std::string& imu) {
  TestWorld world(weightless(kPeriod));
  ModelSpec model = make_body("a", SphereShape{0.1}, {});
  model.plugins.push_back(rotors_imu());
  model.links[0].sensors.push_back(gazebo_imu());
  world.add(std::move(model));
  auto* const port = world->ports().find_out<ImuSample>(imu + "/imu");
  port->add_listener();
  Record record;
  for (std::size_t i = 0; i < kSamples; ++i) {
    world->step();
    for (int axis = 0; axis < 3; ++axis) {
      record[static_cast<std::size_t>(axis)].push_back(port->value.w_imu[axis]);
      record[static_cast<std::size_t>(axis) + 3].push_back(port->value.a_imu[axis]);
    }
  }
  return record;
}

/// Of the three axes from `first` on together, at averaging times [s].
std::vector<double> allan_deviations(const Record& record, std::size_t first,
                                     const std::vector<double>& times_s) {
  std::vector<double> deviations;
  for (const double time_s : times_s) {
    const auto m = static_cast<std::size_t>(std::lround(time_s / kPeriod));
    double variance = 0.0;
    for (std::size_t axis = first; axis < first + 3; ++axis) {
      variance += allan_variance(record[axis], m) / 3.0;
    }
    deviations.push_back(std::sqrt(variance));
  }
  return deviations;
}

void check_allan_deviation(const Record& record, std::size_t first, const Densities& densities) {
  // White noise: N / sqrt(tau). Random walk: K sqrt(tau / 3). They cross at about two seconds.
  const std::vector<double> shortly{0.01, 0.02, 0.04, 0.08}, long_after{20, 30, 40, 60, 80};
  const std::vector<double> white = allan_deviations(record, first, shortly);
  const std::vector<double> walk = allan_deviations(record, first, long_after);
  EXPECT_NEAR(log_slope(shortly, white), -0.5, 0.02);
  EXPECT_NEAR(log_slope(long_after, walk), 0.5, 0.15);
  EXPECT_NEAR(white[0], densities.white / std::sqrt(shortly[0]), 0.02 * white[0]);
  EXPECT_NEAR(walk[0], densities.walk * std::sqrt(long_after[0] / 3.0), 0.15 * walk[0]);
}

TEST(ImuStatistics, AllanDeviationHasTheSlopesOfWhiteNoiseAndRandomWalk) {
  for (const char* imu : {"rotors", "gazebo"}) {
    SCOPED_TRACE(imu);
    const Record record = record_of(imu);
    check_allan_deviation(record, 0, kGyro);
    check_allan_deviation(record, 3, kAccel);
  }
}

TEST(ImuStatistics, WithoutRandomWalkTheMeanIsThatOfTheMotion) {
  TestWorld world(weightless(kPeriod));
  ModelSpec model = make_body("a", SphereShape{0.1}, {});
  PluginSpec plugin = rotors_imu();
  for (ParamNode& node : plugin.params.children) {
    if (node.name.find("RandomWalk") != std::string::npos) node.text = "0";
  }
  model.plugins.push_back(plugin);
  Model& body = world.add(std::move(model));
  auto* const port = world->ports().find_out<ImuSample>("rotors/imu");
  port->add_listener();
  world->set_model_twist(body, {0, 0, 0}, {0, 0, 0.7});
  std::vector<double> rates;
  for (int i = 0; i < 20'000; ++i) {
    world->step();
    rates.push_back(port->value.w_imu.z());
  }
  const SampleStatistics seen = statistics_of(rates);
  const double sigma = kGyro.white / std::sqrt(kPeriod);
  EXPECT_NEAR(seen.mean, 0.7, 4.0 * sigma / std::sqrt(20'000.0));
  EXPECT_NEAR(seen.stddev, sigma, 4.0 * sigma / std::sqrt(2.0 * 20'000.0));
}

TEST(ImuStatistics, SdfsBiasOfTurningOnIsOfEitherSignAndConstantInARun) {
  AxisNoise noise;
  noise.bias_mean = 0.5;
  noise.bias_stddev = 0.05;
  constexpr int kRuns = 4000;
  std::vector<double> sizes;
  int negative = 0;
  for (int run = 0; run < kRuns; ++run) {
    const RandomStream stream(7, "run " + std::to_string(run));
    AxisNoiseSource source(noise, kPeriod, 0);
    const double bias = source.sample(stream, 1);
    EXPECT_EQ(source.sample(stream, 1000), bias);
    negative += bias < 0.0 ? 1 : 0;
    sizes.push_back(std::abs(bias));
  }
  const SampleStatistics seen = statistics_of(sizes);
  EXPECT_NEAR(seen.mean, 0.5, 4.0 * 0.05 / std::sqrt(kRuns));
  EXPECT_NEAR(seen.stddev, 0.05, 4.0 * 0.05 / std::sqrt(2.0 * kRuns));
  EXPECT_NEAR(negative, kRuns / 2, 4.0 * std::sqrt(kRuns / 4.0));
}

TEST(ImuStatistics, RotorsBiasOfTurningOnIsSpreadOverVehicles) {
  constexpr int kVehicles = 300;
  TestWorld world(weightless(kPeriod));
  std::vector<OutPort<ImuSample>*> ports;
  for (int i = 0; i < kVehicles; ++i) {
    const std::string name = "v" + std::to_string(i);
    ModelSpec model = make_body(name, SphereShape{0.1}, at(i, 0, 0));
    ParamList params{{"robotNamespace", name}, {"linkName", "link"}};
    for (const char* key : {"gyroscopeNoiseDensity", "gyroscopeRandomWalk",
                            "accelerometerNoiseDensity", "accelerometerRandomWalk"}) {
      params.emplace_back(key, "0");
    }
    params.emplace_back("gyroscopeTurnOnBiasSigma", "0.01");
    params.emplace_back("accelerometerTurnOnBiasSigma", "0.2");
    model.plugins.push_back(make_plugin("imu", "librotors_gazebo_imu_plugin.so", params));
    world.add(std::move(model));
    ports.push_back(world->ports().find_out<ImuSample>(name + "/imu"));
    ports.back()->add_listener();
  }
  world->step();
  std::vector<double> rates, forces;
  for (const OutPort<ImuSample>* port : ports) {
    for (int axis = 0; axis < 3; ++axis) {
      rates.push_back(port->value.w_imu[axis]);
      forces.push_back(port->value.a_imu[axis]);
    }
  }
  const double n = 3.0 * kVehicles;
  for (const auto& [biases, sigma] : {std::pair(rates, 0.01), std::pair(forces, 0.2)}) {
    const SampleStatistics seen = statistics_of(biases);
    EXPECT_NEAR(seen.mean, 0.0, 4.0 * sigma / std::sqrt(n));
    EXPECT_NEAR(seen.stddev, sigma, 4.0 * sigma / std::sqrt(2.0 * n));
  }
}

}  // namespace
}  // namespace trident::sim
