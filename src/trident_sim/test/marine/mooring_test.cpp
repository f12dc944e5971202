// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "boat_world.h"

namespace trident::sim {
namespace {

constexpr double kMass = 4.0, kLength = 2.0, kStiffness = 500.0;

/// A box that hangs on a line from the origin, or floats without weight below it.
ModelSpec moored(double height, ParamList more = {}) {
  ModelSpec spec = make_body("buoy", BoxShape{{0.2, 0.2, 0.2}}, at(0, 0, height));
  spec.links[0].inertial.mass_kg = kMass;
  ParamList params = {{"bodyName", spec.links[0].name},
                      {"anchor", "0 0 0"},
                      {"length", std::to_string(kLength)},
                      {"stiffness", std::to_string(kStiffness)}};
  params.insert(params.end(), more.begin(), more.end());
  spec.plugins = {make_plugin("mooring", "libtrident_mooring.so", params)};
  return spec;
}

double height(TestWorld& world) { return world->find_model("buoy")->T_world_model().p.z(); }

TEST(Mooring, ALineLengthensByTheWeightOverItsStiffness) {
  TestWorld world(ocean());
  world.add(moored(-1.9));
  world->step(10000);
  EXPECT_NEAR(height(world), -(kLength + kMass * kSeaGravity / kStiffness), 1e-5);
}

TEST(Mooring, ASlackLineDoesNothing) {
  TestWorld world(weightless());
  Model& buoy = world.add(moored(-1.0));
  world->set_model_twist(buoy, {0.0, 0.0, -0.1}, Eigen::Vector3d::Zero());
  world->step(1000);
  EXPECT_NEAR(height(world), -1.0 - 0.1 * world->time().seconds(), 1e-9);
}

TEST(Mooring, ATautLineNeverPushes) {
  TestWorld world(weightless());
  // It comes back faster than the damping would let it, if that could push.
  Model& buoy = world.add(moored(-kLength - 1e-6, {{"damping", "1e4"}}));
  world->set_model_twist(buoy, {0.0, 0.0, 0.5}, Eigen::Vector3d::Zero());
  world->step(100);
  EXPECT_NEAR(height(world), -kLength + 0.5 * world->time().seconds(), 1e-5);
}

TEST(Mooring, WhatALineCannotBeIsRefused) {
  const auto refusal = [](ParamList params) {
    TestWorld world(ocean());
    ModelSpec spec = moored(-1.0);
    params.insert(params.begin(), {"bodyName", spec.links[0].name});
    spec.plugins = {make_plugin("mooring", "libtrident_mooring.so", params)};
    return error_of([&] { world.add(spec); });
  };
  EXPECT_NE(refusal({{"length", "1"}}).find("anchor"), std::string::npos);
  EXPECT_NE(refusal({{"anchor", "0 0 0"}}).find("length"), std::string::npos);
  EXPECT_NE(refusal({{"anchor", "0 0 0"}, {"length", "-1"}}).find("[0, 100000]"),
            std::string::npos);
  EXPECT_NE(refusal({{"anchor", "0 nan 0"}, {"length", "1"}}).find("anchor"), std::string::npos);
}

}  // namespace
}  // namespace trident::sim
