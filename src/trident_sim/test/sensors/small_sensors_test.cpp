// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Range finders, block lasers, lidars faster than the step, and wheel encoders.
#include <gtest/gtest.h>

#include <cmath>

#include "lidar_rig.h"

namespace trident::sim {
namespace {

/// Five by three beams in a cone of 0.4 rad about x.
LidarOptions cone(const std::string& file) {
  LidarOptions options;
  options.file = file;
  options.beams = 5;
  options.rings = 3;
  options.max_rad = options.highest_rad = 0.2;
  options.min_rad = options.lowest_rad = -0.2;
  options.range_min_m = 0.05;
  options.range_max_m = 4.0;
  return options;
}

template <class Sample>
OutPort<Sample>& listen(TestWorld& world) {
  auto* port = world->ports().find_out<Sample>("r/scan");
  port->add_listener();
  return *port;
}

TEST(RangeFinder, ReportsTheNearestOfItsRays) {
  TestWorld world(weightless());
  LidarOptions options = cone("libgazebo_ros_range.so");
  options.params = {{"fov", "0.4"}, {"radiation", "infrared"}};
  world.add(make_static("wall", BoxShape{{0.2, 9.0, 9.0}}, at(3.1, 0, 0)));
  world.add(robot_with(options));
  auto& range = listen<RangeSample>(world);
  world->step(100);
  ASSERT_EQ(range.count(), 1u);
  EXPECT_EQ(range.value.stamp, world->time());
  EXPECT_NEAR(range.value.range_m, 3.0, 1e-9);
  EXPECT_TRUE(range.value.is_infrared);
  EXPECT_EQ(range.value.field_of_view_rad, 0.4);
  EXPECT_EQ(range.value.range_min_m, 0.05);
  EXPECT_EQ(range.value.range_max_m, 4.0);
  // A post that only the outermost beams hit.
  world.add(make_static("post", BoxShape{{0.2, 0.2, 9.0}}, at(2.1, 0.42, 0)));
  world->step(100);
  EXPECT_NEAR(range.value.range_m, 2.0 / std::cos(0.2), 1e-6);
}

TEST(RangeFinder, ReportsTheLargestRangeOfNothingAndIsNoisyElsewhere) {
  TestWorld world(weightless());
  LidarOptions options = cone("libgazebo_ros_range.so");
  options.rate_hz = 1000.0;
  options.beams = options.rings = 1;
  options.min_rad = options.lowest_rad = options.max_rad = options.highest_rad = 0.0;
  options.params = {{"gaussianNoise", "0.05"}};
  world.add(robot_with(options));
  auto& range = listen<RangeSample>(world);
  world->step(10);
  EXPECT_EQ(range.value.range_m, 4.0);
  EXPECT_FALSE(range.value.is_infrared);
  world.add(make_static("wall", BoxShape{{0.2, 9.0, 9.0}}, at(2.1, 0, 0)));
  double sum = 0.0, squares = 0.0;
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) {
    world->step();
    const double error = range.value.range_m - 2.0;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kSamples, 0.0, 4.0 * 0.05 / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.05, 4.0 * 0.05 / std::sqrt(2.0 * kSamples));
}

TEST(RangeFinder, BadElementsAreRefusedByName) {
  const auto refusal = [](const std::string& key, const std::string& value) {
    TestWorld world(weightless());
    LidarOptions options = cone("libgazebo_ros_range.so");
    options.params = {{key, value}};
    return error_of([&] { world.add(robot_with(options)); });
  };
  EXPECT_TRUE(contains(refusal("radiation", "sound"), "ultrasound or infrared"));
  EXPECT_TRUE(contains(refusal("fov", "-1"), "<fov>"));
  TestWorld world(weightless());
  ModelSpec robot = robot_with(cone("libgazebo_ros_range.so"));
  for (ParamNode& child : robot.links[0].sensors[0].plugins[0].params.children) {
    if (child.name == "topicName") child.text = "/";
  }
  EXPECT_TRUE(contains(error_of([&] { world.add(robot); }), "<topicName>"));
}

TEST(BlockLaser, HasAPointPerBeam) {
  TestWorld world(weightless());
  world.add(make_static("wall", BoxShape{{0.2, 2.0, 9.0}}, at(3.1, 1.0, 0)));
  world.add(robot_with(cone("libgazebo_ros_block_laser.so")));
  auto& cloud = listen<PointListSample>(world);
  world->step(100);
  ASSERT_EQ(cloud.count(), 1u);
  ASSERT_EQ(cloud.value.points.size(), 15u);
  ASSERT_EQ(cloud.value.intensities.size(), 15u);
  int on_wall = 0;
  for (std::size_t i = 0; i < 15; ++i) {
    const Eigen::Vector3d p = cloud.value.points[i].cast<double>();
    const double azimuth = -0.2 + 0.1 * static_cast<double>(i % 5);
    EXPECT_NEAR(std::atan2(p.y(), p.x()), azimuth, 1e-6);
    EXPECT_NEAR(std::asin(p.normalized().z()), -0.2 + 0.2 * static_cast<double>(i / 5), 1e-6);
    if (std::abs(p.x() - 3.0) < 1e-5) {
      ++on_wall;
    } else {
      EXPECT_NEAR(p.norm(), 4.0, 1e-5) << "the largest range where nothing is hit";
    }
  }
  EXPECT_GE(on_wall, 6);
  EXPECT_LE(on_wall, 9);
}

TEST(FastLidar, ReportsAllItsScansInOrder) {
  TestWorld world(weightless(0.01));
  world.add(make_static("wall", BoxShape{{0.2, 9.0, 9.0}}, at(3.1, 0, 0)));
  LidarOptions options;
  options.file = "libtrident_lidar.so";
  options.beams = 1;
  options.max_rad = 0.0;
  options.rate_hz = 1000.0;
  options.stddev_m = 0.01;
  Model& robot = world.add(robot_with(options));
  world->set_model_twist(robot, {1.0, 0, 0}, {0, 0, 0});
  auto& scan = listen<LaserScanSample>(world);
  std::vector<LaserScanSample> scans;
  for (int step = 0; step < 10; ++step) {
    world->step();
    for (const LaserScanSample& earlier : scan.earlier()) scans.push_back(earlier);
    scans.push_back(scan.value);
  }
  EXPECT_EQ(scans.size(), scan.count());
  ASSERT_GE(scans.size(), 99u);
  double squares = 0.0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(scans[i].stamp, SimTime{static_cast<std::int64_t>(i) * 1'000'000});
    // Timing as in RotorS: what is measured as a step begins is stamped with its end.
    const double travelled_m = 1.0 * (scans[i].stamp.seconds() - 0.01);
    if (i > 10) squares += std::pow(scans[i].ranges.at(0) - (3.0 - travelled_m), 2);
  }
  const auto n = static_cast<double>(scans.size() - 11);
  EXPECT_NEAR(std::sqrt(squares / n), 0.01, 4.0 * 0.01 / std::sqrt(2.0 * n));
}

