// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A flight after a reset is the first flight again, with its filters and its noise.
#include <gtest/gtest.h>

#include <vector>

#include "quad_world.h"

namespace trident::sim {
namespace {

constexpr int kSteps = 60;

/// A quad whose odometry is noisy, late and rare, with a noisy IMU and a box that it lands on.
class Reset : public testing::TestWithParam<LoopTiming> {
 protected:
  Reset() : world_(world_spec(), WorldOptions{7, GetParam(), {}}) {
    ModelSpec spec = make_quad();
    spec.T_world_model = at(0, 0, 0.5);
    spec.links[0].collisions.push_back(make_collision(BoxShape{{0.2, 0.2, 0.1}}));
    ParamNode& odometry = spec.plugins.back().params;
    for (const auto& [key, value] : ParamList{{"noiseNormalPosition", "0.1 0.1 0.1"},
                                              {"noiseUniformLinearVelocity", "0.2 0.2 0.2"},
                                              {"measurementDivisor", "3"},
                                              {"measurementDelay", "2"}}) {
      odometry.children.push_back({key, value, {}, {}});
    }
    spec.plugins.push_back(make_plugin("imu", "librotors_gazebo_imu_plugin.so",
                                       {{"robotNamespace", "quad"}, {"linkName", "base_link"}}));
    world_.add(make_body("box", BoxShape{{0.4, 0.4, 0.2}}, at(0.05, 0, 0.3)));
    world_.add(make_ground());
    quad_ = &world_.add(std::move(spec));
    odometry_ = world_->ports().find_out<OdometrySample>("quad/odometry");
    imu_ = world_->ports().find_out<ImuSample>("quad/imu");
    odometry_->add_listener();
    imu_->add_listener();
  }

  /// Commands, steps, and returns all that was measured; stamps since the first step.
  std::vector<double> fly() {
    const SimTime begin = world_->time();
    std::vector<double> record;
    const auto add = [&record](const Eigen::Vector3d& v) {
      record.insert(record.end(), v.data(), v.data() + 3);
    };
    for (int i = 0; i < kSteps; ++i) {
      ActuatorCommand command;
      command.stamp = world_->time() + world_->dt();  // never zero, which would mean at once
      const std::vector<double> speeds(4, 300.0 + 5.0 * i);
      command.angular_velocities.assign({speeds.data(), speeds.size()});
      world_->ports().find_in<ActuatorCommand>("quad/command/motor_speed")->write(command);
      world_->step();
      record.push_back((odometry_->value.stamp - begin).seconds());
      add(odometry_->value.T_parent_child.p);
      add(odometry_->value.v_child);
      add(imu_->value.a_imu);
      add(imu_->value.w_imu);
      add(quad_->T_world_model().p);
      record.push_back(quad_->find_joint("rotor_2_joint")->velocity());
    }
    return record;
  }

  TestWorld world_;
  Model* quad_;
  OutPort<OdometrySample>* odometry_;
  OutPort<ImuSample>* imu_;
};

TEST_P(Reset, OfModelsRepeatsTheFlightAndItsNoiseWhileTimeContinues) {
  std::vector<double> first = fly();
  world_->step(31);  // not a multiple of the odometry's divisor
  world_->reset_models();
  const SimTime after = world_->time();
  EXPECT_EQ(after, SimTime::from_seconds(0.01 * (kSteps + 31)));
  std::vector<double> second = fly();
  // Until the first measurement the ports hold the last one of the flight before.
  const auto measured = static_cast<std::ptrdiff_t>(17 * 6);
  first.erase(first.begin(), first.begin() + measured);
  second.erase(second.begin(), second.begin() + measured);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_NEAR(first[i], second[i], 1e-9) << i;
}

TEST_P(Reset, OfEverythingRepeatsItToTheBit) {
  fly();
  const std::string first = world_->state_hash();
  const Eigen::Vector3d a_imu = imu_->value.a_imu;
  world_->reset();
  fly();
  EXPECT_EQ(world_->state_hash(), first);
  EXPECT_EQ(imu_->value.a_imu, a_imu);
}

TEST_P(Reset, OfModelsKeepsWhatModelsAreMadeOf) {
  Link& base = *quad_->find_link("base_link");
  Inertial heavy = base.inertial;
  heavy.mass_kg = 3.0;
  world_->set_link_inertial(base, heavy, true);
  world_->reset_models();
  EXPECT_EQ(base.inertial.mass_kg, 3.0);
}
INSTANTIATE_TEST_SUITE_P(Timings, Reset, testing::Values(LoopTiming::kRotors, LoopTiming::kDirect));

}  // namespace
}  // namespace trident::sim
