// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Lidars with many rings: geometry, times, noise and repeatability of their clouds.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "lidar_rig.h"
#include "trident_sim/ray_scene.h"

namespace trident::sim {
namespace {

constexpr double kHalfRoom = 6.0;  ///< [m]
constexpr double kColumn = 55.296e-6, kBeam = 2.304e-6;

/// A Velodyne VLP-16 at ten turns a second.
LidarOptions vlp16() {
  LidarOptions options;
  options.file = "libtrident_lidar3d.so";
  options.beams = 1808;
  options.max_rad = 1807 * kColumn * 2.0 * kPi * 10.0;
  options.rings = 16;
  options.lowest_rad = deg_to_rad(-15.0);
  options.highest_rad = deg_to_rad(15.0);
  options.range_min_m = 0.4;
  options.range_max_m = 100.0;
  options.params = {{"beamPeriod", "2.304e-6"},
                    {"firingOrder", "0 8 1 9 2 10 3 11 4 12 5 13 6 14 7 15"}};
  return options;
}

LidarOptions snapshot_of(LidarOptions options, const std::string& type = "ray") {
  options.file =
      type == "ray" ? "libgazebo_ros_velodyne_laser.so" : "libgazebo_ros_velodyne_gpu_laser.so";
  options.type = type;
  options.params.clear();
  return options;
}

WorldOptions direct() { return with_timing(LoopTiming::kDirect); }

OutPort<LidarCloudSample>& listen_to_cloud(TestWorld& world) {
  auto* port = world->ports().find_out<LidarCloudSample>("r/scan");
  port->add_listener();
  return *port;
}

Eigen::Vector3d position(const LidarPoint& point) { return {point.x, point.y, point.z}; }

bool same(const std::vector<LidarPoint>& a, const std::vector<LidarPoint>& b) {
  return a.size() == b.size() && !a.empty() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(LidarPoint)) == 0;
}

/// From the nearest wall's face [m]; positive: beyond it.
double beyond_wall(const Eigen::Vector3d& p_world) {
  return p_world.head<2>().cwiseAbs().maxCoeff() - kHalfRoom;
}

TEST(PointLidar, RingsAzimuthsAndTimesAreThoseOfAVlp16) {
  TestWorld world(weightless());
  add_walls(world, kHalfRoom, 20.0);
  world.add(robot_with(vlp16()));
  auto& cloud = listen_to_cloud(world);
  world->step(100);
  ASSERT_EQ(cloud.count(), 1u);
  const LidarCloudSample& value = cloud.value;
  EXPECT_EQ(value.stamp, SimTime{0});
  EXPECT_EQ(value.frame, "r/link");
  ASSERT_EQ(value.points.size(), 16u * 1808u) << "walls all around, so that every beam comes back";
  // The lasers in the order in which they fire [deg], user manual of the VLP-16, table 9-1.
  const int elevations_deg[] = {-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};
  float before_s = -1.0F;
  for (std::size_t i = 0; i < value.points.size(); ++i) {
    const LidarPoint& point = value.points[i];
    const Eigen::Vector3d p = position(point);
    const double time_s =
        static_cast<double>(i / 16) * kColumn + static_cast<double>(i % 16) * kBeam;
    EXPECT_NEAR(point.time, time_s, 1e-8);
    EXPECT_GT(point.time, before_s);
    before_s = point.time;
    EXPECT_EQ(point.ring, (elevations_deg[i % 16] + 15) / 2);
    EXPECT_NEAR(std::asin(p.normalized().z()), deg_to_rad(elevations_deg[i % 16]), 1e-6);
    EXPECT_NEAR(angle_difference(std::atan2(p.y(), p.x()), 2.0 * kPi * 10.0 * time_s), 0.0, 1e-6);
    EXPECT_NEAR(beyond_wall(p), 0.0, 1e-5);
  }
  EXPECT_LT(value.points.back().time, 0.1F);
}

TEST(PointLidar, AScanPerPeriodStampedWithItsFirstBeam) {
  for (const double dt_s : {0.001, 0.004, 0.03}) {
    TestWorld world(weightless(dt_s));
    add_walls(world, kHalfRoom, 20.0);
    world.add(robot_with(vlp16()));
    auto& cloud = listen_to_cloud(world);
    world->step(static_cast<std::uint64_t>(std::ceil(1.0 / dt_s)));
    EXPECT_EQ(cloud.count(), 10u) << dt_s;
    EXPECT_EQ(cloud.value.stamp, SimTime{900'000'000}) << dt_s;
    EXPECT_EQ(cloud.value.points.size(), 16u * 1808u);
  }
}

TEST(PointLidar, AtRestAScanIsTheSameWhateverTheStep) {
  std::vector<LidarPoint> first;
  for (const double dt_s : {0.001, 0.003, 0.05}) {
    TestWorld world(weightless(dt_s));
    add_walls(world, kHalfRoom);
    LidarOptions options = vlp16();
    options.stddev_m = 0.01;
    world.add(robot_with(options));
    auto& cloud = listen_to_cloud(world);
    while (cloud.count() < 2) world->step();
    if (first.empty()) first = cloud.value.points;
    EXPECT_TRUE(same(cloud.value.points, first)) << dt_s;
  }
}

/// A robot that spins and glides at constant rates from the origin, its lidar off its middle.
class MovingRobot {
 public:
  explicit MovingRobot(LidarOptions options, double dt_s = 0.001)
      : world_(weightless(dt_s), direct()) {
    add_walls(world_, kHalfRoom, 20.0);
    options.T_link_sensor.p = p_link_sensor_;
    world_->set_model_twist(world_.add(robot_with(options)), v_world_, {0.0, 0.0, spin_});
    cloud_ = &listen_to_cloud(world_);
    world_->step(static_cast<std::uint64_t>(std::lround(0.5 / dt_s)));
  }
  const LidarCloudSample& cloud() const { return cloud_->value; }

