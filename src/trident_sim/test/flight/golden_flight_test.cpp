// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <ostream>

#include "golden_data.h"
#include "golden_world.h"

namespace trident::sim {
namespace {

constexpr double kDt = 0.01;

/// One flight, split into the cases of the recording: a set-point each, used first by the command
/// computed from the state of `step`.
struct Case {
  const char* name;
  std::uint64_t step;
  Eigen::Vector3d p_world;
  double yaw_rad, limit_deg;
};
const Case kCases[] = {{"hover", 200, {0, 0, 1}, 0.0, 0.3},
                       {"step_x", 1400, {1, 0, 1}, 0.0, 0.3},
                       {"step_z", 2600, {1, 0, 2}, 0.0, 0.3},
                       {"yaw90", 3800, {1, 0, 2}, M_PI / 2, 0.6}};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class GoldenFlight : public testing::TestWithParam<Case> {};

TEST_P(GoldenFlight, FireflyStaysWithinTwoMillimetersOfGazebo) {
  TRIDENT_NEEDS_GOLDEN();
  const Case& wanted = GetParam();
  GoldenWorld world(golden_folder() + "/params/basic.world");
  Model& firefly = world.add_firefly("firefly", at(0, 0, 0.08), true);
  const auto flight =
      read_flight(golden_folder() + "/firefly_dt0.01_nodelay_rep1/" + wanted.name + ".csv", kDt);
  const Case* next = kCases;
  Deviation deviation;
  double rotor_rad_s = 0.0;
  for (const FlightRow& row : flight) {
    while (world->step_count() < row.step) {
      if (next != std::end(kCases) && world->step_count() == next->step) {
        world.command("firefly", next->p_world, next->yaw_rad);
        ++next;
      }
      world->step();
    }
    deviation.add(firefly.T_world_model(), row.T_world_base);
    for (std::size_t i = 0; i < 6; ++i) {
      const Joint* joint = firefly.find_joint("firefly/rotor_" + std::to_string(i) + "_joint");
      rotor_rad_s = std::max(rotor_rad_s, std::abs(10.0 * joint->velocity() - row.rotor_rad_s[i]));
    }
  }
  EXPECT_GT(flight.size(), 1000u);
  EXPECT_LT(deviation.position_m, 0.002);
  EXPECT_LT(deviation.angle_deg, wanted.limit_deg);
  RecordProperty("position_mm", std::to_string(1e3 * deviation.position_m));
  RecordProperty("angle_deg", std::to_string(deviation.angle_deg));
  RecordProperty("rotor_rad_s", std::to_string(rotor_rad_s));
}
INSTANTIATE_TEST_SUITE_P(Cases, GoldenFlight, testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

/// The state whose command is the first that is not zero: there the set-point took effect, one step
/// earlier for UAV1 than for the others.
std::uint64_t first_command_step(const std::string& path) {
  for (const RecordedCommand& command : read_commands(path)) {
    if (command.rotor_rad_s[0] > 0.0) {
      return static_cast<std::uint64_t>(std::llround(command.stamp.seconds() / kDt)) - 1;
    }
  }
  throw Error(path + ": no command");
}

class GoldenSix : public testing::Test {
 protected:
  static constexpr std::uint64_t kTranslateStep = 1400;
  static constexpr std::size_t kVehicles = 6;
  struct Vehicle {
    std::string name;
    Eigen::Vector3d p_world_start;
    std::uint64_t hover_step;
    Model* model;
  };

  void SetUp() override {
    TRIDENT_NEEDS_GOLDEN();
    folder_ = golden_folder() + "/six_firefly_dt0.01_nodelay_rep1/";
    world_ = std::make_unique<GoldenWorld>(golden_folder() + "/params/basic.world");
    for (std::size_t i = 1; i <= kVehicles; ++i) {
      const std::string name = "UAV" + std::to_string(i);
      const Eigen::Vector3d p = flight("hover", name).front().T_world_base.p;
      const SE3 start = at(std::round(p.x()), std::round(p.y()), 0.08);
      vehicles_.push_back({name, start.p,
                           first_command_step(folder_ + "motor_commands_" + name + ".csv"),
                           &world_->add_firefly(name, start, true)});
    }
  }

  std::vector<FlightRow> flight(const std::string& phase, const std::string& name) const {
    return read_flight(folder_ + phase + "_" + name + ".csv", kDt);
  }

  void step_to(std::uint64_t step) {
    for (; (*world_)->step_count() < step; (*world_)->step()) {
      for (const Vehicle& vehicle : vehicles_) {
        Eigen::Vector3d p = vehicle.p_world_start;
        p.z() = 1.0;
        const std::uint64_t now = (*world_)->step_count();
        if (now == vehicle.hover_step) world_->command(vehicle.name, p, 0.0);
        if (now == kTranslateStep) {
          world_->command(vehicle.name, p + Eigen::Vector3d(3.0, 1.5, 0.5), 0.0);
        }
      }
    }
  }

  void expect_near(const std::string& phase) {
    std::vector<std::vector<FlightRow>> flights;
    for (const Vehicle& vehicle : vehicles_) flights.push_back(flight(phase, vehicle.name));
    std::vector<Deviation> deviations(kVehicles);
    for (std::size_t k = 0; k < flights[0].size(); ++k) {
      if (flights[0][k].step < (*world_)->step_count()) continue;  // the phases overlap
      step_to(flights[0][k].step);
      for (std::size_t i = 0; i < kVehicles; ++i) {
        ASSERT_EQ(flights[i][k].step, flights[0][k].step);
        deviations[i].add(vehicles_[i].model->T_world_model(), flights[i][k].T_world_base);
      }
    }
    for (std::size_t i = 0; i < kVehicles; ++i) {
      EXPECT_LT(deviations[i].position_m, 0.002) << phase << " " << vehicles_[i].name;
      EXPECT_LT(deviations[i].angle_deg, 0.3) << phase << " " << vehicles_[i].name;
    }
  }

  std::string folder_;
  std::unique_ptr<GoldenWorld> world_;
  std::vector<Vehicle> vehicles_;
};

TEST_F(GoldenSix, EveryFireflyStaysWithinTwoMillimetersOfGazebo) {
  expect_near("hover");
  expect_near("translate");
}

}  // namespace
}  // namespace trident::sim
