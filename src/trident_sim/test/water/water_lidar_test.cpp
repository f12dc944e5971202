// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Lidars and range finders over water, and in it.
#include <gtest/gtest.h>

#include <cmath>

#include "lidar_rig.h"
#include "sea_view.h"
#include "sensors/lidar/water_returns.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

const ParamList kCalm = {{"spectrum", "none"}};

/// A fan across the vertical plane x, z: beam i looks i degrees off straight down, from -60 to 60.
LidarOptions downward_fan(const std::string& returns) {
  LidarOptions options;
  options.beams = 121;
  options.min_rad = -kPi / 3.0;
  options.max_rad = kPi / 3.0;
  options.range_max_m = 100.0;
  options.T_link_sensor.R = Eigen::AngleAxisd(kPi / 2.0, Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(kPi / 2.0, Eigen::Vector3d::UnitX());
  if (!returns.empty()) options.params = {{"water_returns", returns}};
  return options;
}
double off_vertical(std::size_t beam) { return deg_to_rad(static_cast<double>(beam) - 60.0); }

template <class Message>
OutPort<Message>& listen_to(TestWorld& world) {
  auto* const port = world->ports().find_out<Message>("r/scan");
  port->add_listener();
  return *port;
}

std::vector<float> scan_of(const LidarOptions& options, double height_m, int scans = 1) {
  TestWorld world(sea_spec(kCalm, "1"));
  ModelSpec floor = make_ground();
  floor.T_world_model.p.z() = -3.0;
  world.add(floor);
  world.add(make_static("buoy", BoxShape{{1, 1, 1}}, at(3, 0, 1)));
  world.add(robot_with(options, at(0, 0, 1.0 + height_m)));
  auto& scan = listen_to<LaserScanSample>(world);
  world->step(static_cast<std::uint64_t>(10 * scans));
  EXPECT_EQ(scan.count(), static_cast<std::uint64_t>(scans));
  return scan.value.ranges;
}

TEST(WaterReturns, FallWithTheAngleAndTheDistance) {
  EXPECT_GT(water_return_probability(1.0, 20.0), 0.999);
  EXPECT_LT(water_return_probability(std::cos(deg_to_rad(25.0)), 20.0), 0.2);
  EXPECT_GT(water_return_probability(std::cos(deg_to_rad(75.0)), 2.0), 0.8);
  EXPECT_LT(water_return_probability(std::cos(deg_to_rad(85.0)), 10.0), 0.05);
  for (const double angle : {0.0, 0.1, 0.2, 0.3, 1.0, 1.5}) {
    double before = 1.0;
    for (const double distance : {0.0, 1.0, 5.0, 20.0, 100.0, 1e4}) {
      const double p = water_return_probability(std::cos(angle), distance);
      EXPECT_GE(p, 0.0);
      EXPECT_LE(p, before);
      before = p;
    }
  }
  EXPECT_LT(water_return_probability(0.0, 100.0), 1e-3);
}

TEST(WaterReturns, OnAreAtTheSurface) {
  const std::vector<float> ranges = scan_of(downward_fan("on"), 10.0);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double angle = off_vertical(i);
    if (std::abs(10.0 * std::tan(angle)) > 2.3 && std::abs(10.0 * std::tan(angle)) < 3.7) continue;
    EXPECT_NEAR(ranges[i], 10.0 / std::cos(angle), 1e-3) << i;
  }
}

TEST(WaterReturns, OffAreNoneAndTheBottomStaysHidden) {
  const std::vector<float> ranges = scan_of(downward_fan("off"), 10.0);
  int on_buoy = 0;
  for (const float range : ranges) {
    if (!std::isfinite(range)) continue;
    EXPECT_GT(range, 9.0F);
    EXPECT_LT(range, 11.0F) << "only the buoy is seen, which floats to 0.5 m above the water";
    ++on_buoy;
  }
  EXPECT_GE(on_buoy, 4);
  EXPECT_LE(on_buoy, 7);
}

