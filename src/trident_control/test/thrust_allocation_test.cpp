// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/thrust_allocation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_base/vehicle/thruster_curve.h"

namespace trident::control {
namespace {

ThrusterParams thruster(double x, double y, double yaw, double max_angle = 0.0) {
  ThrusterParams params;
  params.name = "t" + std::to_string(x) + std::to_string(y);
  params.position = {x, y, 0.0};
  params.yaw = yaw;
  params.max_angle = max_angle;
  return params;
}

VesselModel twin() {
  VesselModel model;
  model.name = "twin";
  model.thrusters = {thruster(-2.4, 1.0, 0.0), thruster(-2.4, -1.0, 0.0)};
  return model;
}
VesselModel layout_x() {
  VesselModel model;
  model.name = "x";
  const double diagonal = 0.25 * kPi;
  model.thrusters = {thruster(-2.4, 1.0, diagonal), thruster(-2.4, -1.0, -diagonal),
                     thruster(1.6, 0.7, -diagonal), thruster(1.6, -0.7, diagonal)};
  return model;
}
VesselModel layout_t() {
  VesselModel model = twin();
  for (ThrusterParams& params : model.thrusters) params.max_angle = 0.5 * kPi;
  model.thrusters.push_back(thruster(0.0, 0.0, 0.5 * kPi));
  return model;
}
VesselModel rudder_boat() {
  VesselModel model;
  model.name = "rudder boat";
  model.thrusters = {thruster(-2.0, 0.0, 0.0)};
  RudderParams rudder;
  rudder.name = "rudder";
  rudder.position = {-2.2, 0.0, 0.0};
  rudder.area = 0.1;
  model.rudders = {rudder};
  return model;
}

/// What propellers at these commands give, after their angles have been reached.
PlanarForce force_of(const VesselModel& model, Span<const double> commands) {
  PlanarForce total = PlanarForce::Zero();
  std::size_t angle = model.thrusters.size();
  for (std::size_t i = 0; i < model.thrusters.size(); ++i) {
    const ThrusterParams& params = model.thrusters[i];
    const double turned = params.yaw + (params.max_angle > 0.0 ? commands[angle++] : 0.0);
    const double thrust = thrust_at(params, commands[i]);
    const Eigen::Vector2d f(thrust * std::cos(turned), thrust * std::sin(turned));
    total += PlanarForce(f.x(), f.y(), params.position.x() * f.y() - params.position.y() * f.x());
  }
  return total;
}

double part(const RandomStream& random, std::uint64_t i, std::uint32_t channel) {
  return 2.0 * random.uniform(i, channel) - 1.0;
}

TEST(ThrustAllocation, ReproducesWhatThrustersCanGive) {
  const RandomStream random(2, "thrust allocation test");
  for (const VesselModel& model : {twin(), layout_x()}) {
    ThrustAllocation allocation(model, {});
    for (std::uint64_t i = 0; i < 2000; ++i) {
      std::vector<double> commands(model.thrusters.size());
      for (std::size_t k = 0; k < commands.size(); ++k) {
        commands[k] = part(random, i, static_cast<std::uint32_t>(k));
      }
      const PlanarForce wanted = force_of(model, commands);
      const PlanarForce given = allocation.allocate(wanted, 1.0, 0.01);
      ASSERT_LT((given - wanted).norm(), 0.02) << model.name << i;
      ASSERT_LT((force_of(model, allocation.commands()) - wanted).norm(), 0.02) << model.name << i;
    }
  }
}

/// The optimum of a program with bounds: no single variable can better it.
TEST(ThrustAllocation, NothingBetterIsWithinTheLimits) {
  const VesselModel model = layout_x();
  ThrustAllocation allocation(model, {});
  const RandomStream random(3, "thrust allocation test");
  const auto cost = [&](const std::vector<double>& commands, const PlanarForce& wanted) {
    const PlanarForce missed = force_of(model, commands) - wanted;
    return Eigen::Vector3d(missed[0], missed[1], 100.0 / 2.6 * missed[2]).squaredNorm();
  };
  for (std::uint64_t i = 0; i < 300; ++i) {
    const PlanarForce wanted(900.0 * part(random, i, 0), 900.0 * part(random, i, 1),
                             900.0 * part(random, i, 2));
    allocation.allocate(wanted, 0.0, 0.01);
    const auto found = allocation.commands();
    std::vector<double> commands(found.begin(), found.end());
    const double best = cost(commands, wanted);
    for (std::size_t k = 0; k < commands.size(); ++k) {
      const double kept = commands[k];
      for (const double change : {-0.05, 0.05}) {
        commands[k] = std::clamp(kept + change, -1.0, 1.0);
        ASSERT_GE(cost(commands, wanted), best * (1.0 - 1e-6) - 1e-3) << i << " " << k;
      }
      commands[k] = kept;
    }
  }
}

TEST(ThrustAllocation, YawComesBeforeSurge) {
  ThrustAllocation allocation(twin(), {});
  // Full ahead leaves nothing for a turn; the moment is given all the same.
  const PlanarForce given = allocation.allocate({500.0, 0.0, 150.0}, 1.0, 0.01);
  EXPECT_NEAR(given[2], 150.0, 1.0);
  EXPECT_NEAR(given[0], 350.0, 2.0);
}

TEST(ThrustAllocation, TurningThrustersGiveASidewaysForceOnceTheyHaveTurned) {
  const VesselModel model = layout_t();
  ThrustAllocation allocation(model, {});
  EXPECT_TRUE(allocation.can_push_everywhere_at_once());
  EXPECT_EQ(allocation.topics().size(), 5U);
  const RandomStream random(4, "thrust allocation test");
  for (std::uint64_t i = 0; i < 200; ++i) {
    const PlanarForce wanted(60.0 * part(random, i, 0), 60.0 * part(random, i, 1),
                             100.0 * part(random, i, 2));
    PlanarForce given;
    for (int step = 0; step < 500; ++step) given = allocation.allocate(wanted, 0.0, 0.01);
    ASSERT_LT((given - wanted).norm(), 0.05) << i;
    ASSERT_LT((force_of(model, allocation.commands()) - wanted).norm(), 0.1) << i;
    for (const double command : allocation.commands()) ASSERT_LE(std::abs(command), 0.5 * kPi);
  }
}

TEST(ThrustAllocation, RudderTurnsTheBowInForwardMotionOnly) {
  const VesselModel model = rudder_boat();
  ThrustAllocation allocation(model, {});
  EXPECT_EQ(allocation.topics()[1], "rudders/rudder_angle");
  const PlanarForce given = allocation.allocate({50.0, 0.0, 20.0}, 1.5, 0.01);
  EXPECT_NEAR(given[0], 50.0, 0.1);
  EXPECT_NEAR(given[2], 20.0, 0.5);
  EXPECT_GT(allocation.commands()[1], 0.0);
  const PlanarForce at_rest = allocation.allocate({50.0, 0.0, 20.0}, 0.0, 0.01);
  EXPECT_NEAR(at_rest[2], 0.0, 1e-9);
  EXPECT_NEAR(allocation.commands()[1], 0.0, 1e-9);
}

TEST(ThrustAllocation, KnowsWhatItCanPush) {
  EXPECT_FALSE(ThrustAllocation(twin(), {}).can_push_everywhere());
  EXPECT_TRUE(ThrustAllocation(layout_x(), {}).can_push_everywhere_at_once());
  VesselModel turning = twin();
  for (ThrusterParams& params : turning.thrusters) params.max_angle = 1.5;
  EXPECT_TRUE(ThrustAllocation(turning, {}).can_push_everywhere());
  EXPECT_FALSE(ThrustAllocation(turning, {}).can_push_everywhere_at_once());
}

TEST(ThrustAllocation, RefusesMoreActuatorsThanItHasRoomFor) {
  VesselModel model = twin();
  model.thrusters.assign(13, thruster(-1.0, 0.0, 0.0, 1.0));
  EXPECT_THROW(ThrustAllocation(model, {}), Error);
}

}  // namespace
}  // namespace trident::control
