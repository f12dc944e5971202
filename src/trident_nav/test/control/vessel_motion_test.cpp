// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// MPPI's motion model Vessel against what the equations of motion say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "control/mppi/mppi_model.h"
#include "control/mppi/rollout.h"
#include "control/scene.h"
#include "trident_base/error.h"
#include "trident_base/yaml_config.h"

namespace trident::nav::testing {
namespace {

const std::string kFile = std::string(TRIDENT_VESSELS) + "small_catamaran.yaml";

// Limits that leave all to the vessel's own dynamics.
MppiModel catamaran(double current_x = 0.0, double current_y = 0.0) {
  MppiParams params;
  params.motion_model = MppiMotion::kVessel;
  params.VesselConstraints.vessel_file = kFile;
  params.VesselConstraints.current = {current_x, current_y};
  params.model_dt = 0.05;
  params.time_steps = 600;
  ControlSetup setup = jackal();
  setup.limits = {10.0, -10.0, 0.0, 10.0, 100.0, 100.0, 0.0, 100.0, 0.0};
  return make_mppi_model(params, setup);
}

Rollouts sailed(const MppiModel& model, const RolloutStart& start, float vx, float wz) {
  Rollouts rollouts(model.steps);
  std::fill(rollouts.vx.begin(), rollouts.vx.end(), vx);
  std::fill(rollouts.wz.begin(), rollouts.wz.end(), wz);
  roll_out(model, start, &rollouts);
  return rollouts;
}

double last(const Rollouts& rollouts, const std::vector<float>& values) {
  return static_cast<double>(values[static_cast<std::size_t>((rollouts.steps - 1) * kLanes)]);
}

void stop_thrusters(MppiModel* model) {
  model->vessel.force_min = {0.0, 0.0, 0.0};
  model->vessel.force_max = {0.0, 0.0, 0.0};
}

TEST(VesselMotion, ForcesAndMassesAreThoseOfTheFile) {
  const VesselMotion vessel = load_vessel_motion({kFile, {0.0, 0.0}});
  EXPECT_NEAR(vessel.force_max[0], 23.0, 1e-9);
  EXPECT_NEAR(vessel.force_min[0], -23.0, 1e-9);
  EXPECT_NEAR(vessel.force_max[1], 0.0, 1e-9);
  EXPECT_NEAR(vessel.force_max[2], 2.0 * 11.5 * 0.3, 0.5);
  EXPECT_NEAR(vessel.mass[0], 12.6, 1e-9);
  EXPECT_NEAR(vessel.linear_damping[1], 10.0, 1e-9);
}

TEST(VesselMotion, CoastingLosesSpeedByDragAlone) {
  MppiModel model = catamaran();
  stop_thrusters(&model);
  const double u0 = 1.5;
  const Rollouts rollouts = sailed(model, {0.0, {u0, 0.0, 0.0}}, 0.0F, 0.0F);
  // m du/dt = -(d + q u) u has a solution in closed form.
  const double d = model.vessel.linear_damping[0];
  const double q = model.vessel.quadratic_damping[0];
  for (const int step : {20, 100, 300}) {
    const double t = model.dt_s * (step + 1);
    const double decay = std::exp(-d * t / model.vessel.mass[0]);
    const double expected = d * u0 * decay / (d + q * u0 * (1.0 - decay));
    const double u = static_cast<double>(rollouts.vx[static_cast<std::size_t>(step * kLanes)]);
    EXPECT_NEAR(u, expected, 0.03 * u0) << "step " << step;
  }
}

TEST(VesselMotion, FullThrustEndsAtTheSpeedWhereDragIsAsGreat) {
  const MppiModel model = catamaran();
  const Rollouts rollouts = sailed(model, {0.0, {}}, 9.0F, 0.0F);
  const double u = last(rollouts, rollouts.vx);
  const double d = model.vessel.linear_damping[0];
  const double q = model.vessel.quadratic_damping[0];
  EXPECT_NEAR(d * u + q * u * u, model.vessel.force_max[0], 0.01 * model.vessel.force_max[0]);
  // And no faster before that than the force accelerates the mass.
  const auto first = static_cast<double>(rollouts.vx[0]);
  EXPECT_LE(first, model.vessel.force_max[0] / model.vessel.mass[0] * model.dt_s + 1e-6);
}

TEST(VesselMotion, WithoutThrustItDriftsWithTheCurrentWhateverItsHeading) {
  for (const double yaw : {0.0, 1.0, -2.0}) {
    MppiModel model = catamaran(0.3, -0.2);
    stop_thrusters(&model);
    const Rollouts rollouts = sailed(model, {yaw, {}}, 0.0F, 0.0F);
    const double u = last(rollouts, rollouts.vx);
    const double v = last(rollouts, rollouts.vy);
    EXPECT_NEAR(std::cos(yaw) * u - std::sin(yaw) * v, 0.3, 0.03) << yaw;
    EXPECT_NEAR(std::sin(yaw) * u + std::cos(yaw) * v, -0.2, 0.03) << yaw;
  }
}

TEST(VesselMotion, ATurningHullSlidesOutward) {
  const MppiModel model = catamaran();
  const Rollouts rollouts = sailed(model, {0.0, {1.0, 0.0, 0.0}}, 1.0F, 0.4F);
  EXPECT_LT(last(rollouts, rollouts.vy), -0.02);
}

TEST(VesselMotion, ADriftingHullIsTurnedAbeam) {
  MppiModel model = catamaran();
  stop_thrusters(&model);
  EXPECT_EQ(model.vessel.munk_mass, 0.0) << "the file leaves the Munk moment out";
  model.vessel.munk_mass = 5.4;
  const double u = 1.0, v = 0.2;
  const Rollouts rollouts = sailed(model, {0.0, {u, v, 0.0}}, 0.0F, 0.0F);
  // After one step, with the drag of rest: I dr/dt = -munk_mass u v.
  const double gain = model.dt_s / model.vessel.mass[2];
  const double expected = -gain * 5.4 * u * v / (1.0 + gain * model.vessel.linear_damping[2]);
  EXPECT_NEAR(static_cast<double>(rollouts.wz[0]), expected, 1e-5);
}

TEST(VesselMotion, RuddersSteerWithTheSquareOfTheSpeed) {
  MppiModel model = catamaran();
  stop_thrusters(&model);
  model.vessel.rudder_moment = 3.0;
  const auto first_rate = [&](double u) {
    const Rollouts rollouts = sailed(model, {0.0, {u, 0.0, 0.0}}, static_cast<float>(u), 9.0F);
    return static_cast<double>(rollouts.wz[0]);
  };
  EXPECT_EQ(first_rate(0.0), 0.0);
  EXPECT_NEAR(first_rate(1.0), 4.0 * first_rate(0.5), 1e-5);
}

TEST(VesselMotion, AModelWithoutAFileIsRefusedByKey) {
  const auto make = [](const std::string& params) {
    return make_controller("mppi", jackal(), parse_yaml(params, "vessel.yaml"), "vessel.yaml");
  };
  try {
    make("{motion_model: Vessel}");
    ADD_FAILURE() << "it was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("vessel_file"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(
      make("{motion_model: Vessel, VesselConstraints: {vessel_file: '" + kFile + "'}}"));
}

TEST(VesselMotion, ReachesAGoalInOpenWater) {
  ControlSetup setup = jackal();
  setup.limits = {1.2, -0.5, 0.0, 0.8, 1.0, 1.0, 0.0, 1.5, 0.0};
  GridWorld world(10.0, 6.0);
  const Scene scene{"pond", world, {1.0, 3.0, 0.0}, {8.0, 3.5, 0.0}};
  const auto controller =
      make_controller("mppi", setup,
                      parse_yaml("{batch_size: 400, motion_model: Vessel, VesselConstraints: "
                                 "{vessel_file: '" +
                                     kFile + "'}}",
                                 "vessel.yaml"));
  const Drive result = drive(*controller, setup, scene, 40.0, {scene.start, scene.goal});
  EXPECT_TRUE(result.is_reached) << result.last_reason;
}

}  // namespace
}  // namespace trident::nav::testing