TEST(WaterReturns, OfALidarComeFromStraightBelow) {
  const std::vector<float> ranges = scan_of(downward_fan(""), 20.0);
  for (std::size_t i = 52; i <= 68; ++i) EXPECT_TRUE(std::isfinite(ranges[i])) << i;
  int aside = 0;
  for (std::size_t i = 0; i < 35; ++i) aside += std::isfinite(ranges[i]) ? 1 : 0;
  EXPECT_LT(aside, 10);
}

TEST(WaterReturns, ComeAsOftenAsTheModelSays) {
  TestWorld world(sea_spec(kCalm));
  LidarOptions options = downward_fan("auto");
  world.add(robot_with(options, at(0, 0, 3.0)));
  auto& scan = listen_to<LaserScanSample>(world);
  constexpr int kScans = 200;
  double seen = 0.0, expected = 0.0, variance = 0.0;
  for (int k = 0; k < kScans; ++k) {
    world->step(10);
    for (std::size_t i = 0; i < 121; ++i) {
      const double c = std::cos(off_vertical(i)), p = water_return_probability(c, 3.0 / c);
      expected += p;
      variance += p * (1.0 - p);
      seen += std::isfinite(scan.value.ranges[i]) ? 1.0 : 0.0;
    }
  }
  EXPECT_GT(variance, 100.0) << "chance decides";
  EXPECT_NEAR(seen, expected, 5.0 * std::sqrt(variance));
}