TEST(WheelEncoders, ReportWholeTicksAndTheirRate) {
  TestWorld world(weightless(), with_timing(LoopTiming::kDirect));
  ModelSpec spec = make_on_world(JointType::kRevolute, {0, 0, 0}, {0, 0, 1});
  spec.plugins = {make_plugin("encoders", "libtrident_wheel_encoder.so",
                              {{"robotNamespace", "r"},
                               {"jointName", "j"},
                               {"ticksPerTurn", "100"},
                               {"updateRate", "10"}})};
  Model& model = world.add(spec);
  auto* states = world->ports().find_out<JointStateSample>("r/wheel_encoders");
  states->add_listener();
  Joint& joint = *model.find_joint("j");
  joint.motor = JointMotor{2.0, 100.0};
  const double tick = 2.0 * kPi / 100.0;
  for (int sample = 0; sample < 30; ++sample) {
    world->step(100);
    const double reported = states->value.positions.at(0), angle = joint.position();
    EXPECT_NEAR(std::remainder(reported, tick), 0.0, 1e-9) << "whole ticks";
    EXPECT_LE(reported, angle + 1e-9);
    EXPECT_GT(reported, angle - tick - 1e-9);
    EXPECT_NEAR(states->value.velocities.at(0), 2.0, 1.01 * tick / 0.1);
  }
  EXPECT_EQ(states->count(), 30u);
  EXPECT_GT(states->value.positions.at(0), 5.5);
}

}  // namespace
}  // namespace trident::sim
