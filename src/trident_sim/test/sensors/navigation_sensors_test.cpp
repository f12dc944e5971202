// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// RotorS' receiver, magnetometer and barometer.
#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "models.h"
#include "sample_statistics.h"
#include "sensors/air/air_pressure.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;

WorldSpec zurich() {
  WorldSpec spec = weightless(0.01);
  spec.spherical = {47.3667, 8.55, 500.0, 0.0};
  return spec;
}

ModelSpec body_with(const std::string& file, ParamList params, const SE3& T_world_model) {
  ModelSpec model = make_body("a", SphereShape{0.1}, T_world_model);
  params.insert(params.begin(), {{"robotNamespace", "a"}, {"linkName", "link"}});
  model.plugins.push_back(make_plugin("p", file, params));
  return model;
}

template <class Sample>
OutPort<Sample>& listen(TestWorld& world, const std::string& name) {
  auto* port = world->ports().find_out<Sample>(name);
  port->add_listener();
  return *port;
}

const ParamList kExact{
    {"horPosStdDev", "0"}, {"verPosStdDev", "0"}, {"horVelStdDev", "0"}, {"verVelStdDev", "0"}};
const char kGps[] = "librotors_gazebo_gps_plugin.so";
const char kMagnetometer[] = "librotors_gazebo_magnetometer_plugin.so";
const char kBarometer[] = "librotors_gazebo_pressure_plugin.so";

TEST(Gps, MetersAreMetersOnTheEllipsoid) {
  TestWorld world(zurich());
  world.add(body_with(kGps, kExact, at(300, 400, 20)));
  auto& fix = listen<GnssFixSample>(world, "a/gps");
  world->step(1);
  double distance_m = 0.0, azimuth_deg = 0.0, back_deg = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(47.3667, 8.55, fix.value.latitude_deg,
                                           fix.value.longitude_deg, distance_m, azimuth_deg,
                                           back_deg);
  // On the ellipsoid, 500 m below the plane that the metres are on.
  EXPECT_NEAR(distance_m, 500.0 * 6371e3 / (6371e3 + 520.0), 2e-3);
  EXPECT_NEAR(azimuth_deg, std::atan2(300.0, 400.0) * 180.0 / kPi, 1e-3);
  EXPECT_NEAR(fix.value.altitude_m, 520.0 + 500.0 * 500.0 / (2.0 * 6371e3), 1e-3);
}

TEST(Gps, AsASensorItMayNameItsLink) {
  TestWorld world(zurich());
  ModelSpec spec = make_body("a", BoxShape{{0.2, 0.2, 0.2}}, at(0, 0, 1));
  SensorSpec sensor;
  sensor.name = "gps";
  sensor.type = "gps";
  sensor.update_rate_hz = 5.0;
  sensor.plugins = {
      make_plugin("gps", kGps, {{"robotNamespace", "a"}, {"linkName", spec.links[0].name}})};
  spec.links[0].sensors.push_back(sensor);
  world.add(std::move(spec));
  EXPECT_TRUE(world.reports.empty()) << testing::PrintToString(world.reports.size());
}

TEST(Gps, TheWorldsHeadingTurnsItsXFromEastToNorth) {
  WorldSpec spec = zurich();
  spec.spherical.heading_deg = 90.0;
  TestWorld world(spec);
  Model& body = world.add(body_with(kGps, kExact, at(100, 0, 0)));
  auto& fix = listen<GnssFixSample>(world, "a/gps");
  auto& speed = listen<TwistSample>(world, "a/ground_speed");
  world->set_model_twist(body, {2, 0, 0}, {0, 0, 0});
  world->step(1);
  EXPECT_GT(fix.value.latitude_deg, 47.3667 + 8e-4);
  EXPECT_NEAR(fix.value.longitude_deg, 8.55, 1e-9);
  EXPECT_TRUE(is_near(speed.value.v, {0, 2, 0}, 1e-9));
}