  /// Of a point in the world, taken where the sensor is at a time.
  Eigen::Vector3d in_world(const LidarPoint& point, double time_s) const {
    const Eigen::AngleAxisd R(spin_ * time_s, Eigen::Vector3d::UnitZ());
    return v_world_ * time_s + R * (p_link_sensor_ + position(point));
  }
  struct Errors {
    double mean = 0.0, rms = 0.0, worst = 0.0;
  };
  /// Distances from the walls [m] of level-ish points, de-skewed by their times or not.
  Errors errors(bool is_deskewed) const {
    Errors errors;
    const LidarCloudSample& value = cloud();
    for (const LidarPoint& point : value.points) {
      const double time_s = value.stamp.seconds() + (is_deskewed ? point.time : 0.0F);
      const double error = beyond_wall(in_world(point, time_s));
      errors.mean += error / static_cast<double>(value.points.size());
      errors.rms += error * error / static_cast<double>(value.points.size());
      errors.worst = std::max(errors.worst, std::abs(error));
    }
    errors.rms = std::sqrt(errors.rms);
    return errors;
  }

 private:
  TestWorld world_;
  OutPort<LidarCloudSample>* cloud_;
  Eigen::Vector3d v_world_{1.5, -1.0, 0.0}, p_link_sensor_{0.2, 0.1, 0.3};
  double spin_ = 3.0;  ///< [rad/s]
};

TEST(PointLidar, TheCloudOfAMovingRobotIsUndoneByItsTimes) {
  for (const double dt_s : {0.001, 0.01}) {
    const MovingRobot robot(vlp16(), dt_s);
    ASSERT_EQ(robot.cloud().points.size(), 16u * 1808u);
    EXPECT_LT(robot.errors(true).worst, 2e-3) << dt_s;
    EXPECT_GT(robot.errors(false).worst, 1.0) << "the motion does distort the cloud";
    EXPECT_GT(robot.errors(false).rms, 0.2);
  }
}

TEST(PointLidar, ANoisyCloudOfAMovingRobotLiesOnTheWallsWithinItsNoise) {
  LidarOptions options = vlp16();
  options.stddev_m = 0.03;
  const MovingRobot::Errors errors = MovingRobot(options).errors(true);
  EXPECT_LT(errors.rms, 0.03)
      << "walls are hit at a slant, so that less of the noise is across them";
  EXPECT_GT(errors.rms, 0.02);
  EXPECT_NEAR(errors.mean, 0.0, 4.0 * 0.03 / std::sqrt(16.0 * 1808.0));
}

TEST(PointLidar, ARosetteOfAMovingRobotIsUndoneByItsTimes) {
  LidarOptions options = vlp16();
  options.beams = 20000;
  options.rings = 1;
  options.lowest_rad = options.highest_rad = 0.0;
  options.max_rad = deg_to_rad(19.2);
  options.min_rad = -options.max_rad;
  options.params = {{"pattern", "rosette"}};
  const MovingRobot robot(options);
  ASSERT_EQ(robot.cloud().points.size(), 20000u);
  EXPECT_LT(robot.errors(true).worst, 3e-3);
  EXPECT_GT(robot.errors(false).worst, 0.3);
}

TEST(PointLidar, ASnapshotSeesAllAtItsStamp) {
  for (const std::string type : {"ray", "gpu_ray"}) {
    TestWorld world(weightless(), direct());
    add_walls(world, kHalfRoom, 20.0);
    for (const char* name : {"east", "west", "north", "south"}) {
      EXPECT_NE(world->find_model(name), nullptr);
    }
    Model& robot = world.add(robot_with(snapshot_of(vlp16(), type)));
    world->set_model_twist(robot, {0, 0, 0}, {0, 0, 3.0});
    auto& cloud = listen_to_cloud(world);
    world->step(100);
    ASSERT_EQ(cloud.count(), 1u);
    EXPECT_EQ(cloud.value.stamp, world->time());
    const Eigen::AngleAxisd R(0.3, Eigen::Vector3d::UnitZ());
    if (type == "gpu_ray") {
      EXPECT_TRUE(cloud.value.points.empty()) << "the walls have no visuals";
      continue;
    }
    ASSERT_EQ(cloud.value.points.size(), 16u * 1808u);
    for (const LidarPoint& point : cloud.value.points) {
      EXPECT_EQ(point.time, 0.0F);
      EXPECT_NEAR(beyond_wall(R * position(point)), 0.0, 1e-4);
    }
  }
}

TEST(PointLidar, NoiseHasItsMeanAndSpread) {
  TestWorld world(weightless());
  add_walls(world, kHalfRoom, 20.0);
  LidarOptions options = vlp16();
  options.stddev_m = 0.03;
  options.params.emplace_back("gaussianNoise", "0.04");  // adds to the sensor's own
  world.add(robot_with(options));
  auto& cloud = listen_to_cloud(world);
  world->step(100);
  double sum = 0.0, squares = 0.0, products = 0.0, last = 0.0;
  const auto n = static_cast<double>(cloud.value.points.size());
  for (const LidarPoint& point : cloud.value.points) {
    const Eigen::Vector3d p = position(point), d = p.normalized();
    const double error =
        p.norm() - wall_range(kHalfRoom, std::atan2(d.y(), d.x())) / d.head<2>().norm();
    sum += error;
    squares += error * error;
    products += error * last;
    last = error;
  }
  EXPECT_NEAR(sum / n, 0.0, 4.0 * 0.05 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.05, 4.0 * 0.05 / std::sqrt(2.0 * n));
  EXPECT_NEAR(products / squares, 0.0, 4.0 / std::sqrt(n)) << "beams are independent";
}

TEST(PointLidar, IsTheSameForEverySubscriberAndAfterSnapshotAndReset) {
  const auto make = [](TestWorld& world) {
    add_walls(world, kHalfRoom);
    LidarOptions options = vlp16();
    options.stddev_m = 0.02;
    world->set_model_twist(world.add(robot_with(options)), {0.1, 0, 0}, {0, 0, 1.0});
  };
  TestWorld early(weightless(), direct()), late(weightless(), direct());
  make(early);
  make(late);
  auto& cloud = listen_to_cloud(early);
  early->step(450);
  const Snapshot snapshot = early->save_snapshot();
  early->step(150);
  const std::vector<LidarPoint> expected = cloud.value.points;
  late->step(333);
  auto& late_cloud = listen_to_cloud(late);
  late->step(267);
  EXPECT_TRUE(same(late_cloud.value.points, expected)) << "who came late";
  early->restore_snapshot(snapshot);
  early->step(150);
  EXPECT_TRUE(same(cloud.value.points, expected)) << "after a snapshot in the middle of a scan";
  early->reset();
  early->set_model_twist(*early->find_model("robot"), {0.1, 0, 0}, {0, 0, 1.0});
  early->step(600);
  EXPECT_TRUE(same(cloud.value.points, expected)) << "after a reset";
  EXPECT_EQ(early->state_hash(), late->state_hash());
}

TEST(PointLidar, LeavesOutWhatIsNotInRange) {
  TestWorld world(weightless());
  world.add(make_static("near", BoxShape{{1, 1, 1}}, at(2.5, 0, 0)));
  world.add(make_static("good", BoxShape{{1, 1, 1}}, at(0, 4.5, 0)));
  world.add(make_static("far", BoxShape{{1, 1, 1}}, at(-8.5, 0, 0)));
  LidarOptions options = snapshot_of(vlp16());
  options.beams = 4;
  options.max_rad = 1.5 * kPi;
  options.rings = 1;
  options.lowest_rad = options.highest_rad = 0.0;
  options.params = {{"min_range", "3.5"}, {"max_range", "7.0"}};
  world.add(robot_with(options));
  auto& cloud = listen_to_cloud(world);
  world->step(100);
  ASSERT_EQ(cloud.value.points.size(), 1u);
  EXPECT_TRUE(is_near(position(cloud.value.points[0]), {0.0, 4.0, 0.0}, 1e-6));
}

TEST(PointLidar, IntensityIsTheRetroOfACollisionAndTheBrightnessOfAVisual) {
  for (const std::string type : {"ray", "gpu_ray"}) {
    TestWorld world(weightless());
    ModelSpec plain = make_static("plain", BoxShape{{1, 1, 1}}, at(2.5, 0, 0));
    ModelSpec bright = make_static("bright", BoxShape{{1, 1, 1}}, at(0, 3.5, 0));
    bright.links[0].collisions[0].laser_retro = 250.0;
    for (ModelSpec* model : {&plain, &bright}) {
      VisualSpec visual;
      visual.name = "v";
      visual.shape = model->links[0].collisions[0].shape;
      visual.material.diffuse = {0.5, 0.5, 0.5, 1.0};
      visual.laser_retro = model->links[0].collisions[0].laser_retro;
      model->links[0].visuals.push_back(visual);
      world.add(*model);
    }
    LidarOptions options = snapshot_of(vlp16(), type);
    options.beams = 2;
    options.max_rad = 0.5 * kPi;
    options.rings = 1;
    options.lowest_rad = options.highest_rad = 0.0;
    ModelSpec robot = robot_with(options);
    options.params = {{"min_intensity", "100"}};
    ModelSpec picky = robot_with(options, at(0, 0, 0.2));
    picky.name = "picky";
    picky.links[0].sensors[0].plugins[0].params.children[1].text = "picky";
    world.add(robot);
    world.add(picky);
    auto& cloud = listen_to_cloud(world);
    auto* only_bright = world->ports().find_out<LidarCloudSample>("r/picky");
    only_bright->add_listener();
    world->step(100);
    ASSERT_EQ(cloud.value.points.size(), 2u);
    EXPECT_NEAR(cloud.value.points[0].intensity, type == "ray" ? 0.0 : 50.0, 1e-4);
    EXPECT_EQ(cloud.value.points[1].intensity, 250.0F);
    ASSERT_EQ(only_bright->value.points.size(), 1u);
    EXPECT_EQ(only_bright->value.points[0].intensity, 250.0F);
  }
}

TEST(PointLidar, WithoutListenersNothingIsCast) {
  TestWorld world(weightless());
  add_walls(world, kHalfRoom);
  world.add(robot_with(vlp16()));
  world->step(500);
  EXPECT_EQ(world->ports().find_out<LidarCloudSample>("r/scan")->count(), 0u);
  EXPECT_EQ(rays(*world, RayGeometry::kCollision).commits().fixed, 0u);
}

TEST(PointLidar, BadElementsAreRefusedByName) {
  const auto refusal = [](const LidarOptions& options) {
    TestWorld world(weightless());
    return error_of([&] { world.add(robot_with(options)); });
  };
  LidarOptions options = vlp16();
  options.rate_hz = 0.0;
  EXPECT_TRUE(contains(refusal(options), "<update_rate> > 0"));
  options = vlp16();
  options.beams = 0;
  EXPECT_TRUE(contains(refusal(options), "<samples>"));
  options = vlp16();
  options.rings = 0;
  EXPECT_TRUE(contains(refusal(options), "<samples>"));
  options = vlp16();
  options.range_max_m = 0.3;
  EXPECT_TRUE(contains(refusal(options), "less than <max>"));
  options = snapshot_of(vlp16());
  options.params = {{"min_range", "50"}, {"max_range", "20"}};
  const std::string error = refusal(options);
  EXPECT_TRUE(contains(error, "<min_range>"));
  EXPECT_TRUE(contains(error, "50"));
  EXPECT_TRUE(contains(error, "20"));
  EXPECT_TRUE(contains(error, "model 'robot'"));
}

}  // namespace
}  // namespace trident::sim