TEST(WaterReturns, UnderWaterAreAsDocumented) {
  const auto finite = [](const std::vector<float>& ranges) {
    return std::count_if(ranges.begin(), ranges.end(), [](float r) { return std::isfinite(r); });
  };
  EXPECT_EQ(finite(scan_of(downward_fan("auto"), -1.0)), 0);
  const std::vector<float> through = scan_of(downward_fan("off"), -1.0);
  EXPECT_NEAR(through[60], 3.0, 1e-3) << "the floor, as through clear water";
  LidarOptions upward = downward_fan("on");
  upward.T_link_sensor.R = Eigen::AngleAxisd(-kPi / 2.0, Eigen::Vector3d::UnitY()) *
                           Eigen::AngleAxisd(kPi / 2.0, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(scan_of(upward, -1.0)[60], 1.0, 1e-3) << "the surface from below";
  upward.params = {{"water_returns", "off"}};
  EXPECT_FALSE(std::isfinite(scan_of(upward, -1.0)[60]));
}

TEST(WaterReturns, OfSoundAlwaysCome) {
  LidarOptions sonar = downward_fan("");
  sonar.file = "libgazebo_ros_range.so";
  TestWorld world(sea_spec(kCalm));
  world.add(robot_with(sonar, at(0, 0, 30.0)));
  auto& range = listen_to<RangeSample>(world);
  world->step(10);
  EXPECT_NEAR(range.value.range_m, 30.0, 1e-3);
}

TEST(WaterReturns, AWrongWordIsRefused) {
  TestWorld world(sea_spec(kCalm));
  const std::string error = error_of([&] { world.add(robot_with(downward_fan("maybe"))); });
  EXPECT_TRUE(contains(error, "water_returns"));
  EXPECT_TRUE(contains(error, "maybe"));
  EXPECT_TRUE(contains(error, "auto, off or on"));
}

TEST(WaterReturns, WaterNearerThanTheSmallestRangeHidesWhatLiesBeyond) {
  LidarOptions options = downward_fan("on");
  options.range_min_m = 0.5;
  EXPECT_FALSE(std::isfinite(scan_of(options, 0.3)[60]));
}

TEST(WaterReturns, AreThoseOfBeamsThatAreFollowedToTheWater) {
  TestWorld world(sea_spec(jonswap("0.6", "4")));
  RayScene& scene = fresh_rays(world);
  const auto water = as_water(scene.refresh_surface({0, 0, 2}));
  const WaterSight sight(WaterReturns::kAuto, 5, "lidar");
  const RandomStream chance(5, "lidar/water");
  constexpr std::uint32_t kChannel = 7, kOther = 1234;
  Draw draw("beams");
  int reported = 0, lost = 0;
  for (std::uint64_t scan = 0; scan < 20000; ++scan) {
    Ray ray{{draw.uniform(-9, 9), draw.uniform(-9, 9), draw.uniform(0.2, 6.0)}, draw.direction()};
    ray.t_max_m = 100.0;
    if (ray.p_world_origin.z() < water->height_m(ray.p_world_origin.head<2>())) continue;
    RayHit behind;
    if (scan % 3 == 0) {
      behind.distance_m = draw.uniform(0.5, 30.0);
      behind.shape = kOther;
    }
    RayHit expected = behind;
    scene.add_surface(*water, {&ray, 1}, {&expected, 1});
    if (expected.shape == scene.surface_shape()) {
      const double p = water_return_probability(-expected.normal_world.dot(ray.direction_world),
                                                expected.distance_m);
      const bool is_reported = chance.uniform(scan, kChannel) < p;
      ++(is_reported ? reported : lost);
      if (!is_reported) expected = {};
    }
    const RayHit seen = sight.see(scene, *water, ray, behind, scan, kChannel);
    ASSERT_EQ(seen.shape, expected.shape) << scan;
    ASSERT_EQ(seen.distance_m, expected.distance_m) << scan;
  }
  EXPECT_GT(reported, 500);
  EXPECT_GT(lost, 500);
}

/// A spinning lidar with 16 rings on a body that drifts over waves.
struct Voyage {
  std::vector<LidarPoint> points;
  std::string hash;
};
Voyage voyage(std::size_t threads, bool is_heard) {
  WorldOptions world_options;
  world_options.sensor_threads = threads;
  TestWorld world(sea_spec(jonswap("0.6", "4")), world_options);
  LidarOptions options;
  options.file = "libtrident_lidar3d.so";
  options.beams = 600;
  options.rings = 16;
  options.lowest_rad = deg_to_rad(-15.0);
  options.highest_rad = deg_to_rad(15.0);
  options.range_max_m = 100.0;
  Model& robot = world.add(robot_with(options, at(0, 0, 1.5)));
  // Others, cast along with it, see other tiles; one of them takes snapshots.
  ModelSpec mast = make_static("mast", SphereShape{0.05}, at(90, 0, 3));
  for (const char* file : {"libtrident_lidar3d.so", "libgazebo_ros_velodyne_laser.so"}) {
    options.file = file;
    mast.links[0].sensors.push_back(make_lidar(options));
    mast.links[0].sensors.back().name = file;
    mast.links[0].sensors.back().plugins[0].params.children[1].text = file;  // its topic
  }
  world.add(std::move(mast));
  world->set_model_twist(robot, {1, 0.5, 0.0}, {0.0, 0.0, 0.3});
  Voyage result;
  std::vector<const OutPort<LidarCloudSample>*> clouds;
  for (const char* name : {"scan", "libtrident_lidar3d.so", "libgazebo_ros_velodyne_laser.so"}) {
    auto* const cloud = world->ports().find_out<LidarCloudSample>(std::string("r/") + name);
    if (is_heard) cloud->add_listener();
    clouds.push_back(cloud);
  }
  for (int i = 0; i < 5; ++i) {
    world->step(10);
    for (const auto* const cloud : clouds) {
      const auto& points = cloud->value.points;
      EXPECT_EQ(points.empty(), !is_heard) << cloud->name();
      result.points.insert(result.points.end(), points.begin(), points.end());
    }
  }
  EXPECT_EQ(rays(*world, RayGeometry::kCollision).surface() != nullptr, is_heard)
      << "nothing is worked out for nobody";
  result.hash = world->state_hash();
  return result;
}

TEST(WaterReturns, DependOnNeitherThreadsNorListeners) {
  const Voyage one = voyage(1, true), three = voyage(3, true), unheard = voyage(1, false);
  EXPECT_EQ(one.hash, unheard.hash);
  EXPECT_TRUE(unheard.points.empty());
  ASSERT_GT(one.points.size(), 500u);
  ASSERT_EQ(one.points.size(), three.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    EXPECT_EQ(one.points[i].x, three.points[i].x);
    EXPECT_EQ(one.points[i].z, three.points[i].z);
  }
}

}  // namespace
}  // namespace trident::sim