TEST(Gps, NoiseAndCovarianceAreThoseOfTheFile) {
  TestWorld world(zurich());
  world.add(body_with(kGps, {{"horPosStdDev", "3"}, {"verPosStdDev", "6"}}, at(0, 0, 0)));
  auto& fix = listen<GnssFixSample>(world, "a/gps");
  constexpr int kSamples = 4000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    world->step(1);
    sum += fix.value.altitude_m - 500.0;
    squares += std::pow(fix.value.altitude_m - 500.0, 2);
  }
  EXPECT_NEAR(sum / kSamples, 0.0, 4.0 * 6.0 / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(squares / kSamples), 6.0, 4.0 * 6.0 / std::sqrt(2.0 * kSamples));
  EXPECT_EQ(fix.value.covariance_enu[0], 9.0);
  EXPECT_EQ(fix.value.covariance_enu[8], 36.0);
}

TEST(Gps, SpreadsInTheHorizontalAndOfTheSpeedAreThoseOfTheFile) {
  TestWorld world(zurich());
  world.add(body_with(kGps,
                      {{"horPosStdDev", "3"}, {"horVelStdDev", "0.1"}, {"verVelStdDev", "0.4"}},
                      at(0, 0, 0)));
  auto& fix = listen<GnssFixSample>(world, "a/gps");
  auto& speed = listen<TwistSample>(world, "a/ground_speed");
  const GeographicLib::LocalCartesian earth(47.3667, 8.55, 500.0);
  constexpr int kSamples = 4000;
  std::vector<double> east, north, across, up;
  for (int i = 0; i < kSamples; ++i) {
    world->step(1);
    Eigen::Vector3d p;
    earth.Forward(fix.value.latitude_deg, fix.value.longitude_deg, fix.value.altitude_m, p.x(),
                  p.y(), p.z());
    east.push_back(p.x());
    north.push_back(p.y());
    across.push_back(speed.value.v.y());
    up.push_back(speed.value.v.z());
  }
  for (const auto& [samples, sigma] :
       {std::pair(east, 3.0), std::pair(north, 3.0), std::pair(across, 0.1), std::pair(up, 0.4)}) {
    const SampleStatistics seen = statistics_of(samples);
    EXPECT_NEAR(seen.mean, 0.0, 4.0 * sigma / std::sqrt(kSamples));
    EXPECT_NEAR(seen.stddev, sigma, 4.0 * sigma / std::sqrt(2.0 * kSamples));
  }
}

TEST(Magnetometer, TurnsTheFieldIntoItsFrame) {
  for (const bool is_enu : {false, true}) {
    TestWorld world(zurich());
    world.add(body_with(kMagnetometer, {{"worldIsEnu", is_enu ? "1" : "0"}},
                        SE3::from_xyz_rpy({0, 0, 1}, 0, 0, kPi / 2.0)));
    auto& field = listen<MagneticFieldSample>(world, "a/magnetic_field");
    world->step(1);
    const Eigen::Vector3d expected = is_enu ? Eigen::Vector3d(2.1493e-5, -8.15e-7, -4.2795e-5)
                                            : Eigen::Vector3d(8.15e-7, -2.1493e-5, 4.2795e-5);
    EXPECT_TRUE(is_near(field.value.field_t, expected, 1e-12)) << is_enu;
  }
}

TEST(Magnetometer, ItsBiasIsDrawnOncePerSeed) {
  std::vector<double> seen;
  for (const std::uint64_t seed : {1u, 1u, 2u}) {
    WorldOptions options;
    options.seed = seed;
    TestWorld world(zurich(), options);
    world.add(body_with(kMagnetometer, {{"noiseUniformInitialBias", "1e-6 0 0"}}, at(0, 0, 1)));
    auto& field = listen<MagneticFieldSample>(world, "a/magnetic_field");
    world->step(1);
    seen.push_back(field.value.field_t.x());
    EXPECT_LE(std::abs(field.value.field_t.x() - 2.1493e-5), 1e-6);
    world->step(5);
    EXPECT_EQ(field.value.field_t.x(), seen.back()) << "a bias, not noise";
  }
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_NE(seen[0], seen[2]);
}

