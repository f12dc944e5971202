// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Sensors under the names of hector_gazebo_plugins.
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "lidar_rig.h"
#include "models.h"
#include "sample_statistics.h"
#include "test_world.h"
#include "trident_sim/samples/vector_sample.h"

namespace trident::sim {
namespace {

WorldSpec on_earth_heading(double heading_deg = 0.0) {
  WorldSpec spec = weightless(0.01);
  spec.spherical = {49.9, 8.9, 100.0, heading_deg};
  return spec;
}

ModelSpec body_with(const std::string& file, ParamList params, const SE3& T_world_model = {}) {
  ModelSpec model = make_body("a", SphereShape{0.1}, T_world_model);
  params.insert(params.begin(), {"robotNamespace", "a"});
  model.plugins.push_back(make_plugin("p", file, params));
  return model;
}

template <class Sample>
OutPort<Sample>& listen(TestWorld& world, const std::string& name) {
  auto* port = world->ports().find_out<Sample>(name);
  if (port == nullptr) throw Error("there is no port '" + name + "'");
  port->add_listener();
  return *port;
}

const char kGps[] = "libhector_gazebo_ros_gps.so";
const char kMagnetic[] = "libhector_gazebo_ros_magnetic.so";

TEST(HectorGps, PositionIsOnTheEarthAndVelocityNorthWestUp) {
  TestWorld world(on_earth_heading());
  Model& body = world.add(body_with(kGps, {}, at(30, 40, 2)));
  auto& fix = listen<GnssFixSample>(world, "a/fix");
  auto& speed = listen<VectorSample>(world, "a/fix_velocity");
  world->set_model_twist(body, {1, 2, 3}, {0, 0, 0});
  world->step(25);
  const GeographicLib::LocalCartesian earth(49.9, 8.9, 100.0);
  Eigen::Vector3d p;
  earth.Forward(fix.value.latitude_deg, fix.value.longitude_deg, fix.value.altitude_m, p.x(), p.y(),
                p.z());
  EXPECT_TRUE(is_near(p, {30.25, 40.5, 2.75}, 0.04)) << "x is east";
  EXPECT_TRUE(is_near(speed.value.value, {2, -1, 3}, 1e-9));
  EXPECT_EQ(fix.count(), 1u) << "4 Hz";
  EXPECT_EQ(fix.value.frame, "link");
}

TEST(HectorGps, ReferenceStandsInForTheWorlds) {
  TestWorld world(on_earth_heading());
  world.add(body_with(kGps,
                      {{"referenceLatitude", "10"},
                       {"referenceLongitude", "20"},
                       {"referenceAltitude", "5"},
                       {"referenceHeading", "0"}},
                      at(100, 0, 0)));
  auto& fix = listen<GnssFixSample>(world, "a/fix");
  world->step(25);
  const GeographicLib::LocalCartesian earth(10.0, 20.0, 5.0);
  Eigen::Vector3d p;
  earth.Forward(fix.value.latitude_deg, fix.value.longitude_deg, fix.value.altitude_m, p.x(), p.y(),
                p.z());
  EXPECT_TRUE(is_near(p, {0, 100, 0}, 1e-6)) << "heading 0: x is north";
}

TEST(HectorGps, ErrorsHaveTheirSpread) {
  TestWorld world(on_earth_heading());
  world.add(body_with(kGps, {{"updateRate", "0"}, {"gaussianNoise", "2 3 4"}}));
  auto& fix = listen<GnssFixSample>(world, "a/fix");
  std::vector<double> heights;
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) {
    world->step(1);
    heights.push_back(fix.value.altitude_m - 100.0);
  }
  EXPECT_NEAR(statistics_of(heights).mean, 0.0, 4.0 * 4.0 / std::sqrt(kSamples));
  EXPECT_NEAR(statistics_of(heights).stddev, 4.0, 4.0 * 4.0 / std::sqrt(2.0 * kSamples));
  EXPECT_NEAR(fix.value.covariance_enu[0], 4.0, 1e-9) << "east is x";
  EXPECT_NEAR(fix.value.covariance_enu[4], 9.0, 1e-9);
  EXPECT_NEAR(fix.value.covariance_enu[8], 16.0, 1e-9);
}

TEST(HectorMagnetic, PointsNorthAndDownInTheBodysFrame) {
  for (const bool as_field : {false, true}) {
    TestWorld world(on_earth_heading());
    world.add(body_with(kMagnetic,
                        {{"magnitude", "2"}, {"useMagneticFieldMsgs", as_field ? "true" : "false"}},
                        SE3::from_xyz_rpy({0, 0, 0}, 0, 0, 0.5 * kPi)));
    Eigen::Vector3d seen;
    if (as_field) {
      auto& field = listen<MagneticFieldSample>(world, "a/magnetic");
      world->step(1);
      seen = field.value.field_t;
    } else {
      auto& field = listen<VectorSample>(world, "a/magnetic");
      world->step(1);
      seen = field.value.value;
    }
    // Inclined by 60 degrees; the body's x points north.
    EXPECT_TRUE(is_near(seen, {1.0, 0.0, -std::sqrt(3.0)}, 1e-9)) << as_field;
  }
}

TEST(HectorMagnetic, DeclinationTurnsItFromTrueNorthEastwards) {
  TestWorld world(on_earth_heading());
  world.add(body_with(kMagnetic, {{"inclination", "0"}, {"declination", "30"}}));
  auto& field = listen<VectorSample>(world, "a/magnetic");
  world->step(1);
  EXPECT_TRUE(is_near(field.value.value, {0.5, std::sqrt(0.75), 0}, 1e-9)) << "east, north";
}

TEST(HectorBaro, ReportsTheHeight) {
  TestWorld world(on_earth_heading());
  world.add(body_with("libhector_gazebo_ros_baro.so", {{"offset", "0 0 0.5"}}, at(1, 2, 7)));
  auto& height = listen<PointSample>(world, "a/pressure_height");
  world->step(3);
  EXPECT_TRUE(is_near(height.value.p_frame, {0, 0, 7.5}, 1e-9));
  EXPECT_EQ(height.value.stamp, world->time());
}

TEST(HectorSonar, ReportsTheNearestRange) {
  TestWorld world(weightless());
  world.add(make_static("wall", BoxShape{{0.2, 20, 20}}, at(3.1, 0, 0)));
  LidarOptions options;
  options.file = "libhector_gazebo_ros_sonar.so";
  options.beams = 5;
  options.min_rad = -0.2;
  options.max_rad = 0.2;
  options.rings = 3;
  options.lowest_rad = -0.1;
  options.highest_rad = 0.1;
  options.range_max_m = 4.0;
  options.params = {{"frameId", "sonar_link"}, {"offset", "0.25"}};
  Model& robot = world.add(robot_with(options));
  auto& range = listen<RangeSample>(world, "r/scan");
  world->step(1000);
  EXPECT_EQ(range.count(), 10u);
  EXPECT_NEAR(range.value.range_m, 3.25, 1e-6);
  EXPECT_NEAR(range.value.field_of_view_rad, 0.2, 1e-9) << "the narrower of the two";
  EXPECT_EQ(range.value.frame, "sonar_link");
  world->set_model_pose(robot, at(-5, 0, 0));
  world->step(100);
  EXPECT_EQ(range.value.range_m, 4.0) << "nothing is hit: the maximum, without noise";
}

}  // namespace
}  // namespace trident::sim
