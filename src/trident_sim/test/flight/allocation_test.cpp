// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <new>

#include "allocation_count.h"
#include "lee_quad.h"
#include "lidar_rig.h"
#include "scratch_folder.h"
#include "test_world.h"
#include "trident_control_sim/lee_plugin.h"

namespace trident::sim {
namespace {

TEST(Allocation, TheCounterCounts) {
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(8)); }), 1u);
}

class Allocation : public testing::TestWithParam<LoopTiming> {
 protected:
  Allocation() : lee_(1.0), world_(world_spec(), with_timing(GetParam())) {
    control::register_control_plugins(world_.registry);
    world_.add(make_ground());
    world_.add(lee_.model());
    control::TimedSetpoint setpoint;
    setpoint.point.p_world = {0, 0, 2};
    world_->ports()
        .find_in<control::TrajectorySample>("quad/command/trajectory")
        ->write({{0}, {setpoint}});
    world_->step(300);
  }

  LeeQuad lee_;
  TestWorld world_;
};

TEST_P(Allocation, FlyingDoesNotAllocate) {
  EXPECT_EQ(allocations_of([this] { world_->step(1000); }), 0u);
  EXPECT_GT(world_->find_model("quad")->T_world_model().p.z(), 1.5);
}

TEST_P(Allocation, PublishingDoesNotAllocate) {
  for (const char* name : {"quad/odometry", "quad/pose", "quad/motor_speed", "quad/joint_states",
                           "tf/quad/base_link"}) {
    world_->ports().find(name, PortDirection::kOut)->add_listener();
  }
  world_->step(10);
  EXPECT_EQ(allocations_of([this] { world_->step(1000); }), 0u);
}

TEST_P(Allocation, AWindFieldDoesNotAllocate) {
  const ScratchFolder folder;
  ModelSpec probe = make_body("probe", SphereShape{0.1}, at(0, 0, 50));
  probe.links[0].gravity = false;
  probe.plugins.push_back(make_plugin(
      "wind", "librotors_gazebo_wind_plugin.so",
      {{"robotNamespace", "quad"},
       {"linkName", "link"},
       {"frameId", "a_frame_with_a_name_too_long_for_a_short_string"},
       {"useCustomStaticWindField", "true"},
       {"customWindFieldPath",
        folder.write("wind.txt",
                     "min_x: -9 min_y: -9 n_x: 2 n_y: 2 res_x: 18 res_y: 18 bottom_z: 0 0 0 0 "
                     "top_z: 99 99 99 99 vertical_spacing_factors: 0 1 u: 1 1 1 1 1 1 1 1 "
                     "v: 0 0 0 0 0 0 0 0 w: 0 0 0 0 0 0 0 0")}}));
  world_.add(std::move(probe));
  auto* speed = world_->ports().find_out<WindSample>("quad/wind_speed");
  speed->add_listener();
  world_->step(10);
  EXPECT_EQ(allocations_of([this] { world_->step(1000); }), 0u);
  EXPECT_EQ(speed->value.v_world, Eigen::Vector3d(1, 0, 0));
}

/// Of a robot that stands: where links move, Embree allocates as it commits their places.
TEST_P(Allocation, LidarsDoNotAllocateOnceTheyTurn) {
  add_walls(world_, 40.0);
  LidarOptions options;
  options.stddev_m = 0.01;
  const std::pair<const char*, int> lidars[] = {{"libgazebo_ros_laser.so", 1},
                                                {"libtrident_lidar.so", 1},
                                                {"libtrident_lidar3d.so", 4},
                                                {"libgazebo_ros_velodyne_laser.so", 4},
                                                {"libgazebo_ros_range.so", 2}};
  ModelSpec mast = make_static("mast", SphereShape{0.05}, at(20, 0, 1));
  for (const auto& [file, rings] : lidars) {
    options.file = file;
    options.rings = rings;
    options.highest_rad = 0.1 * (rings - 1);
    mast.links[0].sensors.push_back(make_lidar(options));
    SensorSpec& sensor = mast.links[0].sensors.back();
    sensor.name = file;
    sensor.plugins[0].params.children[1].text = file;  // its topic
  }
  world_.add(std::move(mast));
  std::vector<PortBase*> ports;
  for (const auto& [file, rings] : lidars) {
    ports.push_back(world_->ports().find(std::string("r/") + file, PortDirection::kOut));
    ASSERT_NE(ports.back(), nullptr) << file;
    ports.back()->add_listener();
  }
  world_->remove("quad");
  world_->step(100);
  const std::uint64_t before = ports.back()->count();
  EXPECT_EQ(allocations_of([this] { world_->step(300); }), 0u);
  EXPECT_GT(ports.back()->count(), before + 20);
}

/// ODE keeps the memory of contact joints and of its solvers from step to step.
TEST_P(Allocation, RestingOnTheGroundDoesNotAllocateOnceSettled) {
  Model& box = world_.add(make_body("box", BoxShape{{0.2, 0.2, 0.2}}, at(5, 0, 0.1)));
  world_->step(200);
  EXPECT_EQ(allocations_of([this] { world_->step(100); }), 0u);
  EXPECT_TRUE(box.bodies[0]->has_contact());
}
/// Memory of this process that is in use and no part of a file [pages]: code is mapped when it is
/// first run, many pages at a time.
long resident_pages() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  long total = 0, resident = 0, of_files = 0;
  if (file == nullptr || std::fscanf(file, "%ld %ld %ld", &total, &resident, &of_files) != 3) {
    resident = -1;
  }
  if (file != nullptr) std::fclose(file);
  return resident - of_files;
}

TEST_P(Allocation, TenMillionStepsLeaveMemoryTimeAndFlightAlone) {
  const std::uint64_t kSteps = GetParam() == LoopTiming::kRotors ? 9'000'000 : 1'000'000;
  const SimTime begin = world_->time();
  const SE3 hovering = world_->find_model("quad")->T_world_model();
  const long pages = resident_pages();
  EXPECT_EQ(allocations_of([&] { world_->step(kSteps); }), 0u);
  EXPECT_LE(resident_pages(), pages + 1);
  EXPECT_EQ((world_->time() - begin).ns, static_cast<std::int64_t>(kSteps) * world_->dt().ns);
  const SE3 now = world_->find_model("quad")->T_world_model();
  EXPECT_LT((now.p - hovering.p).norm(), 0.1);
  EXPECT_NEAR(now.R.norm(), 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Timing, Allocation,
                         testing::Values(LoopTiming::kRotors, LoopTiming::kDirect),
                         [](const auto& info) {
                           return info.param == LoopTiming::kRotors ? "rotors" : "direct";
                         });

}  // namespace
}  // namespace trident::sim