TEST(Magnetometer, NoiseAndBiasHaveTheirSpreads) {
  TestWorld world(zurich());
  world.add(body_with(kMagnetometer, {{"noiseNormal", "8e-8 0 2e-7"}}, at(0, 0, 1)));
  auto& field = listen<MagneticFieldSample>(world, "a/magnetic_field");
  constexpr int kSamples = 4000;
  std::vector<double> x, z;
  for (int i = 0; i < kSamples; ++i) {
    world->step(1);
    x.push_back(field.value.field_t.x());
    z.push_back(field.value.field_t.z());
    EXPECT_EQ(field.value.field_t.y(), 8.15e-7);
  }
  EXPECT_NEAR(statistics_of(x).mean, 2.1493e-5, 4.0 * 8e-8 / std::sqrt(kSamples));
  EXPECT_NEAR(statistics_of(x).stddev, 8e-8, 4.0 * 8e-8 / std::sqrt(2.0 * kSamples));
  EXPECT_NEAR(statistics_of(z).stddev, 2e-7, 4.0 * 2e-7 / std::sqrt(2.0 * kSamples));
  EXPECT_DOUBLE_EQ(field.value.covariance[8], 4e-14);

  std::vector<double> biases;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    WorldOptions options;
    options.seed = seed;
    TestWorld other(zurich(), options);
    other.add(body_with(kMagnetometer, {{"noiseUniformInitialBias", "4e-7 0 0"}}, at(0, 0, 1)));
    auto& biased = listen<MagneticFieldSample>(other, "a/magnetic_field");
    other->step(1);
    biases.push_back(biased.value.field_t.x() - 2.1493e-5);
  }
  const double sigma = 4e-7 / std::sqrt(3.0);  // of a uniform distribution
  EXPECT_NEAR(statistics_of(biases).mean, 0.0, 4.0 * sigma / std::sqrt(600.0));
  EXPECT_NEAR(statistics_of(biases).stddev, sigma, 0.1 * sigma);
}

TEST(Barometer, NoiseHasItsVariance) {
  TestWorld world(zurich());
  world.add(body_with(kBarometer, {{"pressureVariance", "25"}}, at(0, 0, 0)));
  auto& pressure = listen<FluidPressureSample>(world, "a/air_pressure");
  constexpr int kSamples = 4000;
  std::vector<double> errors;
  for (int i = 0; i < kSamples; ++i) {
    world->step(1);
    errors.push_back(pressure.value.pressure_pa - standard_pressure_pa(500.0));
  }
  EXPECT_NEAR(statistics_of(errors).mean, 0.0, 4.0 * 5.0 / std::sqrt(kSamples));
  EXPECT_NEAR(statistics_of(errors).stddev, 5.0, 4.0 * 5.0 / std::sqrt(2.0 * kSamples));
  EXPECT_EQ(pressure.value.variance, 25.0);
}

TEST(Barometer, FollowsTheStandardAtmosphere) {
  // U.S. Standard Atmosphere 1976, table I.
  EXPECT_NEAR(standard_pressure_pa(0.0), 101325.0, 0.01);
  EXPECT_NEAR(standard_pressure_pa(500.0), 95461.0, 1.0);
  EXPECT_NEAR(standard_pressure_pa(1000.0), 89876.0, 1.0);
  EXPECT_NEAR(standard_pressure_pa(5000.0), 54048.0, 2.0);
  TestWorld world(zurich());
  world.add(body_with(kBarometer, {{"referenceAltitude", "400"}}, at(0, 0, 100)));
  auto& pressure = listen<FluidPressureSample>(world, "a/air_pressure");
  world->step(1);
  EXPECT_NEAR(pressure.value.pressure_pa, standard_pressure_pa(500.0), 1e-6);
}

TEST(NavigationSensors, BadParametersAreRefused) {
  TestWorld world(zurich());
  const auto refusal = [&](const char* file, const ParamList& params) {
    return error_of([&] { world.add(body_with(file, params, {})); });
  };
  EXPECT_TRUE(contains(refusal(kGps, {{"horPosStdDev", "-1"}}), "<horPosStdDev> is '-1'"));
  EXPECT_TRUE(contains(refusal(kMagnetometer, {{"refMagNorth", "5"}}), "<refMagNorth> is '5'"));
  EXPECT_TRUE(contains(refusal(kMagnetometer, {{"noiseNormal", "0 -1 0"}}), "three numbers >= 0"));
  EXPECT_TRUE(contains(refusal(kBarometer, {{"pressureVariance", "nan"}}), "<pressureVariance>"));
}

}  // namespace
}  // namespace trident::sim
